// Edges and corners of ghost walls in 3D: the support of a particle beside any of them is as full as inside, and no
// place behind a wall counts twice.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "tests/fluid/basins_3d.hpp"
#include "tests/fluid/supports.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.1, R = support_ratio * spacing;

// Of a particle in the middle of a large lattice.
Spread inside() {
    static const Spread found = [] {
        const auto points = cells_where({11, 11, 11}, spacing, [](auto) { return true; });
        Panels<3> far;
        far.add_wall("far", {{100, 0, 0}, {100, 1, 0}, {100, 0, 1}}, {{0, 1, 2}}, false);
        return spread(settle(points, spacing, far),
                      [](const Vec3& x) { return (x - Vec3::Constant(5.5) * spacing).norm() < 0.1 * spacing; });
    }();
    return found;
}

void check_as_inside(const Spread& near) {
    CHECK(near.least == doctest::Approx(inside().least).epsilon(1e-9));
    CHECK(near.most == doctest::Approx(inside().least).epsilon(1e-9));
    CHECK(near.least_unity == doctest::Approx(inside().least_unity).epsilon(1e-9));
    CHECK(near.most_unity == doctest::Approx(inside().least_unity).epsilon(1e-9));
}

// Lines of sight through the very edge of a panel are not counted where that is allowed.
std::size_t places_seen_twice(const Driver<3>& driver, bool grazing_allowed = false) {
    const auto& s = driver.fluid.particles;
    const auto& panels = driver.walls->panels;
    const auto grazes = [&](std::size_t i, std::size_t j) {
        if (!grazing_allowed) return false;
        const Vec3 a = position(s, i), b = position(s, j);
        for (std::size_t k = 0; k < panels.size(); ++k)
            for (std::size_t v = 0; v < 3; ++v) {
                const Vec3 p = panels.vertex(k, v), e = panels.vertex(k, (v + 1) % 3) - p;
                const Vec3 across = e.cross(Vec3(b - a));
                if (std::fabs(across.dot(p - a)) < 1e-9 * std::max(across.norm(), 1e-3)) return true;
            }
        return false;
    };
    return test::places_seen_twice(driver, grazes);
}

double outside_distance(const Vec3& x, const Vec3& low, const Vec3& high) {
    return (low - x).cwiseMax(x - high).cwiseMax(Vec3::Zero()).norm();
}

}  // namespace

TEST_CASE("a tank of triangles: faces, edges and corners are as full as inside") {
    const Vec3 size = Vec3(11, 10, 12) * spacing;
    const auto points = cells_where({11, 10, 9}, spacing, [](auto) { return true; });
    for (const int refinement : {0, 3}) {
        CAPTURE(refinement);
        const Driver<3> driver = settle(points, spacing, refined(tank(size), refinement));
        std::size_t corners = 0;
        for (const auto& corner : driver.walls->corners) corners += corner.is_point();
        CHECK(corners == 4);
        const Spread near = spread(driver, [](const Vec3& x) { return x.z() < 9 * spacing - R; });
        CHECK(near.count == 11 * 10 * 5);
        check_as_inside(near);
        CHECK(places_seen_twice(driver) == 0);
    }
}

TEST_CASE("a tank off the lattice and turned has the same supports") {
    // Turning about two axes, every line of sight askew.
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(0.4, Vec3::UnitZ()) * Eigen::AngleAxisd(0.7, Vec3::UnitX())).toRotationMatrix();
    const Vec3 size = Vec3(10, 10, 12) * spacing, shift(0.3, -1.2, 0.7);
    auto points = cells_where({10, 10, 8}, spacing, [](auto) { return true; });
    for (auto& p : points) {
        const Vec3 x = turn * Vec3(p[0], p[1], p[2]) + shift;
        p = {x.x(), x.y(), x.z()};
    }
    Panels<3> panels = refined(tank(size), 1);
    for (Vec3& x : panels.position) x = turn * x + shift;
    const Driver<3> driver = settle(points, spacing, panels);
    const Spread near = spread(
        driver, [&](const Vec3& x) { return (turn.transpose() * (x - shift)).z() < 8 * spacing - R - 0.01 * spacing; });
    CHECK(near.count == 400);
    check_as_inside(near);
}

