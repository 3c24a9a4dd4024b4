// Water that turns in a corner: a drop that is stretched, u = (A x, -A y), is an ellipse of half axes a and b for ever
// (Monaghan 1994, J. Comput. Phys. 110:399), and what holds of its quarter between two walls holds of the whole:
//     a'' = C/a,  b'' = C/b,  A = a'/a,  C = 2 A² a² b²/(a² + b²),  p = ½ ρ C (1 - x²/a² - y²/b²).
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "tests/fluid/basins.hpp"
#include "tests/fluid/normal_flux_driver.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

struct Ellipse {
    double a = 1, rate = 1;  // half axis along x, b = 1/a; A

    double C() const { return 2 * rate * rate / (a * a + 1 / (a * a)); }
    static Ellipse after(double time) {
        Ellipse e;
        const int steps = 2000;
        const double dt = time / steps;
        for (int k = 0; k < steps; ++k) {  // midpoint rule
            const Ellipse middle{e.a + 0.5 * dt * e.rate * e.a,
                                 e.rate + 0.5 * dt * (e.C() / (e.a * e.a) - e.rate * e.rate)};
            e.a += dt * middle.rate * middle.a;
            e.rate += dt * (middle.C() / (middle.a * middle.a) - middle.rate * middle.rate);
        }
        return e;
    }
    double pressure(const Vec2& x) const { return 500 * C() * (1 - x.x() * x.x() / (a * a) - x.y() * x.y() * a * a); }
};

// The quarter of the drop in x, y > 0 first, then what is mirrored of it.
Fluid<2> drop(double spacing, bool whole, const FluxParameters& flux) {
    std::vector<Point<2>> points;
    const int cells = int(std::lround(1 / spacing));
    const auto quarter = cells_where(cells, cells, spacing, [](auto x) { return std::hypot(x[0], x[1]) < 1; });
    for (const Point<2>& mirrored :
         whole ? std::vector<Point<2>>{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}} : std::vector<Point<2>>{{1, 1}})
        for (const Point<2>& x : quarter) points.push_back({mirrored[0] * x[0], mirrored[1] * x[1]});
    Fluid<2> fluid = make_fluid<2>(spacing, water, flux);
    fluid.particles = place<2>(points, spacing);
    auto& s = fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        s.v[0][i] = s.x[0][i];
        s.v[1][i] = -s.x[1][i];
        s.deviation[i] = fluid.tait.deviation(Ellipse{}.pressure(position(s, i)));
    }
    update_state(s, fluid.tait, {0, s.clusters() * W});
    // The mass follows the density, so that volumes are Δx².
    for (std::size_t i = 0; i < s.count; ++i) {
        s.mass[i] = (fluid.tait.reference_density + s.deviation[i]) * spacing * spacing;
        s.volume[i] = spacing * spacing;
    }
    return fluid;
}

Panels<2> corner() {
    Panels<2> panels;
    panels.add_wall("corner", {{0, 6}, {0, 0}, {6, 0}}, false, false);
    return panels;
}

// Mean over the particles within 0.3 of the stagnation point of the error of p, over ½ ρ of the speed at the start.
double pressure_error(const Particles<2>& s, double time) {
    const Ellipse ellipse = Ellipse::after(time);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const Vec2 x = position(s, i);
        if (x.norm() > 0.3) continue;
        sum += s.p[i] - ellipse.pressure(x);
        ++count;
    }
    return sum / count / 500;
}

}  // namespace

// With exchange of mass they differ: nothing goes through walls.
TEST_CASE("a quarter of a drop turns in a corner of ghosts as it does in the whole drop") {
    const double spacing = 0.1;
    FluxParameters flux;
    SUBCASE("MUSCL") {}
    SUBCASE("low dissipation") {
        flux.solver = RiemannSolver::low_dissipation;
    }
    SUBCASE("first order") {
        flux.muscl = false;
    }
    SUBCASE("δ-SPH") {
        flux.scheme = Scheme::delta_sph;
    }
    Driver<2> quarter(drop(spacing, false, flux)), whole(drop(spacing, true, flux));
    quarter.walls = make_walls(corner());
    const double dt = 0.8 * whole.largest_step();
    for (int step = 0; step < 60; ++step) {
        quarter.step(dt);
        whole.step(dt);
    }
    const auto& s = quarter.fluid.particles;
    const auto a = state_by_id(s), b = state_by_id(whole.fluid.particles);
    const std::size_t values = a.size() / s.count;
    double difference_x = 0, difference_v = 0, difference_density = 0, fastest = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double *of = &a[values * i], *twin = &b[values * i];
        for (std::size_t d = 0; d < 2; ++d) {
            difference_x = std::max(difference_x, std::fabs(of[d] - twin[d]));
            difference_v = std::max(difference_v, std::fabs(of[2 + d] - twin[2 + d]));
            fastest = std::max(fastest, std::fabs(of[2 + d]));
        }
        difference_density = std::max(difference_density, std::fabs(of[4] - twin[4]));
    }
    MESSAGE("x " << difference_x / spacing << " Δx, v " << difference_v << " m/s, density " << difference_density);
    CHECK(quarter.fluid.rebuilds > 1);
    CHECK(fastest > 0.2);
    CHECK(difference_x < 1e-9 * spacing);
    CHECK(difference_v < 1e-9);
    CHECK(difference_density < 1e-9);
}

TEST_CASE("pressure where water turns in a corner, against the closed form") {
    // The impulse of the pressure over time: the sound of the start swings round it by a tenth of ½ ρ v².
    const auto check = [](auto& driver) {
        const double until = 0.6;
        double mean = 0;
        driver.rebuild();
        while (driver.time < until * (1 - 1e-12)) {
            const double dt = std::min(driver.largest_step(), until - driver.time);
            driver.step(dt);
            mean += dt / until * pressure_error(driver.fluid.particles, driver.time);
        }
        MESSAGE("mean error of p over ½ ρ v²: " << mean);
        CHECK(std::fabs(mean) < 0.03);
    };
    for (const RiemannSolver solver : {RiemannSolver::acoustic, RiemannSolver::low_dissipation}) {
        CAPTURE(int(solver));
        Driver<2> ghosts(drop(0.05, false, {.solver = solver}));
        ghosts.walls = make_walls(corner());
        check(ghosts);
        FluxDriver<2> flux_walls(drop(0.05, false, {.solver = solver}), corner());
        check(flux_walls);
    }
}
