// Walls of the normal flux method: equilibrium whatever the walls, a piston against shock theory and ghosts, momentum,
// thin bodies, threads, memory, and the sums against a slow twin.
#include "physics/fluid/walls/normal_flux.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/normal_flux_still.hpp"
#include "tests/solid/allocation_count.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;
using aquagraph::solid::test::allocations;
using aquagraph::solid::test::ThreadedLoop;

namespace {

// Keeps the particles for which `wet` holds.
template <int D, class Wet>
void keep(Particles<D>& s, Wet&& wet) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (!wet(i)) continue;
        s.id[kept] = std::int64_t(kept);
        s.mass[kept] = s.mass[i];
        s.deviation[kept] = s.deviation[i];
        for (std::size_t d = 0; d < D; ++d) {
            s.x[d][kept] = s.x[d][i];
            s.v[d][kept] = s.v[d][i];
        }
        ++kept;
    }
    s.resize(kept, 0);
}

// Accelerations of particles deeper than R, over g.
template <int D>
double largest_acceleration(const FluxDriver<D>& driver, double depth) {
    const auto& s = driver.fluid.particles;
    double largest = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        double a2 = 0;
        for (std::size_t d = 0; d < D; ++d) a2 += s.acceleration[d][i] * s.acceleration[d][i];
        if (depth - s.x[D - 1][i] > driver.fluid.kernel.radius()) largest = std::max(largest, std::sqrt(a2) / g);
    }
    return largest;
}

}  // namespace

TEST_CASE("a lattice of water is in equilibrium next to walls and thin bodies, before anything moves") {
    const double depth = 0.4, spacing = 0.02;
    SUBCASE("a plate two spacings thick, under water") {
        Panels<2> panels = tank(0.84, 0.8);
        add_body(panels, {0.4, 0.1}, {0.44, 0.2});
        FluxDriver<2> driver(still_fluid<2>(spacing, depth,
                                            {{{0, 0}, {0.4, depth}},
                                             {{0.44, 0}, {0.84, depth}},
                                             {{0.4, 0}, {0.44, 0.1}},
                                             {{0.4, 0.2}, {0.44, depth}}}),
                             panels);
        driver.rebuild();
        driver.rates(0);
        CHECK(largest_acceleration(driver, depth) < 0.02);
        const Rest worst = worst_rest(driver, depth, 0.84 * depth - 0.004, 10);
        CHECK(worst.fastest < 0.003);
        CHECK(worst.pressure_error < 0.005);
    }
    SUBCASE("a plate that parts the tank, one spacing thick: the two sides do not feel each other") {
        Panels<2> panels = tank(0.82, 0.8);
        add_body(panels, {0.4, -0.1}, {0.42, 0.6});
        FluxDriver<2> driver(still_fluid<2>(spacing, depth, {{{0, 0}, {0.4, depth}}, {{0.42, 0}, {0.82, 0.2}}}),
                             panels);
        auto& s = driver.fluid.particles;
        const Tait& tait = driver.fluid.tait;
        for (std::size_t i = 0; i < s.count; ++i)
            if (s.x[0][i] > 0.41) s.deviation[i] = hydrostatic_deviation(tait, g, 0.2 - s.x[1][i]);
        driver.run(10 * depth / tait.sound_speed);
        double left = 0, right = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            const double level = s.x[0][i] < 0.41 ? depth : 0.2;
            if (level - s.x[1][i] < 0.08) continue;
            const double error = std::fabs(s.p[i] - tait.pressure(hydrostatic_deviation(tait, g, level - s.x[1][i]))) /
                                 (1000 * g * depth);
            (s.x[0][i] < 0.41 ? left : right) = std::max(s.x[0][i] < 0.41 ? left : right, error);
        }
        CHECK(left < 0.01);
        CHECK(right < 0.01);
    }
}