TEST_CASE("round a box in water, convex edges and corners included, every place behind its walls is seen once") {
    const Vec3 low = Vec3(6, 6, 6) * spacing, high = Vec3(12, 11, 12) * spacing;
    const auto points =
        cells_where({18, 17, 18}, spacing, [&](const Vec3& x) { return outside_distance(x, low, high) > 0; });
    Panels<3> panels;
    add_box(panels, "body", low, high, false);
    const Driver<3> driver = settle(points, spacing, panels);
    CHECK(driver.walls->corners.empty());
    const Spread near = spread(driver, [&](const Vec3& x) {
        return outside_distance(x, low, high) < R && (x.array() > R).all() &&
               (x.array() < (Vec3(18, 17, 18) * spacing).array() - R).all();
    });
    CAPTURE(near.least);
    CAPTURE(near.most);
    CAPTURE(near.least_unity);
    CAPTURE(near.most_unity);
    CAPTURE(near.mean_unity);
    CHECK(near.count > 200);
    CHECK(near.most_unity < 1.1);
    CHECK(near.least_unity > 0.8);
    CHECK(near.most < 1.1);
    CHECK(near.least > 0.7);
    CHECK(places_seen_twice(driver, true) == 0);
}

TEST_CASE("water on the two sides of a thin plate does not mix, and no place counts twice") {
    for (const double thickness : {0.02, 1.0, 2.0})  // spacings
        for (const int refinement : {0, 3}) {
            CAPTURE(thickness);
            CAPTURE(refinement);
            const double left = 6 * spacing, right = left + thickness * spacing;
            auto points = cells_where({6, 10, 10}, spacing, [](auto) { return true; });
            for (auto x : std::vector<Point<3>>(points)) {
                x[0] += right;
                points.push_back(x);
            }
            Panels<3> panels;
            add_box(panels, "plate", {left, -2, -2}, {right, 3, 3}, false);
            const Driver<3> driver = settle(points, spacing, refined(panels, refinement));
            CHECK(driver.walls->corners.empty());
            const auto& s = driver.fluid.particles;
            std::size_t across = 0, ghosts_seen = 0;
            for (std::size_t i = 0; i < s.count; ++i)
                for (const std::size_t j : neighbours_of(driver.fluid, i)) {
                    ghosts_seen += j >= s.ghost_begin();
                    across += j < s.ghost_begin() && (s.x[0][i] < left) != (s.x[0][j] < left);
                }
            CHECK(across == 0);
            CHECK(ghosts_seen > 1000);
            const auto flank = spread(driver, [&](const Vec3& x) {
                return x.y() > R && x.y() < 10 * spacing - R && x.z() > R && x.z() < 10 * spacing - R && x.x() > R &&
                       x.x() < 12 * spacing + right - left - R;
            });
            CHECK(flank.count == 2 * 2 * 4);
            check_as_inside(flank);
            CHECK(places_seen_twice(driver) == 0);
        }
}

TEST_CASE("where a body stands on a floor and between walls, or nearly, edges and corners are filled as a tank's") {
    // A wall across the whole tank, its own mesh, water on its left.
    const Vec3 size = Vec3(16, 10, 14) * spacing;
    const double left = 10 * spacing, right = 13 * spacing;
    const auto points = cells_where({10, 10, 9}, spacing, [](auto) { return true; });
    for (const double gap : {0.0, 0.2, 0.4})  // spacings
        for (const int refinement : {0, 2}) {
            CAPTURE(gap);
            CAPTURE(refinement);
            Panels<3> panels = refined(tank(size), refinement), body;
            add_box(body, "gate", {left, gap * spacing, gap * spacing}, {right, size.y() - gap * spacing, 14 * spacing},
                    false);
            body = refined(body, refinement);
            const int base = int(panels.position.size());
            std::vector<std::array<int, 3>> triangles;
            for (const auto& panel : body.panels) triangles.push_back(panel.vertex);
            static_cast<void>(base);
            panels.add_wall("gate", body.position, triangles, false);
            const Driver<3> driver = settle(points, spacing, panels);
            const Spread near = spread(driver, [](const Vec3& x) { return x.z() < 9 * spacing - R; });
            CHECK(near.count == 10 * 10 * 5);
            CAPTURE(near.least_unity);
            CAPTURE(near.most_unity);
            CHECK(near.least_unity == doctest::Approx(inside().least_unity).epsilon(1e-9));
            CHECK(near.most_unity == doctest::Approx(inside().least_unity).epsilon(1e-9));
            CHECK(places_seen_twice(driver) == 0);
        }
}

