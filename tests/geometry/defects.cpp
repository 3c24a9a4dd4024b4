// Everything that can be wrong with a drawn surface is found, with its facet and its place.
#include <doctest/doctest.h>

#include <algorithm>

#include "physics/geometry/shapes.hpp"
#include "physics/geometry/surface_defects.hpp"

using namespace aquagraph::geometry;

namespace {

Surface<3> cube() {
    return box<3>(Vec<3>(0, 0, 0), Vec<3>(1, 1, 1), FluidSide::outside);
}

}  // namespace

TEST_CASE("a hole, a facet that looks the wrong way, a facet twice, one without area") {
    auto hole = cube();
    hole.facets.erase(hole.facets.begin() + 4);
    auto defects = find_defects(hole, true);
    REQUIRE(defects.size() == 3);
    for (const auto& defect : defects) CHECK(defect.kind == DefectKind::open_side);
    CHECK(find_defects(hole, false).empty());

    auto turned = cube();
    std::swap(turned.facets[7][0], turned.facets[7][1]);
    defects = find_defects(turned, true);
    REQUIRE(defects.size() == 3);
    for (const auto& defect : defects) {
        CHECK(defect.kind == DefectKind::opposed);
        CHECK((defect.facet == 7 || defect.other == 7));
    }

    auto twice = cube();
    twice.facets.push_back({twice.facets[3][1], twice.facets[3][2], twice.facets[3][0]});
    defects = find_defects(twice, true);
    REQUIRE(defects.size() == 1);
    CHECK(defects[0].kind == DefectKind::duplicate);
    CHECK(defects[0].facet == 12);
    CHECK(defects[0].other == 3);

    auto thin = cube();
    thin.vertices.push_back(Vec<3>(0.5, 0, 0));
    thin.facets.push_back({0, 8, 1});
    defects = find_defects(thin, false);
    REQUIRE(!defects.empty());
    CHECK(defects[0].kind == DefectKind::degenerate);
    CHECK(defects[0].facet == 12);
    CHECK(describe(defects[0]) == "triangle 13 has no area, at (0.5, 0, 0) m");

    auto wild = cube();
    wild.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
    CHECK(find_defects(wild, true).at(0).kind == DefectKind::not_finite);
}

TEST_CASE("a fin on a closed body branches") {
    auto fin = cube();
    fin.vertices.push_back(Vec<3>(2, 2, 0.5));
    fin.facets.push_back({7, 3, 8});  // along the edge from (1, 1, 1) to (1, 1, 0)
    const auto defects = find_defects(fin, false);
    REQUIRE(defects.size() == 1);
    CHECK(defects[0].kind == DefectKind::branching);
    CHECK((defects[0].place - Vec<3>(1, 1, 0.5)).norm() < 1e-12);
}

TEST_CASE("surfaces that cut through themselves") {
    auto two = cube();
    two.append(box<3>(Vec<3>(0.5, 0.25, 0.25), Vec<3>(1.5, 0.75, 0.75), FluidSide::outside));
    auto crossings = find_defects(two, true);
    REQUIRE(!crossings.empty());
    for (const auto& defect : crossings) {
        CHECK(defect.kind == DefectKind::crossing);
        CHECK(defect.place.x() == doctest::Approx(1));  // all of them in the side of the first box
    }
    auto apart = cube();
    apart.append(box<3>(Vec<3>(0.25, 0.25, 0.25), Vec<3>(0.75, 0.75, 0.75), FluidSide::outside));
    CHECK(find_defects(apart, true).empty());

    // In 2D: a bow tie.
    const auto tie = polyline(std::vector<Vec<2>>{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, true);
    const auto found = find_defects(tie, true);
    REQUIRE(found.size() == 1);
    CHECK(found[0].kind == DefectKind::crossing);
    CHECK(describe(found[0]) == "segment 1 cuts through segment 3, at (0.5, 0.5) m");
    const auto open = polyline(std::vector<Vec<2>>{{0, 0}, {1, 1}, {1, 0}}, false);
    CHECK(find_defects(open, false).empty());
    CHECK(find_defects(open, true).size() == 2);
}
