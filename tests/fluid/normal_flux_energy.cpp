// Energies of a fluid between walls of normal fluxes: the balance closes, nothing depends on a common velocity, and
// what is neither work nor dissipation goes away with the spacing.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins.hpp"
#include "tests/fluid/normal_flux_driver.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

struct Case {
    IntegrationScheme integration = IntegrationScheme::rk4;
    bool muscl = false;
    double viscosity = 0;
    bool no_slip = false, piston = false;
    ViscousOperator form = ViscousOperator::morris;
    Scheme scheme = Scheme::riemann;
};

// A tank under pressure, stirred; its left wall moves in where there is a piston.
FluxDriver<2> stirred_tank(const Case& c, double spacing, double jitter) {
    Fluid<2> fluid = make_fluid<2>(spacing, Tait{1000, 20},
                                   {.muscl = c.muscl, .scheme = c.scheme, .alpha = 0.2, .gravity = {0.5, -9.81, 0}});
    fluid.integration.scheme = c.integration;
    fluid.viscosity = {c.viscosity, c.form};
    fluid.ledger.kept = true;
    fluid.lists.skin = 0.2;
    Random random(3);
    const int columns = int(std::lround(1.2 / spacing)), rows = int(std::lround(1 / spacing));
    fluid.particles = place<2>(lattice<2>({columns, rows}, spacing, jitter, random), spacing);
    auto& s = fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double x = s.x[0][i], y = s.x[1][i], k = 3.14159265358979 / 1.2, l = 3.14159265358979;
        // Along the walls at the walls, but for disorder.
        s.v[0][i] = 0.5 * std::sin(k * x) * std::cos(l * y) + (c.piston ? 0.3 * (1 - x / 1.2) : 0);
        s.v[1][i] = -0.5 * k / l * std::cos(k * x) * std::sin(l * y);
        s.deviation[i] = 40 + 3 * std::sin(2 * x + y);
        s.mass[i] = (1000 + s.deviation[i]) * spacing * spacing;
    }
    Panels<2> panels;
    panels.add_wall("tank", {{0, 0}, {1.2, 0}, {1.2, 1}, {0, 1}}, false, c.no_slip);
    panels.add_wall("piston", {{0, 1}, {0, 0}}, false, c.no_slip);
    FluxDriver<2> driver(std::move(fluid), std::move(panels));
    if (c.piston)
        driver.motion = [](Panels<2>& walls, double time) {
            for (const std::size_t vertex : {4u, 5u}) {
                walls.position[vertex].x() = 0.3 * time + 2 * time * time;
                walls.velocity[vertex] = {0.3 + 4 * time, 0.2};  // it slides, too
            }
        };
    driver.rebuild();
    return driver;
}

double energy_of_state(const Fluid<2>& fluid, bool gravity = true) {
    const double none[3] = {0, 0, 0};
    const auto e = energies(fluid.particles, gravity ? fluid.flux.gravity : none, LaneRange{0, fluid.particles.count});
    return e.kinetic + e.potential;
}

struct Balance {
    double residual, kinetic;  // the last at the start
};

Balance balance(const Case& c, int steps) {
    const double until = 0.02;
    FluxDriver<2> driver = stirred_tank(c, 0.1, 0.1);
    const double before = energy_of_state(driver.fluid), kinetic = energy_of_state(driver.fluid, false);
    for (int step = 0; step < steps; ++step) driver.step(until / steps);
    CHECK(driver.fluid.held_back == 0);
    CHECK(driver.fluid.rebuilds == 1);
    const EnergyRates& sum = driver.fluid.ledger.sum;
    const double gained = energy_of_state(driver.fluid) - before;
    return {std::fabs(gained + sum.compression + sum.dissipation + sum.viscous + sum.defect - sum.walls), kinetic};
}

}  // namespace

