// Mass exchange and shifting between walls of normal fluxes: no mass is lost, a common velocity stays, and a shift
// carries velocities along next to walls as it does inside.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins.hpp"
#include "tests/fluid/normal_flux_driver.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.05, width = 1.2, height = 1;

// A closed tank of water that exchanges mass, shifted, its left wall a piston.
FluxDriver<2> exchanging_tank(double jitter) {
    Fluid<2> fluid = make_fluid<2>(spacing, Tait{1000, 20}, {.scheme = Scheme::riemann_ale});
    fluid.transport = Transport::shifting;
    Random random(7);
    fluid.particles = place<2>(lattice<2>({24, 20}, spacing, jitter, random), spacing);
    fluid.prepare_particles();
    fluid.particles.resize(fluid.particles.count, 0);
    Panels<2> panels;
    panels.add_wall("tank", {{0, 0}, {width, 0}, {width, height}, {0, height}}, false, false);
    panels.add_wall("piston", {{0, height}, {0, 0}}, false, false);
    return {std::move(fluid), std::move(panels)};
}

double total_mass(const Particles<2>& s) {
    double sum = 0;
    for (std::size_t i = 0; i < s.count; ++i) sum += s.mass[i];
    return sum;
}

}  // namespace

TEST_CASE("particles exchange mass between walls of normal fluxes, one of which moves, and none is lost") {
    FluxDriver<2> driver = exchanging_tank(0.2);
    auto& s = driver.fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double k = 3.14159265358979 / width, l = 3.14159265358979 / height;
        s.v[0][i] = std::sin(k * s.x[0][i]) * std::cos(l * s.x[1][i]) + 0.3 * (1 - s.x[0][i] / width);
        s.v[1][i] = -k / l * std::cos(k * s.x[0][i]) * std::sin(l * s.x[1][i]);
    }
    driver.motion = [](Panels<2>& walls, double time) {
        for (const std::size_t vertex : {4u, 5u}) {
            walls.position[vertex].x() = 0.3 * time;
            walls.velocity[vertex] = {0.3, 0};
        }
    };
    const double before = total_mass(s), each = s.mass[0];
    for (int step = 0; step < 100; ++step) driver.step(0.9 * driver.largest_step());
    double exchanged = 0;
    for (std::size_t i = 0; i < s.count; ++i) exchanged = std::max(exchanged, std::fabs(s.mass[i] / each - 1));
    MESSAGE("mass exchanged " << exchanged << " of a particle's, lost " << total_mass(s) / before - 1);
    CHECK(driver.fluid.rebuilds > 1);
    CHECK(driver.fluid.held_back == 0);
    CHECK(exchanged > 0.01);
    CHECK(std::fabs(total_mass(s) / before - 1) < 1e-13);
}

TEST_CASE("water that moves with its tank keeps its velocity while mass is exchanged") {
    FluxDriver<2> driver = exchanging_tank(0.2);
    auto& s = driver.fluid.particles;
    const Vec2 common(2, -1);
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t d = 0; d < 2; ++d) s.v[d][i] = common[int(d)];
    for (Vec2& v : driver.walls.panels.velocity) v = common;
    driver.rebuild();
    driver.rates(0);
    double gain = 0, change = 0, fastest = 0, sum = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        sum += s.mass_rate[i];
        gain = std::max(gain, std::fabs(s.mass_rate[i] / s.mass[i]));
        for (std::size_t d = 0; d < 2; ++d) {
            change = std::max(change, std::fabs(s.acceleration[d][i] - s.v[d][i] * s.mass_rate[i] / s.mass[i]));
            fastest = std::max(fastest, std::fabs(s.shift[d][i]));
        }
    }
    CHECK(fastest > 0.01);
    CHECK(gain > 0.1);
    CHECK(std::fabs(sum) < 1e-12 * gain * total_mass(s));
    CHECK(change < 1e-10 * gain * common.norm());
}

TEST_CASE("a shift along a wall of normal fluxes changes velocities by their gradient, next to it as inside") {
    // v_x = a x under no pressure: dv_x/dt = δv_x a of a particle that moves with v + δv.
    const double a = 0.5, shift = 0.1;
    FluxDriver<2> driver = exchanging_tank(0);
    auto& s = driver.fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) s.v[0][i] = a * s.x[0][i];
    driver.rebuild();
    for (std::size_t i = 0; i < s.count; ++i) s.shift[0][i] = shift, s.shift[1][i] = 0;
    driver.rates(0, serial_loop, false);
    double least = 1e9, most = 0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (std::fabs(s.x[0][i] - 0.5 * width) > 0.3) continue;  // away from the walls across
        const double rate = s.acceleration[0][i] - s.v[0][i] * s.mass_rate[i] / s.mass[i];
        least = std::min(least, rate / (shift * a));
        most = std::max(most, rate / (shift * a));
        near += driver.walls.gamma(i) < 0.75;
    }
    MESSAGE("carried along: " << least << " to " << most);
    CHECK(near > 10);
    CHECK(least > 0.95);
    CHECK(most < 1.05);
}