TEST_CASE("water in a wedge of 45 degrees settles and stays") {
    // The corner that ghosts cannot fill. The lattice does not fit the slope; it settles while it is damped.
    const double depth = 0.5, spacing = 0.025;
    Panels<2> panels;
    panels.add_wall("wedge", {{0, 0.75}, {0, 0}, {0.75, 0.75}}, false, false);
    Fluid<2> fluid = still_fluid<2>(spacing, depth, {{{0, 0}, {depth, depth}}});
    keep(fluid.particles,
         [&](std::size_t i) { return fluid.particles.x[1][i] > fluid.particles.x[0][i] + 0.3 * spacing; });
    FluxDriver<2> driver(std::move(fluid), panels);
    auto& s = driver.fluid.particles;
    const double acoustic_time = depth / driver.fluid.tait.sound_speed;
    while (driver.time < 40 * acoustic_time) {
        driver.step(driver.largest_step());
        for (auto& v : s.v)
            for (double& u : v) u *= 0.97;
    }
    const std::size_t held = driver.fluid.held_back;
    double fastest = 0;
    for (int k = 0; k < 10; ++k) {
        driver.run(driver.time + acoustic_time);
        for (std::size_t i = 0; i < s.count; ++i)
            fastest = std::max(fastest, std::hypot(s.v[0][i], s.v[1][i]) / std::sqrt(g * depth));
    }
    MESSAGE("wedge: fastest " << fastest);
    CHECK(fastest < 0.02);
    CHECK(driver.fluid.held_back == held);
    CHECK(driver.floored == 0);
    CHECK(driver.walls.deepest(s).depth == 0);
    for (std::size_t i = 0; i < s.count; ++i) CHECK(s.x[1][i] > s.x[0][i]);
}

TEST_CASE("a piston: pressure of the weak shock, as theory and ghosts have it, and the force on the piston") {
    const double spacing = 0.02, length = 1.6, height = 0.24, c = 20, u = 0.2, until = 0.05;
    Panels<2> panels;
    panels.add_wall("piston", {{0, 2 * height}, {0, -height}}, false, false);
    panels.add_wall("floor", {{-1, 0}, {3, 0}}, false, false);
    panels.add_wall("lid", {{3, height}, {-1, height}}, false, false);
    panels.add_wall("end", {{length, -height}, {length, 2 * height}}, false, false);
    const auto tube = [&] {
        Fluid<2> fluid = make_fluid<2>(spacing, Tait{1000, c});
        fill<2>(fluid.particles, {{{0, 0}, {length, height}}}, spacing, fluid.tait, 0, std::optional<double>());
        return fluid;
    };
    const auto motion = [&](Panels<2>& of, double time) {
        for (std::size_t k = 0; k < 2; ++k) {
            of.position[k].x() = u * time;
            of.velocity[k] = Vec2(u, 0);
        }
    };
    // p = ρ0 c u (1 + (γ+1)/4 u/c + …) behind the shock.
    const double expected = 1000 * c * u * (1 + 2 * u / c);
    const auto mean_pressure = [&](const Particles<2>& s) {
        double p = 0, n = 0;
        for (std::size_t i = 0; i < s.count; ++i)
            if (s.x[0][i] < 0.5 * c * until) {
                p += s.p[i];
                ++n;
            }
        return p / n;
    };
    FluxDriver<2> driver(tube(), panels);
    driver.motion = motion;
    driver.run(until);
    Driver<2> ghosts(tube());
    ghosts.walls = make_walls(panels);
    ghosts.motion = motion;
    ghosts.run(until);
    CHECK(mean_pressure(driver.fluid.particles) == doctest::Approx(expected).epsilon(0.003));
    MESSAGE("piston: normal fluxes " << mean_pressure(driver.fluid.particles) / expected << ", ghosts "
                                     << mean_pressure(ghosts.fluid.particles) / expected);
    std::vector<Vec2> forces(driver.walls.panels.position.size(), Vec2::Zero());
    driver.walls.add_pressure_forces(driver.fluid.particles, driver.fluid.kernel, driver.fluid.flux, 0, forces);
    CHECK((forces[0] + forces[1]).x() == doctest::Approx(-expected * height).epsilon(0.005));
    CHECK(std::fabs((forces[0] + forces[1]).y()) < 1e-12 * expected);
}