TEST_CASE("a column on the floor of a tank: its foot's edges and corners") {
    const Vec3 size = Vec3(17, 17, 14) * spacing, low = Vec3(6, 6, 0) * spacing, high = Vec3(11, 11, 14) * spacing;
    const auto points =
        cells_where({17, 17, 9}, spacing, [&](const Vec3& x) { return outside_distance(x, low, high) > 0; });
    Panels<3> panels = tank(size);
    add_box(panels, "column", low, high, false);
    const Driver<3> driver = settle(points, spacing, panels);
    std::size_t corners = 0;
    for (const auto& corner : driver.walls->corners) corners += corner.is_point();
    CHECK(corners == 4);  // of the tank
    CHECK(driver.walls->corners.size() == 4 + 8 + 4);
    const Spread near = spread(driver, [](const Vec3& x) { return x.z() < 9 * spacing - R; });
    CAPTURE(near.least_unity);
    CAPTURE(near.most_unity);
    CHECK(near.most_unity < 1.1);
    CHECK(near.least_unity > 0.8);
    CHECK(places_seen_twice(driver, true) == 0);
}

TEST_CASE("inside a sphere and around one: the support is full on average") {
    const double radius = 10 * spacing;
    // An octahedron whose faces are cut into four, four times, and put on the sphere.
    Panels<3> octahedron;
    octahedron.add_wall("sphere", {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
                        false);
    Panels<3> sphere = refined(octahedron, 3);
    for (Vec3& x : sphere.position) x *= radius / x.norm();
    for (const bool water_inside : {false, true}) {
        CAPTURE(water_inside);
        Panels<3> panels = sphere;
        if (water_inside)
            for (auto& panel : panels.panels) std::swap(panel.vertex[1], panel.vertex[2]);
        const double far = radius + (water_inside ? 0 : 1.6 * R);
        const int half = int(std::ceil(far / spacing));
        auto points = cells_where({2 * half, 2 * half, 2 * half}, spacing, [&](const Vec3& x) {
            const double r = (x - Vec3::Constant(half * spacing)).norm();
            return water_inside ? r < radius && r > radius - 2 * R : r > radius && r < far;
        });
        for (auto& x : points)
            for (double& c : x) c -= half * spacing;
        const Driver<3> driver = settle(points, spacing, panels);
        const Spread near = spread(driver, [&](const Vec3& x) {
            // Closer particles almost coincide with their own ghosts: no lattice.
            return std::fabs(x.norm() - radius) < 0.6 * R && std::fabs(x.norm() - radius) > 0.3 * spacing;
        });
        CAPTURE(near.least_unity);
        CAPTURE(near.most_unity);
        CAPTURE(near.mean_unity);
        CHECK(near.count > 1000);
        CHECK(near.mean_unity == doctest::Approx(1).epsilon(0.03));
        CHECK(near.least_unity > 0.75);
        CHECK(near.most_unity < 1.25);
    }
}

TEST_CASE("around the blunt edge of a step in space every place is seen once") {
    // A step of 7 spacings in a tank of 14 × 5: its lower floor's corner is further from the upper floor than R, nearer
    // than R to the images behind it.
    const double a = 7 * spacing, b = 14 * spacing, w = 5 * spacing, top = 2;
    const auto points = cells_where({14, 5, 14}, spacing, [&](const Vec3& x) { return x.x() < a || x.z() > a; });
    Panels<3> panels;
    const std::vector<Vec2> profile{{0, top}, {0, 0}, {a, 0}, {a, a}, {b, a}, {b, top}};
    std::vector<Vec3> corners;
    for (const double y : {0.0, w})
        for (const Vec2& x : profile) corners.emplace_back(x.x(), y, x.y());
    std::vector<std::array<int, 3>> triangles;
    for (int k = 0; k < 5; ++k) {
        triangles.push_back({k, k + 1, k + 7});
        triangles.push_back({k, k + 7, k + 6});
    }
    for (const auto& [x, y, z] : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
        triangles.push_back({x, z, y});
        triangles.push_back({x + 6, y + 6, z + 6});
    }
    panels.add_wall("tank", corners, triangles, false);
    const Driver<3> driver = settle(points, spacing, panels);
    const Spread near = spread(driver, [&](const Vec3& x) { return x.z() < b - R; });
    CAPTURE(near.least_unity);
    CAPTURE(near.most_unity);
    CHECK(near.count > 300);
    // Beside the side walls some lines of sight pass through the very edge of the step and its corner at once.
    CHECK(near.least_unity > 0.97 * inside().least_unity);
    CHECK(near.most_unity < 1.01 * inside().most_unity);
}
