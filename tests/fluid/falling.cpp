// Particles that come to walls: a lone one is held back, one that has passed through is reported.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {
constexpr double spacing = 0.02;
}

TEST_CASE("a lone particle that falls onto a floor stays on it") {
    for (const double speed : {0.0, 1.0, 5.0}) {
        CAPTURE(speed);
        Driver<2> driver(make_fluid<2>(spacing, water, {.gravity = {0, -9.81, 0}}));
        driver.fluid.particles = place<2>({{0.5, 0.1}}, spacing);
        driver.fluid.particles.v[0][0] = 0.2;
        driver.fluid.particles.v[1][0] = -speed;
        driver.walls = make_walls(tank(1, 1));
        double lowest = 1;
        while (driver.time < 0.5) {
            driver.step(driver.largest_step());
            lowest = std::min(lowest, driver.fluid.particles.x[1][0]);
            CHECK(driver.walls->deepest(driver.fluid.particles).depth < 0.5 * spacing);
        }
        CHECK(lowest > 0);
        CHECK(driver.fluid.particles.x[1][0] < 2 * spacing);  // as near as its own mirror image lets it
        CHECK(driver.fluid.particles.v[0][0] == doctest::Approx(0.2).epsilon(1e-12));  // free slip
        CHECK(std::fabs(driver.fluid.particles.v[1][0]) < 0.2);
    }
}

TEST_CASE("a particle held back takes the velocity of the wall that it meets") {
    Driver<2> driver(make_fluid<2>(spacing, water));
    driver.fluid.particles = place<2>({{0.5, 0.01}}, spacing);
    driver.walls = make_walls(tank(1, 1));
    driver.rebuild();
    auto& s = driver.fluid.particles;
    for (Vec2& v : driver.walls->panels.velocity) v = Vec2(0, 0.7);
    s.x[1][0] = -0.3 * spacing;
    s.v[0][0] = 1.5;
    s.v[1][0] = -2;
    CHECK(driver.walls->hold_back(s, spacing) == 1);
    CHECK(s.x[1][0] > 0);
    CHECK(s.x[1][0] < 0.01 * spacing);
    CHECK(s.v[0][0] == 1.5);
    CHECK(s.v[1][0] == doctest::Approx(0.7).epsilon(1e-14));
    CHECK(driver.walls->hold_back(s, spacing) == 0);
    // One that already leaves keeps its velocity.
    s.x[1][0] = -0.3 * spacing;
    s.v[1][0] = 2;
    CHECK(driver.walls->hold_back(s, spacing) == 1);
    CHECK(s.v[1][0] == 2);
}

TEST_CASE("a particle that has passed through a wall is reported") {
    Driver<2> driver = settle(cells_where(50, 10, spacing, [](auto) { return true; }), spacing, tank(1, 1));
    auto& s = driver.fluid.particles;
    CHECK(driver.walls->deepest(s).depth == 0);
    std::size_t lowest = 0;
    for (std::size_t i = 0; i < s.count; ++i)
        if (std::hypot(s.x[0][i] - 0.51, s.x[1][i] - 0.01) < 1e-9) lowest = i;
    s.x[1][lowest] = -0.7 * spacing;
    s.x[1][lowest == 0 ? 1 : lowest - 1] += 0.1 * spacing;
    const Escape escape = driver.walls->deepest(s);
    CHECK(escape.particle == lowest);
    CHECK(escape.depth == doctest::Approx(0.7 * spacing).epsilon(1e-12));
    CHECK(escape.panel == 1);
    CHECK(driver.walls->hold_back(s, spacing) == 0);  // too deep to be put back
}