namespace {

// Water that hits walls from all sides: a block thrown at a corner, with a thin plate in its way.
Fluid<2> thrown(double spacing) {
    Fluid<2> fluid = make_fluid<2>(spacing, Tait{1000, 20}, {.gravity = {0, -g, 0}});
    fill<2>(fluid.particles, {{{0.02, 0.01}, {0.32, 0.31}}}, spacing, fluid.tait, 0, std::optional<double>());
    Random random(5);
    auto& s = fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        s.v[0][i] = 1.5 + 0.1 * random();
        s.v[1][i] = -0.5 + 0.1 * random();
    }
    return fluid;
}
Panels<2> obstacles() {
    Panels<2> panels = tank(0.6, 1);
    add_body(panels, {0.4, -0.05}, {0.42, 0.1});
    return panels;
}

}  // namespace

TEST_CASE("violent water stays inside its walls, and what it loses in momentum the walls get") {
    FluxDriver<2> driver(thrown(0.01), obstacles());
    auto& s = driver.fluid.particles;
    double worst = 0;
    for (int step = 0; step < 700; ++step) {
        driver.step(driver.largest_step());
        if (step % 50 != 0) continue;
        driver.rates(driver.time);
        Vec2 rate = Vec2::Zero();
        double scale = 0;
        for (std::size_t i = 0; i < s.count; ++i)
            for (int d = 0; d < 2; ++d) {
                const double a = s.acceleration[std::size_t(d)][i] - driver.fluid.flux.gravity[d];
                rate[d] += s.mass[i] * a;
                scale += s.mass[i] * std::fabs(a);
            }
        worst = std::max(worst, (rate + driver.total_force()).norm() / scale);
    }
    CHECK(worst < 1e-12);
    double highest = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const Vec2 x(s.x[0][i], s.x[1][i]);
        REQUIRE(std::isfinite(x.x() + x.y() + s.deviation[i]));
        highest = std::max(highest, x.y());
        CHECK(x.x() > 0);
        CHECK(x.x() < 0.6);
        CHECK(x.y() > 0);
        CHECK_FALSE((x.x() > 0.4 && x.x() < 0.42 && x.y() < 0.1));
    }
    MESSAGE("held back " << driver.fluid.held_back << ", floored " << driver.floored << ", highest " << highest
                         << ", time " << driver.time);
    CHECK(driver.fluid.rebuilds > 10);
}

TEST_CASE("the same bits whatever the threads, and in any order of blocks") {
    const auto state = [](BlockLoop loop) {
        FluxDriver<2> driver(thrown(0.01), obstacles());
        for (int step = 0; step < 60; ++step) driver.step(driver.largest_step(), loop);
        CHECK(driver.fluid.rebuilds > 1);
        return state_by_id(driver.fluid.particles);
    };
    const auto serial = state(serial_loop);
    const auto backwards = [](std::size_t blocks, BlockBody body) {
        for (std::size_t block = blocks; block-- > 0;) body(block);
    };
    CHECK(state(backwards) == serial);
    for (const unsigned threads : {2u, 4u}) CHECK(state(ThreadedLoop{threads}) == serial);

    const auto solid_state = [](BlockLoop loop) {
        FluxDriver<3> driver(still_fluid<3>(0.05, 0.3, {{{0, 0, 0}, {0.4, 0.4, 0.3}}}, 3), box_tank<3>({0.6, 0.4, 1}));
        for (int step = 0; step < 10; ++step) driver.step(driver.largest_step(), loop);
        return state_by_id(driver.fluid.particles);
    };
    CHECK(solid_state(ThreadedLoop{3}) == solid_state(serial_loop));
}