TEST_CASE("the balance of a fluid between walls of normal fluxes closes with the order of the integration") {
    for (const auto& [integration, order] : {std::pair{IntegrationScheme::rk4, 4.0}, {IntegrationScheme::rk3, 3.0}})
        for (const bool piston : {false, true}) {
            CAPTURE(order);
            CAPTURE(piston);
            Case c{.integration = integration, .viscosity = 5, .no_slip = true, .piston = piston};
            if (piston) c.form = ViscousOperator::monaghan_gingold, c.scheme = Scheme::delta_sph;
            const Balance coarse = balance(c, 8), fine = balance(c, 32);
            CAPTURE(coarse.residual);
            CAPTURE(fine.residual);
            CHECK(fine.residual < coarse.residual / std::pow(4, order - 0.5));
            CHECK(fine.residual < 2e-4 * fine.kinetic);
        }
}

TEST_CASE("a velocity that water and walls have in common changes works by the force times it, and nothing else") {
    for (const bool muscl : {false, true}) {
        const Case c{.muscl = muscl, .viscosity = 5, .no_slip = true, .piston = true};
        FluxDriver<2> driver = stirred_tank(c, 0.1, 0.2);
        driver.rates(0);
        std::vector<double> own, other;
        const EnergyRates at_rest = driver.energies(&own);
        const Vec2 common(3, -2);
        const Vec2 force = driver.total_force();
        for (std::size_t i = 0; i < driver.fluid.particles.count; ++i)
            for (std::size_t d = 0; d < 2; ++d) driver.fluid.particles.v[d][i] += common[int(d)];
        driver.motion = nullptr;
        for (Vec2& v : driver.walls.panels.velocity) v += common;
        driver.walls.update_geometry();
        driver.rates(0);
        const EnergyRates moving = driver.energies(&other);
        const double scale = std::fabs(force.dot(common));
        REQUIRE(scale > 100);
        CHECK(std::fabs(moving.walls - at_rest.walls + force.dot(common)) < 1e-10 * scale);
        CHECK(std::fabs(other[0] + other[1] - moving.walls) < 1e-10 * scale);
        CHECK(std::fabs(moving.compression - at_rest.compression) < 1e-10 * scale);
        CHECK(std::fabs(moving.dissipation - at_rest.dissipation) < 1e-10 * scale);
        CHECK(std::fabs(moving.viscous - at_rest.viscous) < 1e-10 * scale);
        CHECK(std::fabs(moving.defect - at_rest.defect) < 1e-10 * scale);
        CHECK(at_rest.dissipation > 0);
        CHECK(at_rest.viscous > 0);
    }
}

TEST_CASE("walls at rest do no work, and a piston pushes with the pressure") {
    const Case calm{.muscl = true}, pushed{.muscl = true, .piston = true};
    FluxDriver<2> driver = stirred_tank(calm, 0.05, 0);
    driver.rates(0);
    std::vector<double> work;
    driver.energies(&work);
    CHECK(work == std::vector<double>{0, 0});
    driver = stirred_tank(pushed, 0.05, 0);
    driver.rates(0);
    driver.energies(&work);
    CHECK(work[0] == 0);
    double expected = 0;  // ∫ p u dy
    for (int k = 0; k < 1000; ++k) {
        const double y = (k + 0.5) / 1000;
        expected += Tait{1000, 20}.pressure(40 + 3 * std::sin(y)) * 0.3 / 1000;
    }
    MESSAGE("power of the piston " << work[1] << ", expected " << expected);
    CHECK(work[1] == doctest::Approx(expected).epsilon(0.05));
}

TEST_CASE("what walls of normal fluxes neither dissipate nor pass on vanishes with the spacing") {
    const auto defect = [](double spacing) {
        FluxDriver<2> driver = stirred_tank({.muscl = true, .piston = true}, spacing, 0);
        driver.rates(0);
        const EnergyRates rates = driver.energies();
        return std::fabs(rates.defect / rates.walls);
    };
    const double coarse = defect(0.1), middle = defect(0.05), fine = defect(0.025);
    MESSAGE("defect over the piston's power " << coarse << ", " << middle << ", " << fine);
    CHECK(fine < 0.6 * middle);
    CHECK(middle < 0.7 * coarse);
}
