// Corners of ghost walls: the support of a particle beside any of them is as full as inside, and no place behind a wall
// counts twice.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/fluid/supports.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.05, R = support_ratio * spacing;

// Of a particle in the middle of a large lattice.
Spread inside() {
    static const Spread found = [] {
        const auto points = cells_where(15, 15, spacing, [](auto) { return true; });
        Panels<2> far;
        far.add_wall("far", {{100, 1}, {100, 0}}, false, false);
        return spread(settle(points, spacing, far),
                      [](const Vec2& x) { return (x - Vec2(7.5, 7.5) * spacing).norm() < 0.1 * spacing; });
    }();
    return found;
}

double outside_distance(const Vec2& x, const Vec2& low, const Vec2& high) {
    return std::hypot(std::max({low.x() - x.x(), 0.0, x.x() - high.x()}),
                      std::max({low.y() - x.y(), 0.0, x.y() - high.y()}));
}

// A line of sight through the very vertex of a convex corner enters the wall on either side: not counted.
std::size_t places_seen_twice(const Driver<2>& driver) {
    const auto& s = driver.fluid.particles;
    const auto grazes = [&](std::size_t i, std::size_t j) {
        const Vec2 sight = (position(s, j) - position(s, i)).normalized();
        for (const Vec2& vertex : driver.walls->panels.position)
            if (std::fabs(cross(sight, vertex - position(s, i))) < 1e-9) return true;
        return false;
    };
    return test::places_seen_twice(driver, grazes);
}

}  // namespace

TEST_CASE("beside a wall and in a right-angled corner the support is as full as inside") {
    const auto points = cells_where(20, 20, spacing, [](auto) { return true; });
    const Driver<2> driver = settle(points, spacing, tank(20 * spacing, 2));
    REQUIRE(driver.walls->corners.size() == 2);
    const Spread near = spread(driver, [](const Vec2& x) { return x.y() < 1 - R; });
    REQUIRE(inside().count == 1);
    CHECK(near.count == 320);
    CHECK(near.least == doctest::Approx(inside().least).epsilon(1e-12));
    CHECK(near.most == doctest::Approx(inside().least).epsilon(1e-12));
    CHECK(near.least_unity == doctest::Approx(inside().least_unity).epsilon(1e-12));
    CHECK(near.most_unity == doctest::Approx(inside().least_unity).epsilon(1e-12));
    CHECK(places_seen_twice(driver) == 0);
}

TEST_CASE("round a thick body, convex corners included, every place behind its walls is seen once") {
    // A body of 12 × 10 spacings in a pool of 44 × 42; then one off the lattice, with water in front of it by half a
    // spacing at least.
    for (const double shift : {0.0, 0.3}) {
        CAPTURE(shift);
        const Vec2 low = Vec2(16 + shift, 16 + shift) * spacing, high = Vec2(28 - shift, 26 - shift) * spacing;
        const auto points = cells_where(44, 42, spacing, [&](const Point<2>& x) {
            return x[0] < 16 * spacing || x[0] > 28 * spacing || x[1] < 16 * spacing || x[1] > 26 * spacing;
        });
        Panels<2> panels;
        add_body(panels, low, high);
        const Driver<2> driver = settle(points, spacing, panels);
        CHECK(driver.walls->corners.empty());
        const Spread near = spread(driver, [&](const Vec2& x) { return outside_distance(x, low, high) < R; });
        CAPTURE(near.least);
        CAPTURE(near.most);
        CAPTURE(near.least_unity);
        CAPTURE(near.most_unity);
        CHECK(near.count > 200);
        CHECK(near.most < 1.1);
        CHECK(near.least > 0.7);
        CHECK(near.most_unity < 1.1);
        CHECK(near.least_unity > 0.8);
        if (shift == 0) CHECK(places_seen_twice(driver) == 0);
    }
}

