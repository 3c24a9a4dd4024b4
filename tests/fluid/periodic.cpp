// Periodic directions: translation, sound, and that a domain of one period does what one of two periods does.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/fluid/basins_3d.hpp"
#include "tests/fluid/two_periods.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.1;

template <int D>
GhostWalls<D> periodic_walls(const std::array<int, D>& cells, const std::array<bool, D>& along, Panels<D> panels = {}) {
    GhostWalls<D> walls = make_ghost_walls(std::move(panels));
    walls.periodic.along = along;
    for (int d = 0; d < D; ++d) walls.periodic.high[d] = cells[std::size_t(d)] * spacing;
    return walls;
}

template <int D>
void check_translation(const std::array<int, D>& cells, const std::array<double, D>& speed) {
    CAPTURE(D);
    Random random;
    Driver<D> driver(make_fluid<D>(spacing, water));
    std::array<bool, D> everywhere;
    everywhere.fill(true);
    driver.walls = periodic_walls<D>(cells, everywhere);
    auto& s = driver.fluid.particles;
    s = place<D>(lattice<D>(cells, spacing, 0.2, random), spacing);
    std::vector<Vec<D>> home(s.count);
    for (std::size_t i = 0; i < s.count; ++i) {
        home[std::size_t(s.id[i])] = position(s, i);
        for (std::size_t d = 0; d < D; ++d) s.v[d][i] = speed[d];
    }
    // Three periods along x.
    const double period = cells[0] * spacing;
    driver.rebuild();
    driver.rates(0);
    driver.run(3 * period / speed[0]);
    CHECK(driver.fluid.rebuilds > 10);
    double off = 0, changed = 0;
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t d = 0; d < D; ++d) {
            const double moved = s.x[d][i] - home[std::size_t(s.id[i])][int(d)] - driver.time * speed[d];
            const double length = cells[d] * spacing;
            off = std::max(off, std::fabs(moved - length * std::round(moved / length)));
            changed = std::max(changed, std::fabs(s.v[d][i] - speed[d]) + std::fabs(s.deviation[i]));
            CHECK(s.x[d][i] > -spacing);
            CHECK(s.x[d][i] < length + spacing);
        }
    CHECK(off < 1e-12);
    CHECK(changed < 1e-13);
}

// A sound wave that travels along x: u = ε c sin(2π x/L), ρ' = ε ρ0 sin(2π x/L).
template <int D>
double sound_error(const std::array<int, D>& cells) {
    constexpr double amplitude = 1e-4;
    Driver<D> driver(make_fluid<D>(spacing, water));
    std::array<bool, D> everywhere;
    everywhere.fill(true);
    driver.walls = periodic_walls<D>(cells, everywhere);
    Random random;
    auto& s = driver.fluid.particles;
    s = place<D>(lattice<D>(cells, spacing, 0, random), spacing);
    const double length = cells[0] * spacing, c = water.sound_speed;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double wave = amplitude * std::sin(2 * std::numbers::pi * s.x[0][i] / length);
        s.v[0][i] = c * wave;
        s.deviation[i] = 1000 * wave;
        s.mass[i] = (1000 + s.deviation[i]) * std::pow(spacing, D);
    }
    driver.run(length / c);
    double error = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const double wave = std::sin(2 * std::numbers::pi * s.x[0][i] / length);
        error = std::max(error, std::fabs(s.v[0][i] / (c * amplitude) - wave));
        error = std::max(error, std::fabs(s.deviation[i] / (1000 * amplitude) - wave));
    }
    return error;
}

