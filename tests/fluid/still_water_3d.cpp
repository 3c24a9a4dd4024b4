// Water at rest in a 3D tank stays at rest; a slab of water between planes of free slip moves as in 2D.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins_3d.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double g = 9.81;

struct Rest {
    double fastest = 0;         // over √(gH)
    double mean = 0;            // root mean square of the same
    double pressure_error = 0;  // largest, over ρ g H, of particles deeper than R
    double volume_error = 0;    // of all particles together
};

Rest measure(const Driver<3>& driver, double volume, double depth, const Vec3& travel) {
    const auto& s = driver.fluid.particles;
    Rest rest;
    double sum = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double v = (velocity(s, i) - travel).norm() / std::sqrt(g * depth);
        rest.fastest = std::max(rest.fastest, v);
        rest.mean += v * v / double(s.count);
        const double z = s.x[2][i] - driver.time * travel.z();
        const double expected = driver.fluid.tait.pressure(hydrostatic_deviation(driver.fluid.tait, g, depth - z));
        if (depth - z > driver.fluid.kernel.radius())
            rest.pressure_error = std::max(rest.pressure_error, std::fabs(s.p[i] - expected) / (1000 * g * depth));
        sum += s.volume[i];
    }
    rest.mean = std::sqrt(rest.mean);
    rest.volume_error = std::fabs(sum / volume - 1);
    return rest;
}

Driver<3> still_tank(const Vec3& travel, double spacing, const Vec3& size) {
    const double depth = size.z();
    Driver<3> driver(make_fluid<3>(spacing, Tait{1000, 10 * std::sqrt(g * depth)}, {.gravity = {0, 0, -g}}));
    auto& s = driver.fluid.particles;
    fill<3>(s, {{{0, 0, 0}, {size.x(), size.y(), size.z()}}}, spacing, driver.fluid.tait, g, depth);
    for (std::size_t i = 0; i < s.count; ++i)
        for (int d = 0; d < 3; ++d) s.v[std::size_t(d)][i] = travel[d];
    driver.walls = make_ghost_walls(tank(Vec3(size.x(), size.y(), 1.5 * depth)));
    const std::vector<Vec3> home = driver.walls->panels.position;
    driver.motion = [home, travel](Panels<3>& panels, double time) {
        for (std::size_t k = 0; k < home.size(); ++k) {
            panels.position[k] = home[k] + time * travel;
            panels.velocity[k] = travel;
        }
    };
    return driver;
}

}  // namespace

TEST_CASE("still water in a 3D tank stays still") {
    const Vec3 size(0.5, 0.4, 0.5);
    Driver<3> driver = still_tank(Vec3::Zero(), 0.05, size);
    const double acoustic_time = size.z() / driver.fluid.tait.sound_speed;
    Rest worst;
    for (int k = 1; k <= 20; ++k) {
        driver.run(k * acoustic_time);
        const Rest rest = measure(driver, size.prod(), size.z(), Vec3::Zero());
        worst.fastest = std::max(worst.fastest, rest.fastest);
        worst.mean = std::max(worst.mean, rest.mean);
        worst.pressure_error = std::max(worst.pressure_error, rest.pressure_error);
        worst.volume_error = std::max(worst.volume_error, rest.volume_error);
    }
    CAPTURE(worst.fastest);
    CAPTURE(worst.mean);
    CAPTURE(worst.pressure_error);
    CAPTURE(worst.volume_error);
    CHECK(worst.fastest < 0.005);
    CHECK(worst.mean < 0.001);
    CHECK(worst.pressure_error < 0.01);
    CHECK(worst.volume_error < 1e-4);
    CHECK(driver.fluid.held_back == 0);
    CHECK(driver.walls->deepest(driver.fluid.particles).depth == 0);
}

TEST_CASE("momentum: what the walls of a 3D tank take is what the water loses") {
    const Vec3 size(0.6, 0.5, 0.6);
    Driver<3> driver = still_tank(Vec3::Zero(), 0.05, size);
    driver.rebuild();
    driver.rates(0);
    auto& s = driver.fluid.particles;
    // Force on the water, without those ghosts that `gone` picks.
    const auto force = [&](auto&& gone) {
        const Scalars volume = s.volume;
        for (std::size_t g = 0; g < s.ghost_count; ++g)
            if (gone(position(s, s.ghost_begin() + g))) s.volume[s.ghost_begin() + g] = 0;
        driver.fluxes();
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < s.count; ++i)
            for (int d = 0; d < 3; ++d) sum[d] += s.mass[i] * s.acceleration[std::size_t(d)][i];
        s.volume = volume;
        return sum;
    };
    double mass = 0;
    for (std::size_t i = 0; i < s.count; ++i) mass += s.mass[i];
    const Vec3 weight(0, 0, -mass * g), all = force([](const Vec3&) { return false; });
    const auto none = force([](const Vec3&) { return true; });
    CHECK((none - weight).norm() < 1e-11 * weight.norm());  // between particles nothing is lost
    CHECK((all - none + weight).norm() < 0.01 * weight.norm());
    // The left wall bears ½ ρ g H² B.
    const double load = 0.5 * 1000 * g * size.z() * size.z() * size.y();
    const Vec3 left = all - force([](const Vec3& x) { return x.x() < 0; });
    CAPTURE(left.x() / load);
    CHECK(left.x() == doctest::Approx(load).epsilon(0.03));
    CHECK(std::fabs(left.y()) < 1e-9 * load);
}

