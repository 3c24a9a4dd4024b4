// Areas and volumes of the shapes against closed forms; fronts look at the fluid; closed shapes have no defect.
#include "physics/geometry/shapes.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "physics/geometry/surface_defects.hpp"

using namespace aquagraph::geometry;
using doctest::Approx;

namespace {

constexpr double pi = std::numbers::pi;

template <int D>
void sound(const Surface<D>& surface, bool closed = true) {
    for (const auto& defect : find_defects(surface, closed)) FAIL_CHECK(describe(defect));
}

}  // namespace

TEST_CASE("boxes") {
    const auto flat = box<2>(Vec<2>(1, 2), Vec<2>(4, 7), FluidSide::outside);
    sound(flat);
    CHECK(measure(flat) == Approx(16));
    CHECK(enclosed_volume(flat) == Approx(15));
    CHECK(enclosed_volume(box<2>(Vec<2>(1, 2), Vec<2>(4, 7), FluidSide::inside)) == Approx(-15));
    const auto solid = box<3>(Vec<3>(1, 2, 3), Vec<3>(4, 7, 5), FluidSide::outside);
    sound(solid);
    CHECK(measure(solid) == Approx(2 * (15 + 10 + 6)));
    CHECK(enclosed_volume(solid) == Approx(30));
    CHECK(enclosed_volume(box<3>(Vec<3>(1, 2, 3), Vec<3>(4, 7, 5), FluidSide::inside)) == Approx(-30));

    // Without its lid the tank is open, and nothing else is wrong with it.
    OpenSides<3> lid{};
    lid[2][1] = true;
    const auto tank = box<3>(Vec<3>(0, 0, 0), Vec<3>(1, 2, 3), FluidSide::inside, lid);
    CHECK(tank.facets.size() == 10);
    CHECK(tank.vertices.size() == 8);
    CHECK(measure(tank) == Approx(2 + 2 * 3 + 2 * 6));
    sound(tank, false);
    CHECK(find_defects(tank, true).size() == 4);
    const auto trench = box<2>(Vec<2>(0, 0), Vec<2>(1, 2), FluidSide::inside, {{{false, false}, {false, true}}});
    CHECK(measure(trench) == Approx(5));
    for (std::size_t f = 0; f < trench.facets.size(); ++f)
        CHECK(trench.front(f).dot(Vec<2>(0.5, 1) - trench.centroid(f)) > 0);
    CHECK_THROWS_AS(box<2>(Vec<2>(0, 0), Vec<2>(0, 1), FluidSide::inside), ShapeError);
    CHECK_THROWS_AS(box<2>(Vec<2>(0, 0), Vec<2>(1, 1), FluidSide::inside, {{{true, true}, {true, true}}}), ShapeError);
}