TEST_CASE("a step between normal flux walls allocates nothing once lists are built") {
    FluxDriver<2> two(thrown(0.01), obstacles());
    two.step(1e-6);
    FluxDriver<3> three(still_fluid<3>(0.05, 0.3, {{{0, 0, 0}, {0.4, 0.4, 0.3}}}, 3), box_tank<3>({0.6, 0.4, 1}));
    three.step(1e-6);
    const long before = allocations();
    for (int step = 0; step < 3; ++step) {
        two.step(1e-6);
        three.step(1e-6);
    }
    const long during = allocations() - before;
    CHECK(during == 0);
    CHECK(two.fluid.rebuilds == 1);
}

TEST_CASE("the wall's fluxes, particle by particle, point by point") {
    // Between convex walls, where every point is seen; first order, so that the sums are short.
    const double spacing = 0.02;
    FluxParameters flux{.muscl = false, .gravity = {0, -g, 0}};
    Fluid<2> fluid = make_fluid<2>(spacing, water, flux);
    Random random(9);
    fluid.particles = place<2>(lattice<2>({20, 14}, spacing, 0.2, random), spacing);
    disorder(fluid.particles, spacing, random);
    FluxDriver<2> driver(std::move(fluid), tank(0.4, 0.5));
    for (Vec2& v : driver.walls.panels.velocity) v = Vec2(0.3, -0.2);
    driver.rebuild();
    auto& s = driver.fluid.particles;
    const auto& kernel = driver.fluid.kernel;
    driver.rates(0);
    std::vector<double> rate(s.deviation_rate.begin(), s.deviation_rate.end());
    const Vectors<2> acceleration = s.acceleration;
    for (std::size_t block = 0; block < driver.fluid.blocks(); ++block)
        compute_fluxes(s, driver.fluid.lists, kernel, flux, water, driver.fluid.lanes(block));

    const KernelMass<2> mass(kernel);
    double worst = 0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const Vec2 x(s.x[0][i], s.x[1][i]), v(s.v[0][i], s.v[1][i]);
        const double rho = water.reference_density + s.deviation[i];
        double gamma = 1, dilation = 0, weights = 0;
        Vec2 N = Vec2::Zero(), C0 = Vec2::Zero(), force = Vec2::Zero();
        Mat<2> N1 = Mat<2>::Zero(), M = Mat<2>::Zero();
        const Panels<2>& panels = driver.walls.panels;
        for (const bool weigh : {true, false})
            for (std::size_t k = 0; k < panels.size(); ++k) {
                if (weigh) gamma -= missing_mass(mass, {panels.start(k) - x, panels.end(k) - x}, panels.normal[k]);
                const int n = int(std::ceil(panels.measure[k] / spacing * (1 - 1e-9)));
                for (int q = 0; q < n; ++q) {
                    const double t = (q + 0.5) / n;
                    const Vec2 dx = (1 - t) * panels.start(k) + t * panels.end(k) - x, out = -panels.normal[k];
                    const double weight = kernel.value(dx.norm()) * panels.measure[k] / n;
                    if (weigh) {
                        weights += weight;
                        N += weight * out;
                        N1 += weight * out * dx.transpose();
                        continue;
                    }
                    const double Z = s.impedance[i] * std::min(1.0, 4 * gamma / (kernel.radius() * weights));
                    const double u_w = Vec2(0.3, -0.2).dot(out);
                    double p_s = s.p[i] + rho * -g * dx.y() + Z * (v.dot(out) - u_w);
                    if (s.fullness[i] < fullness_of_interior) p_s = std::max(0.0, p_s);
                    force -= weight * (s.p[i] + p_s) * out;
                    dilation += weight * (u_w - v.dot(out));
                }
            }
        if (weights == 0) {
            worst = std::max(worst, std::fabs(rate[i] - s.deviation_rate[i]));
            continue;
        }
        ++near;
        for (std::size_t j = 0; j < s.count; ++j) {
            const Vec2 dx(s.x[0][j] - x.x(), s.x[1][j] - x.y());
            const double w = -kernel.derivative(dx.norm()) / std::max(dx.norm(), 1e-30) * s.volume[j];
            if (j == i) continue;
            C0 += w * dx;
            M += w * dx * dx.transpose();
        }
        C0 += N;
        const Mat<2> C1 = M + N1 - gamma * Mat<2>::Identity();
        const double tolerated = 0.15 * std::sqrt(N.norm() * 1.5 / kernel.radius());
        if (C0.norm() > tolerated) C0 *= tolerated / C0.norm();
        const double t = std::clamp((s.fullness[i] - 0.8) / 0.15, 0.0, 1.0),
                     open = t * t * (3 - 2 * t) * std::min(1.0, (1 - gamma) / 1e-3);
        const Vec2 grad_p(s.grad_p[0][i], s.grad_p[1][i]), gravity(0, -g);
        double divergence = 0;
        for (int a = 0; a < 2; ++a)
            for (int c = 0; c < 2; ++c) divergence += C1(a, c) * s.grad_v[std::size_t(a)][std::size_t(c)][i];
        const double expected_rate = -rho / gamma * (-s.deviation_rate[i] / rho + dilation - open * divergence);
        const Vec2 pairs = Vec2(s.acceleration[0][i], s.acceleration[1][i]) - gravity;
        const Vec2 expected =
            gravity + (pairs + s.volume[i] / s.mass[i] * (force + open * (2 * s.p[i] * C0 + C1 * grad_p))) / gamma;
        worst = std::max({worst, std::fabs(rate[i] - expected_rate) / 1e6,
                          (expected - Vec2(acceleration[0][i], acceleration[1][i])).norm() / 1e4});
    }
    CHECK(near > 100);
    CHECK(worst < 1e-12);
}