TEST_CASE("a 3D tank that travels with its water is a tank at rest") {
    const Vec3 size(0.5, 0.4, 0.3), travel(1.7, -0.9, 0.4);
    Driver<3> still = still_tank(Vec3::Zero(), 0.05, size), moving = still_tank(travel, 0.05, size);
    still.rebuild();
    still.rates(0);
    const double dt = 0.9 * still.largest_step();
    for (int k = 0; k < 25; ++k) {
        still.step(dt);
        moving.step(dt);
    }
    CHECK(moving.fluid.rebuilds > 1);
    const auto a = state_by_id(still.fluid.particles), b = state_by_id(moving.fluid.particles);
    double difference = 0;
    for (std::size_t i = 0; i < still.fluid.particles.count; ++i)
        for (std::size_t d = 0; d < 3; ++d) {
            const std::size_t of = 8 * i;
            difference = std::max(difference, std::fabs(a[of + d] + still.time * travel[int(d)] - b[of + d]));
            difference = std::max(difference, std::fabs(a[of + 3 + d] + travel[int(d)] - b[of + 3 + d]));
        }
    CHECK(difference < 1e-10);
}

namespace {

// A wave in a tank: the surface is flat, the water in it moves like the first standing wave.
template <int D>
Driver<D> wave(double length, double depth, double width, double spacing) {
    Driver<D> driver(make_fluid<D>(spacing, Tait{1000, 10 * std::sqrt(g * depth)}));
    driver.fluid.flux.gravity[D - 1] = -g;
    auto& s = driver.fluid.particles;
    if constexpr (D == 2)
        fill<2>(s, {{{0, 0}, {length, depth}}}, spacing, driver.fluid.tait, g, depth);
    else
        fill<3>(s, {{{0, 0, 0}, {length, width, depth}}}, spacing, driver.fluid.tait, g, depth);
    const double k = std::numbers::pi / length, amplitude = 0.1 * std::sqrt(g * depth) / std::sinh(k * depth);
    for (std::size_t i = 0; i < s.count; ++i) {
        const double x = s.x[0][i], z = s.x[D - 1][i];
        s.v[0][i] = -amplitude * std::sin(k * x) * std::cosh(k * z);
        s.v[D - 1][i] = amplitude * std::cos(k * x) * std::sinh(k * z);
    }
    return driver;
}

}  // namespace

TEST_CASE("a slab of water between planes of free slip moves as in 2D, and as without end") {
    constexpr double spacing = 0.05, length = 1, depth = 0.5, width = 6 * spacing, until = 0.12;
    Driver<2> flat = wave<2>(length, depth, width, spacing);
    flat.walls = make_ghost_walls(tank(length, 2 * depth));
    Driver<3> slab = wave<3>(length, depth, width, spacing);
    slab.walls = make_ghost_walls(tank(Vec3(length, width, 2 * depth)));
    // The same without the two planes, periodic across.
    Driver<3> endless = wave<3>(length, depth, width, spacing);
    Panels<3> panels;
    const double top = 2 * depth;
    panels.add_wall("floor", {{0, 0, 0}, {length, 0, 0}, {length, width, 0}, {0, width, 0}}, {{0, 1, 2}, {0, 2, 3}},
                    false);
    panels.add_wall("left", {{0, 0, 0}, {0, width, 0}, {0, width, top}, {0, 0, top}}, {{0, 1, 2}, {0, 2, 3}}, false);
    panels.add_wall("right", {{length, 0, 0}, {length, 0, top}, {length, width, top}, {length, width, 0}},
                    {{0, 1, 2}, {0, 2, 3}}, false);
    endless.walls = make_ghost_walls(panels);
    endless.walls->periodic = {{false, true, false}, Vec3::Zero(), Vec3(length, width, top)};
    const double dt = 0.002;
    for (double t = 0; t < until; t += dt) {
        flat.step(dt);
        slab.step(dt);
        endless.step(dt);
    }
    CHECK(slab.fluid.rebuilds > 1);

    // Every particle of the slab has the same fate as those beside it.
    const auto a = state_by_id(slab.fluid.particles), b = state_by_id(endless.fluid.particles);
    double difference = 0;
    for (std::size_t k = 0; k < a.size(); ++k) difference = std::max(difference, std::fabs(a[k] - b[k]));
    CHECK(difference < 1e-7);

    // In 2D the kernel is another one, the flow the same: by places where they began.
    const auto start_2 = wave<2>(length, depth, width, spacing).fluid.particles;
    const auto start_3 = wave<3>(length, depth, width, spacing).fluid.particles;
    const auto two = state_by_id(flat.fluid.particles);
    double difference_v = 0, difference_x = 0, fastest = 0, across = 0;
    for (std::size_t i = 0; i < start_3.count; ++i)
        for (std::size_t j = 0; j < start_2.count; ++j) {
            if (std::hypot(start_3.x[0][i] - start_2.x[0][j], start_3.x[2][i] - start_2.x[1][j]) > 1e-9) continue;
            const double* in_3 = &a[std::size_t(start_3.id[i]) * 8];
            const double* in_2 = &two[std::size_t(start_2.id[j]) * 6];
            difference_x = std::max(difference_x, std::hypot(in_3[0] - in_2[0], in_3[2] - in_2[1]));
            difference_v = std::max(difference_v, std::hypot(in_3[3] - in_2[2], in_3[5] - in_2[3]));
            fastest = std::max(fastest, std::hypot(in_2[2], in_2[3]));
            across = std::max(across, std::fabs(in_3[4]));
        }
    CAPTURE(fastest);
    CAPTURE(difference_v);
    CAPTURE(difference_x);
    CHECK(across < 1e-9);
    CHECK(difference_x < 0.1 * spacing);
    CHECK(difference_v < 0.1 * fastest);
}