TEST_CASE("polylines and flat faces") {
    const std::vector<Vec<2>> points{{0, 0}, {2, 0}, {2, 1}};
    CHECK(polyline(points, false).facets.size() == 2);
    CHECK(measure(polyline(points, true)) == Approx(3 + std::sqrt(5.0)));
    CHECK(polyline(points, true).front(0).y() > 0);  // the left of a step to the right
    CHECK_THROWS_AS(polyline(std::vector<Vec<2>>{{0, 0}, {0, 0}}, false), ShapeError);

    const auto plane = rectangle(Vec<3>(1, 1, 1), Vec<3>(2, 0, 0), Vec<3>(0, 3, 0));
    CHECK(measure(plane) == Approx(6));
    CHECK(plane.front(0).normalized().z() == Approx(1));
    CHECK_THROWS_AS(rectangle(Vec<3>(1, 1, 1), Vec<3>(2, 0, 0), Vec<3>(1, 0, 0)), ShapeError);

    // An L in a tilted plane: not convex.
    const Eigen::AngleAxisd turn(0.7, Vec<3>(1, 2, 3).normalized());
    std::vector<Vec<3>> corners{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    for (auto& x : corners) x = turn * x;
    const auto face = plane_polygon(corners);
    CHECK(measure(face) == Approx(4));
    for (std::size_t f = 0; f < face.facets.size(); ++f)
        CHECK(face.front(f).normalized().dot(turn * Vec<3>(0, 0, 1)) == Approx(1));
    sound(face, false);
    corners[2] += turn * Vec<3>(0, 0, 0.1);
    CHECK_THROWS_WITH_AS(plane_polygon(corners), doctest::Contains("off the plane"), ShapeError);
}

TEST_CASE("polygons as triangles") {
    // A comb with five teeth turns both ways, with corners on straight lines too.
    std::vector<Vec<2>> comb{{0, 0}, {5, 0}, {10, 0}};
    for (int tooth = 4; tooth >= 0; --tooth) {
        comb.push_back({2.0 * tooth + 2, 3});
        comb.push_back({2.0 * tooth + 1, 1});
    }
    comb.push_back({0, 3});
    double area = 0;
    for (const auto& [a, b, c] : triangles_of_polygon(comb)) {
        const Vec<2> u = comb[std::size_t(b)] - comb[std::size_t(a)], v = comb[std::size_t(c)] - comb[std::size_t(b)];
        const double twice = u.x() * v.y() - u.y() * v.x();
        CHECK(twice > 0);
        area += twice / 2;
    }
    CHECK(area == Approx(10 + 5 * 2));
    CHECK(area == Approx(-enclosed_volume(polyline(comb, true))));
    CHECK_THROWS_AS(triangles_of_polygon(std::vector<Vec<2>>{{0, 0}, {1, 1}, {1, 0}, {0, 1}}), ShapeError);
    CHECK_THROWS_AS(triangles_of_polygon(std::vector<Vec<2>>{{0, 0}, {4, 0}, {4, 3}, {1, -1}}), ShapeError);
}

TEST_CASE("extruded polygons") {
    const std::vector<Vec<2>> ell{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (int axis = 0; axis < 3; ++axis) {
        const auto tank = extrude(ell, true, axis, -1, 2, true);  // counter-clockwise: the fluid is inside
        sound(tank);
        CHECK(enclosed_volume(tank) == Approx(-12));
        CHECK(measure(tank) == Approx(2 * 4 + 10 * 3));
        auto around = ell;
        std::reverse(around.begin(), around.end());
        const auto body = extrude(around, true, axis, -1, 2, true);
        sound(body);
        CHECK(enclosed_volume(body) == Approx(12));
        CHECK(measure(extrude(ell, true, axis, -1, 2, false)) == Approx(10 * 3));
    }
    const auto floor = extrude(std::vector<Vec<2>>{{0, 0}, {4, 0}}, false, 1, 0, 1, false);  // (x, z) along y
    CHECK(floor.front(0).normalized().z() == Approx(1));
    CHECK_THROWS_AS(extrude(ell, false, 0, 0, 1, true), ShapeError);
    CHECK_THROWS_AS(extrude(ell, true, 0, 1, 1, true), ShapeError);
}

TEST_CASE("round shapes keep their chord error, and areas and volumes converge to those of the circle and the sphere") {
    const double r = 0.7;
    for (const double error : {1e-2, 1e-3, 1e-4}) {
        const auto round = circle(Vec<2>(3, -1), r, error, FluidSide::outside);
        sound(round);
        const double n = double(round.facets.size());
        CHECK(segments_of_circle(r, error) == int(n));
        CHECK(enclosed_volume(round) == Approx(n / 2 * r * r * std::sin(2 * pi / n)));
        CHECK(measure(round) == Approx(2 * n * r * std::sin(pi / n)));
        CHECK(pi * r * r - enclosed_volume(round) < 2 * pi * r * error);
        for (std::size_t f = 0; f < round.facets.size(); ++f) {
            const double shortfall = r - (round.centroid(f) - Vec<2>(3, -1)).norm();
            CHECK(shortfall <= error * (1 + 1e-9));
            CHECK(round.front(f).dot(round.centroid(f) - Vec<2>(3, -1)) > 0);
        }
        const auto ball = sphere(Vec<3>(1, 2, 3), r, error, FluidSide::outside);
        sound(ball);
        CHECK(enclosed_volume(ball) < 4.0 / 3 * pi * r * r * r);
        CHECK(enclosed_volume(ball) > 4.0 / 3 * pi * r * r * r - 4 * pi * r * r * error);
        CHECK(measure(ball) == Approx(4 * pi * r * r).epsilon(2.5 * error / r));
        for (std::size_t f = 0; f < ball.facets.size(); ++f) {
            const double plane = ball.front(f).normalized().dot(ball.vertex(f, 0) - Vec<3>(1, 2, 3));
            CHECK(plane > r - error * (1 + 1e-9));
        }
    }
    CHECK(enclosed_volume(circle(Vec<2>(0, 0), 1, 1e-3, FluidSide::inside)) < 0);
    CHECK(enclosed_volume(sphere(Vec<3>(0, 0, 0), 1, 1e-2, FluidSide::inside)) < 0);

    const Vec<3> from(1, 0, 0), to(1, 2, 1);
    const auto can = cylinder(from, to, r, 1e-3, FluidSide::outside);
    sound(can);
    const double n = segments_of_circle(r, 1e-3), base = n / 2 * r * r * std::sin(2 * pi / n);
    CHECK(enclosed_volume(can) == Approx(base * std::sqrt(5.0)));
    CHECK(measure(can) == Approx(2 * base + 2 * n * r * std::sin(pi / n) * std::sqrt(5.0)));
    const auto pipe = cylinder(from, to, r, 1e-3, FluidSide::inside, {true, true});
    CHECK(measure(pipe) == Approx(2 * n * r * std::sin(pi / n) * std::sqrt(5.0)));
    CHECK(pipe.front(0).dot((from + to) / 2 - pipe.centroid(0)) > 0);
    CHECK_THROWS_AS(circle(Vec<2>(0, 0), 0, 1e-3, FluidSide::inside), ShapeError);
    CHECK_THROWS_AS(circle(Vec<2>(0, 0), 1, 0, FluidSide::inside), ShapeError);
    CHECK_THROWS_AS(sphere(Vec<3>(0, 0, 0), 1, 1e-9, FluidSide::inside), ShapeError);
    CHECK_THROWS_AS(cylinder(from, from, 1, 1e-3, FluidSide::inside), ShapeError);
}

TEST_CASE("volumes below a level") {
    const auto ball = sphere(Vec<3>(0, 0, 0.5), 0.5, 1e-4, FluidSide::outside);
    for (const double h : {0.1, 0.37, 0.5, 0.8}) {
        CAPTURE(h);  // spherical cap: π h² (3 r - h) / 3
        CHECK(enclosed_volume_below(ball, h) == Approx(pi * h * h * (1.5 - h) / 3).epsilon(2e-3));
    }
    CHECK(enclosed_volume_below(ball, 2) == Approx(enclosed_volume(ball)));
    CHECK(enclosed_volume_below(ball, -1) == 0);
    const auto flat = polyline(std::vector<Vec<2>>{{0, 0}, {4, 0}, {0, 2}}, true);
    CHECK(-enclosed_volume_below(flat, 1) == Approx(3));
    const auto brick = box<3>(Vec<3>(1, 1, 1), Vec<3>(2, 3, 4), FluidSide::outside);
    CHECK(enclosed_volume_below(brick, 2.5) == Approx(3));
}

TEST_CASE("surfaces are moved, scaled, turned and joined") {
    auto brick = box<3>(Vec<3>(0, 0, 0), Vec<3>(1, 2, 3), FluidSide::outside);
    transform(brick, 2, Vec<3>(0, 0, 1), pi / 2, Vec<3>(10, 0, 0));
    CHECK(enclosed_volume(brick) == Approx(48));
    const auto [low, high] = bounds(brick);
    CHECK((low - Vec<3>(6, 0, 0)).norm() < 1e-12);
    CHECK((high - Vec<3>(10, 2, 6)).norm() < 1e-12);
    brick.flip();
    CHECK(enclosed_volume(brick) == Approx(-48));

    // Two halves of a box, drawn apart by a rounding: watertight once welded.
    OpenSides<3> right{}, left{};
    right[0][1] = left[0][0] = true;
    auto both = box<3>(Vec<3>(0, 0, 0), Vec<3>(1, 1, 1), FluidSide::outside, right);
    both.append(box<3>(Vec<3>(1 + 1e-9, 0, 0), Vec<3>(2, 1, 1), FluidSide::outside, left));
    CHECK(find_defects(both, true).size() == 8);
    weld(both, 1e-6);
    CHECK(both.vertices.size() == 12);
    sound(both);
    CHECK(enclosed_volume(both) == Approx(2));
}