// The same flow in one period and in two. `walls` makes the walls of `periods` periods.
template <int D, class Walls, class Wet>
void check_two_periods(const std::array<int, D>& cells, Walls&& make, Wet&& wet, std::size_t least_masked) {
    CAPTURE(D);
    std::array<Driver<D>, 2> driver{Driver<D>(make_fluid<D>(spacing, water, {.gravity = {1, -0.5, 0}})),
                                    Driver<D>(make_fluid<D>(spacing, water, {.gravity = {1, -0.5, 0}}))};
    const double length = cells[0] * spacing;
    Random random(3);
    std::vector<Point<D>> points;
    for (const auto& x : lattice<D>(cells, spacing, 0.1, random))
        if (wet(x)) points.push_back(x);
    std::vector<Vec<D>> v(points.size());
    for (Vec<D>& of : v)
        for (int d = 0; d < D; ++d) of[d] = 1.5 * random();
    for (const int periods : {1, 2}) {
        Driver<D>& of = driver[std::size_t(periods - 1)];
        of.fluid.particles = in_periods<D>(periods, points, v, length, spacing);
        of.walls = make(periods);
        of.fluid.lists.skin *= 0.3;  // rebuilt more often
    }
    driver[0].rebuild();
    driver[0].rates(0);
    std::size_t masked = 0;
    for (const auto& block : driver[0].fluid.lists.blocks) masked += block.masked.size();
    CHECK(masked >= least_masked);
    const double dt = 0.5 * driver[0].largest_step();
    for (int k = 0; k < 40; ++k)
        for (auto& of : driver) of.step(dt);
    CHECK(driver[0].fluid.rebuilds > 1);
    check_same_in_both(driver[0].fluid.particles, driver[1].fluid.particles, length);
}

}  // namespace

TEST_CASE("uniform translation through many periods is exact") {
    check_translation<2>({16, 14}, {2, -1.3});
    check_translation<3>({8, 7, 6}, {2, -1.3, 0.7});
}

TEST_CASE("a sound wave travels round and comes back as it was") {
    const double coarse = sound_error<2>({30, 6}), fine = sound_error<2>({60, 6});
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(fine < 0.1);
    CHECK(fine < 0.5 * coarse);
    const double coarse_3 = sound_error<3>({16, 6, 6}), fine_3 = sound_error<3>({32, 6, 6});
    CAPTURE(coarse_3);
    CAPTURE(fine_3);
    CHECK(fine_3 < 0.5 * coarse_3);
}

TEST_CASE("the supports at the seams are as full as inside") {
    Driver<3> driver(make_fluid<3>(spacing, water));
    const std::array<int, 3> cells{7, 6, 9};
    Panels<3> panels;
    add_box(panels, "floor and lid", {-1, -1, 0}, Vec3(8, 7, 9) * spacing, true);
    // Only floor and lid are walls: the others lie outside and their planes are out of reach.
    panels.panels.erase(panels.panels.begin() + 2, panels.panels.begin() + 10);
    for (Vec3& x : panels.position) {
        x.x() = x.x() < 0 ? 0 : 7 * spacing;
        x.y() = x.y() < 0 ? 0 : 6 * spacing;
    }
    driver.walls = periodic_walls<3>(cells, {true, true, false}, panels);
    Random random;
    driver.fluid.particles = place<3>(lattice<3>(cells, spacing, 0, random), spacing);
    driver.rebuild();
    const auto& s = driver.fluid.particles;
    const double first = partition_of_unity(driver.fluid, 0);
    CHECK(first == doctest::Approx(1).epsilon(0.02));
    for (std::size_t i = 0; i < s.count; ++i)
        CHECK(partition_of_unity(driver.fluid, i) == doctest::Approx(first).epsilon(1e-12));
}

