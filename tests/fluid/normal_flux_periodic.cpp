// Walls of normal fluxes in a periodic domain.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/basins_3d.hpp"
#include "tests/fluid/normal_flux_driver.hpp"
#include "tests/fluid/two_periods.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.1;

// The same flow in one period and in two; make(periods) gives the panels.
template <int D, class Walls, class Wet>
void check_two_periods(const std::array<int, D>& cells, const std::array<bool, D>& along, Walls&& make, Wet&& wet) {
    CAPTURE(D);
    const double length = cells[0] * spacing;
    Random random(3);
    std::vector<Point<D>> points;
    for (const auto& x : lattice<D>(cells, spacing, 0.1, random))
        if (wet(x)) points.push_back(x);
    std::vector<Vec<D>> v(points.size());
    for (Vec<D>& of : v)
        for (int d = 0; d < D; ++d) of[d] = 0.5 * random();
    std::vector<FluxDriver<D>> driver;
    for (const int periods : {1, 2}) {
        Fluid<D> fluid = make_fluid<D>(spacing, water, {.gravity = {1, -0.5, 0}});
        fluid.viscosity = {5, ViscousOperator::morris};
        fluid.particles = in_periods<D>(periods, points, v, length, spacing);
        fluid.lists.skin *= 0.3;  // rebuilt more often
        FluxDriver<D>& of = driver.emplace_back(std::move(fluid), make(periods));
        Periodic<D> periodic;
        periodic.along = along;
        for (int d = 0; d < D; ++d) periodic.high[d] = cells[std::size_t(d)] * spacing;
        periodic.high[0] = periods * length;
        of.walls.repeat(periodic);
        of.walls.panels.find_joints();
        of.rebuild();
        of.rates(0);
    }
    // Supports at the seam are completed as inside: γ of every particle is that of its twin.
    const double dt = 0.5 * driver[0].largest_step();
    for (int k = 0; k < 40; ++k)
        for (auto& of : driver) of.step(dt);
    CHECK(driver[0].fluid.rebuilds > 1);
    CHECK(driver[0].walls.near_wall_count() * 2 == driver[1].walls.near_wall_count());
    check_same_in_both(driver[0].fluid.particles, driver[1].fluid.particles, length);
    // What walls bear adds up, whichever copy has borne it.
    const Vec<D> force = driver[0].total_force(), twice = driver[1].total_force();
    CHECK((2 * force - twice).norm() < 1e-6 * twice.norm());
}

}  // namespace

TEST_CASE("between walls of normal fluxes one period does what two do, with a body beside the seam") {
    const auto channel = [](int periods) {
        Panels<2> panels;
        std::vector<Vec2> floor, lid;
        for (int k = 0; k < periods; ++k) {
            for (const auto& [x, y] : {std::pair(0, -1), {5, 0}, {8, -1}})
                floor.push_back(Vec2(12 * k + x, y) * spacing);
            lid.insert(lid.begin(), Vec2(12 * k, 12) * spacing);
        }
        floor.push_back(Vec2(12 * periods, -1) * spacing);
        lid.insert(lid.begin(), Vec2(12 * periods, 12) * spacing);
        panels.add_wall("floor", floor, false, true);
        panels.add_wall("lid", lid, false, false);
        for (int k = 0; k < periods; ++k) {
            const Vec2 low = Vec2(12 * k + 1, 4) * spacing, high = Vec2(12 * k + 2, 9) * spacing;
            panels.add_wall("plate", {low, {low.x(), high.y()}, high, {high.x(), low.y()}}, true, false);
        }
        return panels;
    };
    check_two_periods<2>({12, 12}, {true, false}, channel, [](const Point<2>& x) {
        return x[0] < 0.9 * spacing || x[0] > 2.1 * spacing || x[1] < 3.9 * spacing || x[1] > 9.1 * spacing;
    });
    const auto box_channel = [](int periods) {
        Panels<3> panels;
        const double side = 6 * spacing, top = 7 * spacing;
        // Triangles and with them points are the same in every period.
        for (int k = 0; k < periods; ++k) {
            const double at = 9 * k * spacing, end = at + 9 * spacing;
            panels.add_wall("floor", {{at, 0, 0}, {end, 0, 0}, {end, side, 0}, {at, side, 0}}, {{0, 1, 2}, {0, 2, 3}},
                            true);
            panels.add_wall("lid", {{at, 0, top}, {at, side, top}, {end, side, top}, {end, 0, top}},
                            {{0, 1, 2}, {0, 2, 3}}, false);
        }
        for (int k = 0; k < periods; ++k)
            add_box(panels, "plate", Vec3(9 * k + 1, 1, 2) * spacing, Vec3(9 * k + 2, 4, 5) * spacing, false);
        return panels;
    };
    check_two_periods<3>({9, 6, 7}, {true, true, false}, box_channel, [](const Point<3>& x) {
        return x[0] < 0.9 * spacing || x[0] > 2.1 * spacing || x[1] < 0.9 * spacing || x[1] > 4.1 * spacing ||
               x[2] < 1.9 * spacing || x[2] > 5.1 * spacing;
    });
}

TEST_CASE("a wall of normal fluxes that lies on its own copy is refused") {
    Periodic<2> along_x;
    along_x.along = {true, false};
    along_x.high = {1.2, 0};
    const auto repeat = [&](double from, double to) {
        FluxDriver<2> driver(make_fluid<2>(spacing, water), [&] {
            Panels<2> panels;
            panels.add_wall("floor", {{from, 0}, {to, 0}}, false, false);
            return panels;
        }());
        driver.walls.repeat(along_x);
        return driver.walls.panels.copies;
    };
    CHECK(repeat(0, 1.2) == 2);
    CHECK(repeat(-0.3, 0.9) == 2);  // it need not end where the domain does
    CHECK_THROWS_WITH_AS(repeat(0, 1.3), doctest::Contains("'floor' is longer than the period"), std::invalid_argument);
}
