// The energy ledger closes: what the water gains is what the walls do, and what it loses is in the ledger, up to the
// error of the time integration.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins.hpp"
#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

struct Case {
    Scheme scheme = Scheme::riemann;
    IntegrationScheme integration = IntegrationScheme::rk4;
    bool muscl = false;
    double viscosity = 0;
    bool no_slip = false, piston = false;
};

// A tank under pressure, stirred; its left wall moves in where there is a piston.
Driver<2> stirred_tank(const Case& c) {
    Fluid<2> fluid =
        make_fluid<2>(0.1, Tait{1000, 20},
                      {.muscl = c.muscl, .scheme = c.scheme, .delta = 0.1, .alpha = 0.05, .gravity = {0.5, -9.81, 0}});
    fluid.integration.scheme = c.integration;
    fluid.viscosity.dynamic = c.viscosity;
    fluid.ledger.kept = true;
    fluid.lists.skin = 2 * fluid.spacing;
    Random random(3);
    fluid.particles = place<2>(lattice<2>({12, 10}, fluid.spacing, 0.1, random), fluid.spacing);
    auto& s = fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        s.v[0][i] = 0.5 * std::sin(3 * s.x[1][i]);
        s.v[1][i] = -0.4 * std::cos(3 * s.x[0][i]);
        s.deviation[i] = 40 + 3 * std::sin(2 * s.x[0][i] + s.x[1][i]);
        s.mass[i] = (1000 + s.deviation[i]) * fluid.spacing * fluid.spacing;
    }
    Driver<2> driver(std::move(fluid));
    Panels<2> panels;
    panels.add_wall("tank", {{0, 1}, {0, 0}, {1.2, 0}, {1.2, 1}}, true, c.no_slip);
    driver.walls = make_walls(std::move(panels));
    if (c.piston)
        driver.motion = [](Panels<2>& walls, double time) {
            for (const std::size_t vertex : {0u, 1u}) {
                walls.position[vertex].x() = 0.3 * time + 2 * time * time;
                walls.velocity[vertex] = {0.3 + 4 * time, 0.2};  // it slides, too
            }
        };
    return driver;
}

double energy_of_state(const Driver<2>& driver) {
    const auto e =
        energies(driver.fluid.particles, driver.fluid.flux.gravity, LaneRange{0, driver.fluid.particles.count});
    return e.kinetic + e.potential;
}

struct Balance {
    double residual, dissipation, viscous, walls, kinetic;  // the last at the start
};

Balance balance(const Case& c, int steps) {
    const double until = 0.02;
    Driver<2> driver = stirred_tank(c);
    driver.start();
    driver.fluid.ledger.last = {};
    if (c.integration == IntegrationScheme::verlet) {
        driver.ledger(0, 0, serial_loop);  // the rates of the initial state
        driver.fluid.ledger.sum = {};
    }
    const double before = energy_of_state(driver), no_gravity[3] = {0, 0, 0};
    const double kinetic =
        energies(driver.fluid.particles, no_gravity, LaneRange{0, driver.fluid.particles.count}).kinetic;
    for (int step = 0; step < steps; ++step) driver.step(until / steps);
    CHECK(driver.fluid.held_back == 0);
    const EnergyRates& sum = driver.fluid.ledger.sum;
    const double gained = energy_of_state(driver) - before + sum.compression + sum.dissipation + sum.viscous;
    return {std::fabs(gained - sum.walls), sum.dissipation, sum.viscous, sum.walls, kinetic};
}

}  // namespace

TEST_CASE("the energy balance closes with the order of the time integration") {
    for (const Scheme scheme : {Scheme::riemann, Scheme::delta_sph, Scheme::artificial_viscosity})
        for (const auto& [integration, order] :
             {std::pair{IntegrationScheme::rk4, 4.0}, {IntegrationScheme::rk3, 3.0}, {IntegrationScheme::verlet, 2.0}})
            for (const bool piston : {false, true}) {
                CAPTURE(static_cast<int>(scheme));
                CAPTURE(order);
                CAPTURE(piston);
                const Case c{
                    .scheme = scheme, .integration = integration, .viscosity = 5, .no_slip = true, .piston = piston};
                const int first = integration == IntegrationScheme::verlet ? 16 : 8;
                const Balance coarse = balance(c, first), fine = balance(c, 4 * first);
                CAPTURE(coarse.residual);
                CAPTURE(fine.residual);
                CHECK(fine.residual < coarse.residual / std::pow(4, order - 0.5));
                CHECK(fine.residual < 2e-4 * fine.kinetic);
            }
}

TEST_CASE("schemes and viscosity take energy out, walls that stand still do no work without friction") {
    for (const Scheme scheme : {Scheme::riemann, Scheme::delta_sph, Scheme::artificial_viscosity}) {
        CAPTURE(static_cast<int>(scheme));
        const Balance calm = balance({.scheme = scheme, .muscl = true, .viscosity = 5}, 16);
        CHECK(calm.viscous > 0);
        CHECK(calm.dissipation > 0);
        // Images of a corner are mirrored through a point, and gravity adds a pressure to every image.
        CHECK(std::fabs(calm.walls) < 0.2 * calm.dissipation);
        const Balance pushed = balance({.scheme = scheme, .muscl = true, .piston = true}, 16);
        // p = ρ0 c0² 0.04 … of the start, times 1 m × the way of the piston.
        CHECK(pushed.walls > 0.5 * Tait{1000, 20}.pressure(40) * 0.3 * 0.02);
    }
}