TEST_CASE("water on the two sides of a thin body does not mix, and no place counts twice") {
    for (const double thickness : {0.02, 0.5, 1.0, 2.0, 3.0}) {  // spacings
        CAPTURE(thickness);
        // A plate from the middle of the pool upwards, its lower end in the water.
        const double left = 15 * spacing, right = left + thickness * spacing, bottom = 14 * spacing;
        std::vector<Point<2>> points = cells_where(15, 30, spacing, [](auto) { return true; });
        for (auto x : cells_where(15, 30, spacing, [](auto) { return true; })) {
            x[0] += right;
            points.push_back(x);
        }
        // Below the plate the gap is filled with whole columns, as many as fit.
        const int columns = static_cast<int>(thickness);
        for (auto x : cells_where(columns, 14, spacing, [](auto) { return true; })) {
            x[0] += left;
            points.push_back(x);
        }
        Panels<2> panels;
        add_body(panels, {left, bottom}, {right, 2});
        const Driver<2> driver = settle(points, spacing, panels);
        CHECK(driver.walls->corners.empty());
        const auto& s = driver.fluid.particles;
        std::size_t across = 0, ghosts_seen = 0;
        for (std::size_t i = 0; i < s.count; ++i)
            for (const std::size_t j : neighbours_of(driver.fluid, i)) {
                ghosts_seen += j >= s.ghost_begin();
                if (j >= s.ghost_begin()) continue;
                // Does the segment cross the plate? At the height where it passes the plate's middle.
                const double middle = 0.5 * (left + right);
                if ((s.x[0][i] < left) != (s.x[0][j] < left) && (s.x[0][i] < right) != (s.x[0][j] < right)) {
                    const double along = (middle - s.x[0][i]) / (s.x[0][j] - s.x[0][i]);
                    const double y = s.x[1][i] + along * (s.x[1][j] - s.x[1][i]);
                    across += y > bottom + 0.5 * thickness * spacing;
                }
            }
        CHECK(across == 0);
        CHECK(ghosts_seen > 1000);
        const auto near = spread(driver, [&](const Vec2& x) {
            return outside_distance(x, {left, bottom}, {right, 2}) < R && x.y() < 30 * spacing - R;
        });
        CAPTURE(near.least);
        CAPTURE(near.most);
        CAPTURE(near.least_unity);
        CAPTURE(near.most_unity);
        CHECK(near.most < 1.1);
        CHECK(near.most_unity < 1.1);
        CHECK(near.least_unity > 0.7);
        // Well above the plate's end it is a flat wall.
        const auto flank = spread(driver, [&](const Vec2& x) {
            return outside_distance(x, {left, bottom}, {right, 2}) < R && x.y() < 30 * spacing - R &&
                   x.y() > bottom + R;
        });
        CHECK(flank.least == doctest::Approx(inside().least).epsilon(1e-12));
        CHECK(flank.most == doctest::Approx(inside().least).epsilon(1e-12));
    }
}

namespace {

// A plate on a floor, or `gap` spacings above it, water on its left or on both sides.
Driver<2> plate_on_floor(double gap, int width, bool both_sides) {
    const double left = 12 * spacing, right = (12 + width) * spacing, end = (24 + width) * spacing;
    const auto points = cells_where(24 + width, 20, spacing,
                                    [&](const Point<2>& x) { return x[0] < left || (both_sides && x[0] > right); });
    Panels<2> panels = tank(end, 2);
    add_body(panels, {left, gap * spacing}, {right, 2});
    return settle(points, spacing, panels);
}

bool below_surface(const Vec2& x) {
    return x.y() < 20 * spacing - R;
}

}  // namespace

TEST_CASE("where a body stands on a floor, or nearly, the corner is filled as one of the tank's") {
    for (const double gap : {0.0, 0.2, 0.45}) {  // spacings
        for (const int width : {1, 3, 6}) {
            CAPTURE(gap);
            CAPTURE(width);
            const Driver<2> driver = plate_on_floor(gap, width, false);
            CHECK(driver.walls->corners.size() == 4);  // two of the tank, two at the foot of the body
            const Spread near = spread(driver, below_surface);
            CHECK(near.count == 12 * 16);
            CHECK(near.least == doctest::Approx(inside().least).epsilon(1e-9));
            CHECK(near.most == doctest::Approx(inside().least).epsilon(1e-9));
            CHECK(places_seen_twice(driver) == 0);
        }
    }
    // With room below it there is no corner.
    CHECK(plate_on_floor(1.2, 3, false).walls->corners.size() == 2);
}

