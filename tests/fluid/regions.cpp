// Water inside polygons, discs, closed bodies: how much, where, and regular after relaxation.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "physics/fluid/relaxation.hpp"
#include "physics/geometry/shapes.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;
using namespace aquagraph::geometry;
using aquagraph::serial_loop;
using doctest::Approx;

namespace {

constexpr double pi = std::numbers::pi;

Region<2> disc(double radius, double spacing) {
    return {.boundary = circle(aquagraph::geometry::Vec<2>(0.3, 0.2), radius, 0.02 * spacing, FluidSide::outside),
            .clearance = spacing / 2,
            .level = {}};
}

template <int D>
double least_distance(const Places<D>& places) {
    double least = 1e9;
    for (std::size_t i = 0; i < places.x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) least = std::min(least, (places.x[i] - places.x[j]).norm());
    return least;
}

}  // namespace

TEST_CASE("a polygon with sides along the axes is filled like boxes") {
    const double h = 0.1;
    const Region<2> ell{
        polyline(std::vector<aquagraph::geometry::Vec<2>>{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}},
                 true),
        h / 2,
        {}};
    CHECK(ell.volume() == Approx(0.75));
    CHECK(ell.top() == 1);
    const auto places = places_in(ell, h);
    REQUIRE(places.x.size() == 75);
    CHECK(places.volume * double(places.x.size()) == Approx(0.75));
    for (const aquagraph::geometry::Vec<2>& x : places.x) CHECK((x.y() < 0.5 || x.x() < 0.5));
    const auto box = places_in<2>(FillBox<2>{{0, 0}, {1, 0.5}}, h);
    for (const aquagraph::geometry::Vec<2>& x : box.x) {
        double nearest = 1;
        for (const aquagraph::geometry::Vec<2>& y : places.x) nearest = std::min(nearest, (x - y).norm());
        CHECK(nearest < 1e-12);
    }
    // The same, extruded and filled to a level that is no whole number of cells.
    const Region<3> tank{
        extrude(std::vector<aquagraph::geometry::Vec<2>>{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}, true,
                1, 0, 0.3, true),
        h / 2, 0.45};
    CHECK(tank.volume() == Approx(0.135));
    CHECK(tank.top() == 0.45);
    const auto water = places_in(tank, h);
    CHECK(water.x.size() == 10 * 3 * 4);
    for (const aquagraph::geometry::Vec<3>& x : water.x) CHECK(std::fabs(std::remainder(x.z() - 0.4, h)) < 1e-12);
}

TEST_CASE("what a lattice misses of a disc and of a ball is half a cell along the boundary") {
    for (const double h : {0.05, 0.025, 0.0125}) {
        CAPTURE(h);
        const auto round = disc(0.5, h);
        const auto places = places_in(round, h);
        const double missing = round.volume() - places.volume * double(places.x.size());
        CHECK(missing == Approx(2 * pi * 0.5 * h / 2).epsilon(0.12));
        for (const aquagraph::geometry::Vec<2>& x : places.x)
            CHECK((x - aquagraph::geometry::Vec<2>(0.3, 0.2)).norm() < 0.5 - 0.499 * h);
        const auto full = full_places_in(round, h);
        CHECK(full.volume * double(full.x.size()) == Approx(round.volume()).epsilon(1e-14));
        CHECK(full.volume == Approx(h * h).epsilon(1e-2));
    }
    const double h = 0.05;
    const Region<3> ball{sphere(aquagraph::geometry::Vec<3>(0, 0, 0), 0.5, 0.02 * h, FluidSide::outside), h / 2, {}};
    const auto places = places_in(ball, h);
    const double missing = ball.volume() - places.volume * double(places.x.size());
    CHECK(missing == Approx(4 * pi * 0.25 * h / 2 - 4 * pi * 0.5 * h * h / 4).epsilon(0.1));
    const auto full = full_places_in(ball, h);
    CHECK(full.volume * double(full.x.size()) == Approx(ball.volume()).epsilon(1e-14));
}

TEST_CASE("bodies of water have their own velocity and pressure") {
    Particles<2> s;
    const Water<2> drop{places_in<2>(FillBox<2>{{0, 2}, {0.2, 2.2}}, 0.1), aquagraph::geometry::Vec<2>(1, -3),
                        std::nullopt},
        pool{places_in<2>(FillBox<2>{{0, 0}, {1, 0.5}}, 0.1), aquagraph::geometry::Vec<2>(0, 0), 0.5};
    fill<2>(s, std::vector{pool, drop}, water, 9.81);
    REQUIRE(s.count == 54);
    for (std::size_t i = 0; i < s.count; ++i) {
        CHECK(s.id[i] == std::int64_t(i));
        CHECK(s.v[1][i] == (i < 50 ? 0 : -3));
        CHECK(s.p[i] == Approx(i < 50 ? 9810 * (0.5 - s.x[1][i]) : 0).epsilon(0.02));
    }
}

TEST_CASE("relaxation makes the water of a disc regular and keeps its mass") {
    const double h = 0.02;
    const auto round = disc(0.3, h);
    auto places = full_places_in(round, h);
    const std::size_t count = places.x.size();
    const double volume = places.volume;
    const auto result = relax(places, round, h, 4 * h, 1e-3, serial_loop);
    MESSAGE("disc: ", count, " particles, S ", result.before, " -> ", result.after, ", mean ", result.mean, ", ",
            result.steps, " steps, nearest ", least_distance(places) / h);
    CHECK(result.after < result.before / 5);
    CHECK(result.mean == Approx(1).epsilon(5e-3));
    CHECK(places.x.size() == count);
    CHECK(places.volume == volume);
    for (const aquagraph::geometry::Vec<2>& x : places.x)
        CHECK((x - aquagraph::geometry::Vec<2>(0.3, 0.2)).norm() < 0.3 - 0.25 * h);
    CHECK(least_distance(places) > 0.5 * h);
}

TEST_CASE("relaxation of a round tank filled to a level") {
    const double h = 0.02;
    Region<2> tank = disc(0.3, h);
    tank.level = 0.25;
    auto places = full_places_in(tank, h);
    const double segment = 0.09 * (pi - std::acos(1.0 / 6)) + 0.05 * std::sqrt(0.09 - 0.0025);
    CHECK(tank.volume() == Approx(segment).epsilon(1e-3));
    CHECK(places.volume * double(places.x.size()) == Approx(tank.volume()).epsilon(1e-14));
    const auto result = relax(places, tank, h, 4 * h, 1e-3, serial_loop);
    MESSAGE("tank: ", places.x.size(), " particles, S ", result.before, " -> ", result.after, ", mean ", result.mean,
            ", ", result.steps, " steps, nearest ", least_distance(places) / h);
    CHECK(result.after < result.before / 5);
    for (const aquagraph::geometry::Vec<2>& x : places.x) CHECK(x.y() < 0.25);
}

TEST_CASE("relaxation of a ball") {
    const double h = 0.05;
    const Region<3> ball{sphere(aquagraph::geometry::Vec<3>(0, 0, 0), 0.4, 0.02 * h, FluidSide::outside), h / 2, {}};
    auto places = full_places_in(ball, h);
    const auto result = relax(places, ball, h, 3 * h, 2e-3, serial_loop);
    MESSAGE("ball: ", places.x.size(), " particles, S ", result.before, " -> ", result.after, ", mean ", result.mean,
            ", ", result.steps, " steps, nearest ", least_distance(places) / h);
    CHECK(result.after < result.before / 5);
    for (const aquagraph::geometry::Vec<3>& x : places.x) CHECK(x.norm() < 0.4 - 0.25 * h);
}
