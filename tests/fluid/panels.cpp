// Panels in two and three dimensions: normals, areas, what is joined to what.
#include "physics/fluid/walls/panels.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace aquagraph::fluid;

namespace {

// A box whose inside is fluid, two triangles a side; `apart`: every triangle has vertices of its own, as in an STL
// file.
Panels<3> box(const Vec3& size, bool apart) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k) corners.emplace_back(k & 1 ? size.x() : 0, k & 2 ? size.y() : 0, k & 4 ? size.z() : 0);
    const std::vector<std::array<int, 3>> triangles{{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                                                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    Panels<3> panels;
    if (!apart) {
        panels.add_wall("box", corners, triangles, false);
    } else {
        for (const auto& [a, b, c] : triangles)
            panels.add_wall("box", {corners[std::size_t(a)], corners[std::size_t(b)], corners[std::size_t(c)]},
                            {{0, 1, 2}}, false);
    }
    panels.update_geometry();
    panels.find_joints();
    return panels;
}

}  // namespace

TEST_CASE("a box of triangles: normals into it, area, joints and flat patches") {
    const Vec3 size(1, 2, 3);
    for (const bool apart : {false, true}) {
        CAPTURE(apart);
        const Panels<3> panels = box(size, apart);
        double area = 0;
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < panels.size(); ++k) {
            area += panels.measure[k];
            sum += panels.measure[k] * panels.normal[k];
            CHECK(panels.height(k, 0.5 * size) > 0);
            CHECK(panels.normal[k].norm() == doctest::Approx(1));
        }
        CHECK(area == doctest::Approx(22));
        CHECK(sum.norm() < 1e-14);
        CHECK(panels.joints.size() == 18);  // every edge of the twelve triangles, once
        const auto patch = smooth_patches(panels);
        for (std::size_t k = 0; k < panels.size(); ++k) CHECK(patch[k] == int(k / 2 * 2));
    }
}

TEST_CASE("shape functions are linear and place the foot of the perpendicular") {
    Panels<3> panels;
    panels.add_wall("triangle", {{0.1, 0.2, 0.3}, {1.5, 0.1, 0.4}, {0.4, 1.1, -0.2}}, {{0, 1, 2}}, false);
    panels.update_geometry();
    const Vec3 foot = 0.2 * panels.vertex(0, 0) + 0.5 * panels.vertex(0, 1) + 0.3 * panels.vertex(0, 2);
    const auto shape = panels.shape_functions(0, foot + 0.7 * panels.normal[0]);
    CHECK(shape[0] == doctest::Approx(0.2));
    CHECK(shape[1] == doctest::Approx(0.5));
    CHECK(shape[2] == doctest::Approx(0.3));
    CHECK(panels.height(0, foot + 0.7 * panels.normal[0]) == doctest::Approx(0.7));
    const auto outside = panels.shape_functions_on(0, 2 * panels.vertex(0, 1) - panels.vertex(0, 0));
    CHECK(outside[0] == 0);
    CHECK(outside[1] == doctest::Approx(1));
}

TEST_CASE("polylines turn left around the fluid") {
    Panels<2> panels;
    panels.add_wall("tank", {{0, 1}, {0, 0}, {2, 0}, {2, 1}}, false, false);
    panels.update_geometry();
    panels.find_joints();
    REQUIRE(panels.size() == 3);
    CHECK(panels.joints.size() == 2);
    CHECK(panels.measure[1] == 2);
    for (std::size_t k = 0; k < 3; ++k) CHECK(panels.height(k, {1, 0.5}) > 0);
    CHECK(panels.centroid[2] == Vec2(2, 0.5));
}

TEST_CASE("triangles without area or corners are refused") {
    Panels<3> panels;
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    CHECK_THROWS_AS(panels.add_wall("line", points, {{0, 1, 2}}, false), std::invalid_argument);
    CHECK_THROWS_AS(panels.add_wall("none", points, {{0, 1, 3}}, false), std::invalid_argument);
    CHECK(panels.names.empty());
}