TEST_CASE("a side of a body meets its floor once, however short its panels are") {
    // Of these several vertices are nearer to the floor than half a spacing, at which a gap counts as closed; a body
    // may also reach through its floor.
    for (const double length : {0.45, 0.2, 0.05}) {  // of a panel, spacings
        for (const double gap : {0.0, 0.13, -0.13}) {
            CAPTURE(length);
            CAPTURE(gap);
            const double left = 12 * spacing, right = 15 * spacing, low = gap * spacing;
            const int pieces = int(std::ceil((2 - low) / (length * spacing)));
            std::vector<Vec2> outline;
            for (int k = 0; k <= pieces; ++k) outline.push_back({left, low + k * (2 - low) / pieces});
            for (int k = pieces; k >= 0; --k) outline.push_back({right, low + k * (2 - low) / pieces});
            Panels<2> panels = tank(27 * spacing, 2);
            panels.add_wall("body", outline, true, false);
            const auto points = cells_where(27, 20, spacing, [&](const Point<2>& x) { return x[0] < left; });
            const Driver<2> driver = settle(points, spacing, panels);
            CHECK(driver.walls->corners.size() == 4);
            const Spread near = spread(driver, below_surface);
            CHECK(near.count == 12 * 16);
            CHECK(near.least == doctest::Approx(inside().least).epsilon(1e-9));
            CHECK(near.most == doctest::Approx(inside().least).epsilon(1e-9));
        }
    }
}

TEST_CASE("a plate thinner than R with water on both sides: the floor below its foot is seen once") {
    // The left water must see neither the ghosts of the right foot's corner nor those that the floor mirrors from the
    // right water: through the floor on its own side the left foot's corner has put ghosts already.
    for (const int width : {1, 3}) {
        CAPTURE(width);
        const Driver<2> driver = plate_on_floor(0.2, width, true);
        const Spread near = spread(driver, [](const Vec2& x) { return x.y() < R; });
        CHECK(near.most < 1.1);
        CHECK(near.most_unity < 1.1);
        CHECK(places_seen_twice(driver) == 0);
    }
}

TEST_CASE("the ghosts of a thin plate's far side are seen nowhere on its near side") {
    // Such a ghost comes out of the near side by up to R, hence within R of particles up to 2R away, whose cell of the
    // panel grid knows only panels within R.
    for (const int columns : {13, 14, 15, 16, 17})
        for (const int width : {1, 2, 3}) {
            CAPTURE(columns);
            CAPTURE(width);
            const double left = columns * spacing, right = (columns + width) * spacing;
            const auto points = cells_where(2 * columns + width, 16, spacing,
                                            [&](const Point<2>& x) { return x[0] < left || x[0] > right; });
            Panels<2> panels;
            add_body(panels, {left, -1}, {right, 2});
            const Driver<2> driver = settle(points, spacing, panels);
            const Spread all = spread(driver, [&](const Vec2& x) {
                return x.y() > R && x.y() < 16 * spacing - R && x.x() > R &&
                       x.x() < (2 * columns + width) * spacing - R;
            });
            CHECK(all.most == doctest::Approx(inside().least).epsilon(1e-9));
            CHECK(all.most_unity < 1.01);
            CHECK(places_seen_twice(driver) == 0);
        }
}

TEST_CASE("a body does not touch itself, however thin") {
    const double left = 12 * spacing, thickness = 0.2 * spacing;
    // Panels shorter than the plate is thick, as a fine mesh makes them.
    std::vector<Vec2> points;
    for (int k = 0; k <= 100; ++k) points.push_back({left, 0.3 + 0.01 * k});
    for (int k = 100; k >= 0; --k) points.push_back({left + thickness, 0.3 + 0.01 * k});
    Panels<2> panels;
    panels.add_wall("plate", points, true, false);
    const auto cells = cells_where(24, 20, spacing, [](const Point<2>&) { return true; });
    const Driver<2> driver = settle(cells, spacing, panels);
    CHECK(driver.walls->corners.empty());
}

TEST_CASE("around a blunt edge of a step no support has a hole in the water beyond") {
    const double spacing = 0.1;
    const auto points =
        cells_where(20, 20, spacing, [](const Point<2>& x) { return x[0] < 1 || x[1] > 1; });  // a step at (1, 1)
    Panels<2> panels;
    panels.add_wall("tank", {{0, 3}, {0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 3}}, false, false);
    const Driver<2> driver = settle(points, spacing, panels);
    const auto& s = driver.fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (s.x[1][i] > 2 - 4 * spacing) continue;  // the free surface
        CAPTURE(s.x[0][i]);
        CAPTURE(s.x[1][i]);
        // Without sight through the very edge 0.94 beside it; where the images of the upper floor were not hidden from
        // particles at the foot of the step 1.10; without sight round the edge the fullness was 0.78.
        CHECK(partition_of_unity(driver.fluid, i) > 0.995);
        CHECK(partition_of_unity(driver.fluid, i) < 1.005);
        CHECK(s.fullness[i] > 0.95);
    }
}
