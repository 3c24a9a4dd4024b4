// Water at rest between walls of normal fluxes stays at rest, in the plane and in space, whatever the scheme.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins_3d.hpp"
#include "tests/fluid/normal_flux_still.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double depth_3d = 0.5;

FluxDriver<3> tank_3d(const FluxParameters& flux, Transport transport = Transport::none) {
    Fluid<3> fluid = still_fluid<3>(0.05, depth_3d, {{{0, 0, 0}, {0.6, 0.5, depth_3d}}}, 3, flux);
    fluid.transport = transport;
    fluid.prepare_particles();
    fluid.particles.resize(fluid.particles.count, 0);
    return {std::move(fluid), box_tank<3>({0.6, 0.5, 1})};
}

double total_mass(const Particles<3>& s) {
    double sum = 0;
    for (std::size_t i = 0; i < s.count; ++i) sum += s.mass[i];
    return sum;
}

}  // namespace

TEST_CASE("still water stays still between normal flux walls, in two and three dimensions") {
    SUBCASE("2D, within the bounds of ghost walls") {
        const double depth = 0.5, width = 0.8, spacing = 0.02;
        FluxDriver<2> driver(still_fluid<2>(spacing, depth, {{{0, 0}, {width, depth}}}), tank(width, 1.5 * depth));
        const Rest worst = worst_rest(driver, depth, width * depth, 20);
        CHECK(worst.fastest < 0.002);
        CHECK(worst.mean < 5e-4);
        CHECK(worst.pressure_error < 0.005);
        CHECK(worst.volume_error < 1e-4);
        CHECK(driver.fluid.held_back == 0);
        CHECK(driver.floored == 0);
        CHECK(driver.walls.deepest(driver.fluid.particles).depth == 0);
    }
    SUBCASE("3D") {
        FluxDriver<3> driver = tank_3d({});
        const Rest worst = worst_rest(driver, depth_3d, 0.6 * 0.5 * depth_3d, 10);
        CHECK(worst.fastest < 0.006);
        CHECK(worst.mean < 0.002);
        CHECK(worst.pressure_error < 0.007);
        CHECK(worst.volume_error < 1e-4);
        CHECK(driver.fluid.held_back == 0);
    }
}

TEST_CASE("still water in three dimensions stays still between normal flux walls with δ-SPH, and ALE and shifting") {
    // Within the bounds of Riemann-SPH above.
    FluxParameters flux;
    Transport transport = Transport::none;
    SUBCASE("δ-SPH") {
        flux.scheme = Scheme::delta_sph;
        flux.alpha = 0.2;
    }
    SUBCASE("exchange of mass, shifted") {
        flux.scheme = Scheme::riemann_ale;
        transport = Transport::shifting;
    }
    FluxDriver<3> driver = tank_3d(flux, transport);
    const double before = total_mass(driver.fluid.particles);
    const Rest worst = worst_rest(driver, depth_3d, 0.6 * 0.5 * depth_3d, 10);
    CHECK(worst.fastest < 0.006);
    CHECK(worst.mean < 0.002);
    CHECK(worst.pressure_error < 0.007);
    CHECK(worst.volume_error < 1e-4);
    CHECK(driver.fluid.held_back == 0);
    CHECK(driver.floored == 0);
    CHECK(std::fabs(total_mass(driver.fluid.particles) / before - 1) < 1e-13);
}

TEST_CASE("disordered water in a closed box of normal flux walls exchanges mass in space and loses none") {
    Random random(5);
    Fluid<3> fluid = make_fluid<3>(0.1, Tait{1000, 20}, {.scheme = Scheme::riemann_ale});
    fluid.transport = Transport::shifting;
    fluid.particles = place<3>(lattice<3>({10, 8, 8}, 0.1, 0.2, random), 0.1);
    fluid.prepare_particles();
    fluid.particles.resize(fluid.particles.count, 0);
    Panels<3> panels;
    add_box(panels, "box", Vec3::Zero(), {1, 0.8, 0.8}, true);
    FluxDriver<3> driver(std::move(fluid), std::move(panels));
    auto& s = driver.fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {  // a roll about the y axis
        s.v[0][i] = std::sin(3.14159265358979 * s.x[0][i]) * std::cos(3.14159265358979 / 0.8 * s.x[2][i]);
        s.v[2][i] = -0.8 * std::cos(3.14159265358979 * s.x[0][i]) * std::sin(3.14159265358979 / 0.8 * s.x[2][i]);
    }
    const double before = total_mass(s), each = s.mass[0];
    for (int step = 0; step < 25; ++step) driver.step(0.9 * driver.largest_step());
    double exchanged = 0;
    for (std::size_t i = 0; i < s.count; ++i) exchanged = std::max(exchanged, std::fabs(s.mass[i] / each - 1));
    MESSAGE("mass exchanged " << exchanged << " of a particle's, lost " << total_mass(s) / before - 1);
    CHECK(exchanged > 0.01);
    CHECK(std::fabs(total_mass(s) / before - 1) < 1e-13);
    CHECK(driver.walls.deepest(s).depth < 0.05);
}
