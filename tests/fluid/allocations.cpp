// Nothing is allocated inside a step, once lists are built.
#include <doctest/doctest.h>

#include "tests/fluid/basins.hpp"
#include "tests/solid/allocation_count.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;
using aquagraph::solid::test::allocations;

TEST_CASE("the count sees plain and aligned memory") {
    long before = allocations();
    const std::vector<double> plain(3);
    CHECK(allocations() > before);
    before = allocations();
    const Scalars aligned(3);
    CHECK(allocations() > before);
}

TEST_CASE("gradients, ghosts, fluxes and stages allocate nothing") {
    const double spacing = 0.02;
    Panels<2> panels = tank(0.6, 1);
    add_body(panels, {0.3, 0.2}, {0.32, 0.3});  // so that masks are needed
    const auto water_cells = cells_where(
        30, 20, spacing, [](const Point<2>& x) { return x[0] < 0.3 || x[0] > 0.32 || x[1] < 0.2 || x[1] > 0.3; });
    Driver<2> driver = settle(water_cells, spacing, panels, {.gravity = {0, -9.81, 0}});
    std::size_t masked = 0;
    for (const NeighbourBlock& block : driver.fluid.lists.blocks) masked += block.masked.size();
    CHECK(masked > 0);
    const long before = allocations();
    for (int k = 0; k < 3; ++k) {
        driver.step(1e-5);
        driver.largest_step();
    }
    const long during = allocations() - before;
    CHECK(during == 0);
    CHECK(driver.fluid.rebuilds == 1);

    Driver<3> three(make_fluid<3>(0.1, water));
    Random random;
    three.fluid.particles = place<3>(lattice<3>({6, 6, 6}, 0.1, 0.1, random), 0.1);
    three.rebuild();
    const long before_three = allocations();
    for (int k = 0; k < 3; ++k) three.step(1e-5);
    const long during_three = allocations() - before_three;
    CHECK(during_three == 0);
    CHECK(three.fluid.rebuilds == 1);
}

TEST_CASE("a second rebuild of the lists of an unchanged state allocates nothing either") {
    const double spacing = 0.02;
    Driver<2> driver(make_fluid<2>(spacing, water));
    fill<2>(driver.fluid.particles, {{{0, 0}, {0.6, 0.4}}}, spacing, water, 9.81, 0.4);
    driver.rebuild();
    driver.rebuild();
    const long before = allocations();
    driver.rebuild();
    const long during = allocations() - before;
    CHECK(during == 0);
}