TEST_CASE("one period does what two do: alone, between walls, with a body beside the seam") {
    const auto everywhere = [](const auto&) { return true; };
    check_two_periods<2>(
        {12, 12},
        [](int periods) {
            return periodic_walls<2>({12 * periods, 12}, {true, true});
        },
        everywhere, 0);
    check_two_periods<3>(
        {6, 6, 6},
        [](int periods) {
            return periodic_walls<3>({6 * periods, 6, 6}, {true, true, true});
        },
        everywhere, 0);
    // A channel with an uneven floor and a thin plate that stands beside the seam.
    const auto channel = [](int periods) {
        Panels<2> panels;
        std::vector<Vec2> floor, lid;
        for (int k = 0; k < periods; ++k) {
            floor.push_back(Vec2(12 * k, 0) * spacing);
            floor.push_back(Vec2(12 * k + 5, 0) * spacing);
            floor.push_back(Vec2(12 * k + 8, -1) * spacing);
            lid.insert(lid.begin(), Vec2(12 * k, 12) * spacing);
        }
        floor.push_back(Vec2(12 * periods, -1) * spacing);
        lid.insert(lid.begin(), Vec2(12 * periods, 12) * spacing);
        floor[0].y() = -0.1;
        for (Vec2& x : floor)
            if (std::fabs(std::remainder(x.x(), 12 * spacing)) < 1e-9) x.y() = -0.1;
        panels.add_wall("floor", floor, false, false);
        panels.add_wall("lid", lid, false, true);
        for (int k = 0; k < periods; ++k) {
            const Vec2 low = Vec2(12 * k + 1, 4) * spacing, high = Vec2(12 * k + 2, 9) * spacing;
            panels.add_wall("plate", {low, {low.x(), high.y()}, high, {high.x(), low.y()}}, true, false);
        }
        return periodic_walls<2>({12 * periods, 12}, {true, false}, panels);
    };
    check_two_periods<2>(
        {12, 12}, channel,
        [](const Point<2>& x) {
            return x[0] < 0.9 * spacing || x[0] > 2.1 * spacing || x[1] < 3.9 * spacing || x[1] > 9.1 * spacing;
        },
        20);
    const auto box_channel = [](int periods) {
        Panels<3> panels;
        const double end = 9 * periods * spacing, side = 6 * spacing, top = 7 * spacing;
        panels.add_wall("floor", {{0, 0, 0}, {end, 0, 0}, {end, side, 0}, {0, side, 0}}, {{0, 1, 2}, {0, 2, 3}}, true);
        panels.add_wall("lid", {{0, 0, top}, {0, side, top}, {end, side, top}, {end, 0, top}}, {{0, 1, 2}, {0, 2, 3}},
                        false);
        for (int k = 0; k < periods; ++k)
            add_box(panels, "plate", Vec3(9 * k + 1, -1, 2) * spacing, Vec3(9 * k + 2, 7, 5) * spacing, false);
        return periodic_walls<3>({9 * periods, 6, 7}, {true, true, false}, panels);
    };
    check_two_periods<3>(
        {9, 6, 7}, box_channel,
        [](const Point<3>& x) {
            return x[0] < 0.9 * spacing || x[0] > 2.1 * spacing || x[2] < 1.9 * spacing || x[2] > 5.1 * spacing;
        },
        20);
}

TEST_CASE("a wall that is longer than the period is one wall") {
    // It lies beside its own copies at the seam, and along all of the period where it goes round half once more.
    const auto sums_over = [](double from, double to, auto dimension) {
        constexpr int D = dimension();
        std::array<int, D> cells;
        cells.fill(6);
        cells[0] = 12;
        std::array<bool, D> along;
        along.fill(true);
        along[D - 1] = false;
        Panels<D> panels;
        if constexpr (D == 2)
            panels.add_wall("floor", {{from, 0}, {to, 0}}, false, true);
        else
            panels.add_wall("floor", {{from, 0, 0}, {to, 0, 0}, {to, 6 * spacing, 0}, {from, 6 * spacing, 0}},
                            {{0, 1, 2}, {0, 2, 3}}, true);
        Driver<D> driver(make_fluid<D>(spacing, water));
        driver.walls = periodic_walls<D>(cells, along, panels);
        Random random;
        driver.fluid.particles = place<D>(lattice<D>(cells, spacing, 0, random), spacing);
        driver.rebuild();
        std::vector<double> sums;
        for (std::size_t i = 0; i < driver.fluid.particles.count; ++i)
            sums.push_back(partition_of_unity(driver.fluid, i));
        return sums;
    };
    const double period = 12 * spacing;
    const auto compare = [&](auto dimension) {
        const auto right = sums_over(0, period, dimension);
        for (const auto& [from, to] : {std::pair(-0.3, period + 0.25), std::pair(0.0, 1.5 * period)}) {
            CAPTURE(to);
            const auto sums = sums_over(from, to, dimension);
            double off = 0;
            for (std::size_t i = 0; i < right.size(); ++i) off = std::max(off, std::fabs(sums[i] - right[i]));
            CHECK(off < 1e-12);
        }
    };
    compare(std::integral_constant<int, 2>());
    compare(std::integral_constant<int, 3>());
}

TEST_CASE("a period shorter than the lists reach is refused") {
    Driver<2> driver(make_fluid<2>(spacing, water));
    Random random;
    driver.fluid.particles = place<2>(lattice<2>({4, 10}, spacing, 0, random), spacing);
    driver.walls = periodic_walls<2>({4, 10}, {true, false});
    CHECK_THROWS_AS(driver.rebuild(), std::invalid_argument);
}