TEST_CASE("fullness does not take a wall for a free surface") {
    const double depth = 0.4, spacing = 0.02;
    FluxDriver<2> driver(still_fluid<2>(spacing, depth, {{{0, 0}, {0.6, depth}}}), tank(0.6, 0.8));
    driver.rebuild();
    driver.rates(0);
    const auto& s = driver.fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double below = depth - s.x[1][i];
        if (below > 0.08) CHECK(s.fullness[i] == doctest::Approx(1).epsilon(0.03));
        if (below < 0.02) CHECK(s.fullness[i] < fullness_of_interior);
    }
}

TEST_CASE("Poiseuille's slope at the wall brakes by its shear stress") {
    // v_x = s y above a floor: the floor takes 2 µ s W A over γ from every particle; Σ m dv/dt -> µ s per area as
    // the weights ∫ 2 W dS over all heights integrate to one.
    const double spacing = 0.01, slope = 3, viscosity = 2;
    Fluid<2> fluid = make_fluid<2>(spacing, water);
    Random random;
    fluid.particles = place<2>(lattice<2>({40, 10}, spacing, 0, random), spacing);
    Panels<2> panels;
    panels.add_wall("floor", {{-1, 0}, {2, 0}}, false, true);
    FluxDriver<2> driver(std::move(fluid), panels);
    driver.rebuild();
    auto& s = driver.fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        s.v[0][i] = slope * s.x[1][i];
        s.acceleration[0][i] = s.acceleration[1][i] = 0;
    }
    for (std::size_t block = 0; block < driver.fluid.blocks(); ++block)
        driver.walls.add_shear(s, driver.fluid.kernel, {viscosity, ViscousOperator::morris}, spacing, block);
    double force = 0;
    for (std::size_t i = 0; i < s.count; ++i) force += s.mass[i] * s.acceleration[0][i];
    CHECK(force == doctest::Approx(-viscosity * slope * 0.4).epsilon(0.02));
}
