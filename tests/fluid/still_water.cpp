// Water at rest in a tank of ghost walls stays at rest, whether the tank stands or travels.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double width = 0.8, depth = 0.5, g = 9.81, spacing = 0.02;
const double speed = std::sqrt(g * depth);

Driver<2> still_tank(const Vec2& travel) {
    Driver<2> driver(make_fluid<2>(spacing, Tait{1000, 10 * speed}, {.gravity = {0, -g, 0}}));
    auto& s = driver.fluid.particles;
    fill<2>(s, {{{0, 0}, {width, depth}}}, spacing, driver.fluid.tait, g, depth);
    for (std::size_t i = 0; i < s.count; ++i)
        for (int d = 0; d < 2; ++d) s.v[static_cast<std::size_t>(d)][i] = travel[d];
    driver.walls = make_walls(tank(width, 1.5 * depth));
    const std::vector<Vec2> home = driver.walls->panels.position;
    driver.motion = [home, travel](Panels<2>& panels, double time) {
        for (std::size_t k = 0; k < home.size(); ++k) {
            panels.position[k] = home[k] + time * travel;
            panels.velocity[k] = travel;
        }
    };
    return driver;
}

struct Rest {
    double fastest = 0;         // over √(gH)
    double mean = 0;            // root mean square of the same
    double pressure_error = 0;  // largest, over ρ g H, of particles deeper than R
    double volume_error = 0;    // of all particles together
};

Rest measure(const Driver<2>& driver, const Vec2& travel) {
    const auto& s = driver.fluid.particles;
    Rest rest;
    double volume = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double v = std::hypot(s.v[0][i] - travel.x(), s.v[1][i] - travel.y()) / speed;
        rest.fastest = std::max(rest.fastest, v);
        rest.mean += v * v / static_cast<double>(s.count);
        const double y = s.x[1][i] - driver.time * travel.y();
        const double expected = driver.fluid.tait.pressure(hydrostatic_deviation(driver.fluid.tait, g, depth - y));
        if (depth - y > driver.fluid.kernel.radius())
            rest.pressure_error = std::max(rest.pressure_error, std::fabs(s.p[i] - expected) / (1000 * g * depth));
        volume += s.volume[i];
    }
    rest.mean = std::sqrt(rest.mean);
    rest.volume_error = std::fabs(volume / (width * depth) - 1);
    return rest;
}

}  // namespace

TEST_CASE("still water stays still for twenty acoustic times") {
    Driver<2> driver = still_tank(Vec2::Zero());
    const double acoustic_time = depth / driver.fluid.tait.sound_speed;
    Rest worst;
    for (int k = 1; k <= 20; ++k) {
        driver.run(k * acoustic_time);
        const Rest rest = measure(driver, Vec2::Zero());
        worst.fastest = std::max(worst.fastest, rest.fastest);
        worst.mean = std::max(worst.mean, rest.mean);
        worst.pressure_error = std::max(worst.pressure_error, rest.pressure_error);
        worst.volume_error = std::max(worst.volume_error, rest.volume_error);
    }
    CHECK(worst.fastest < 0.002);
    CHECK(worst.mean < 5e-4);
    CHECK(worst.pressure_error < 0.005);
    CHECK(worst.volume_error < 1e-4);
    CHECK(driver.fluid.held_back == 0);
    CHECK(driver.walls->deepest(driver.fluid.particles).depth == 0);
}

TEST_CASE("a tank that travels with its water is a tank at rest") {
    const Vec2 travel(1.7, -0.9);
    Driver<2> still = still_tank(Vec2::Zero()), moving = still_tank(travel);
    const double until = 5 * depth / still.fluid.tait.sound_speed, dt = 0.9 * still.largest_step();
    while (still.time < until) {
        still.step(dt);
        moving.step(dt);
    }
    const Rest rest = measure(moving, travel);
    CHECK(rest.fastest < 0.002);
    CHECK(moving.fluid.rebuilds > still.fluid.rebuilds);
    const auto a = state_by_id(still.fluid.particles), b = state_by_id(moving.fluid.particles);
    double difference_x = 0, difference_v = 0, difference_density = 0;
    for (std::size_t i = 0; i < still.fluid.particles.count; ++i)
        for (int d = 0; d < 2; ++d) {
            const std::size_t of = 6 * i, e = static_cast<std::size_t>(d);
            difference_x = std::max(difference_x, std::fabs(a[of + e] + still.time * travel[d] - b[of + e]));
            difference_v = std::max(difference_v, std::fabs(a[of + 2 + e] + travel[d] - b[of + 2 + e]));
            difference_density = std::max(difference_density, std::fabs(a[of + 4] - b[of + 4]));
        }
    CHECK(difference_x < 1e-11 * spacing);
    CHECK(difference_v < 1e-12 * speed);
    CHECK(difference_density < 1e-10);
}
