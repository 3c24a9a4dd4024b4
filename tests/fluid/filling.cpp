// Initial particles: how many, where, and at which pressure.
#include "physics/fluid/filling.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

TEST_CASE("a box gives as many particles as whole cells fit into it") {
    CHECK(particles_in<2>({{0, 0}, {1, 0.5}}, 0.1) == 50);
    CHECK(particles_in<2>({{0.1, 0.1}, {0.4, 0.7}}, 0.1) == 18);  // 0.4 - 0.1 is a little less than 0.3
    CHECK(particles_in<2>({{0, 0}, {0.99, 0.5}}, 0.1) == 45);
    CHECK(particles_in<3>({{0, 0, -1}, {0.3, 0.2, -0.6}}, 0.1) == 24);
    CHECK(particles_in<2>({{0, 0}, {0.05, 1}}, 0.1) == 0);
    CHECK(particles_in<2>({{0, 0}, {2.56, 1.28}}, 0.001) == 2560 * 1280);
}

TEST_CASE("particles lie at the centres of the cells of their boxes, at rest, numbered from zero") {
    Particles<3> s;
    const double spacing = 0.1;
    fill<3>(s, {{{0, 0, 0}, {0.3, 0.2, 0.4}}, {{1, 1, 1}, {1.2, 1.1, 1.1}}}, spacing, water, 9.81, std::nullopt);
    REQUIRE(s.count == 24 + 2);
    for (std::size_t i = 0; i < s.count; ++i) {
        CHECK(s.id[i] == static_cast<std::int64_t>(i));
        const double low = i < 24 ? 0 : 1;
        for (std::size_t d = 0; d < 3; ++d) {
            const double cells = (s.x[d][i] - low) / spacing - 0.5;
            CHECK(std::fabs(cells - std::round(cells)) < 1e-12);
            CHECK(s.x[d][i] > low);
            CHECK(s.v[d][i] == 0);
            CHECK(s.x_built[d][i] == s.x[d][i]);
        }
        CHECK(s.p[i] == 0);
        CHECK(s.mass[i] == doctest::Approx(1).epsilon(1e-14));
        for (std::size_t j = 0; j < i; ++j) CHECK(distance(s, i, j) > 0.99 * spacing);
    }
}

TEST_CASE("hydrostatic pressure grows with the density's weight") {
    for (const Tait& tait : {Tait{1000, 20}, Tait{1000, 1500}, Tait{1.2, 340, 1.4}})
        for (const double depth : {0.01, 0.3, 2.0, 40.0}) {
            const double g = 9.81, h = 1e-3 * depth;
            const auto p = [&](double z) { return tait.pressure(hydrostatic_deviation(tait, g, z)); };
            const double slope = (8 * (p(depth + h) - p(depth - h)) - (p(depth + 2 * h) - p(depth - 2 * h))) / (12 * h);
            const double rho = tait.reference_density + hydrostatic_deviation(tait, g, depth);
            CHECK(slope == doctest::Approx(rho * g).epsilon(1e-10));
        }
    CHECK(hydrostatic_deviation(water, 9.81, 0) == 0);
    CHECK(hydrostatic_deviation(water, 9.81, -3) == 0);
    // Nearly incompressible: ρ g z to first order.
    const Tait stiff{1000, 1500};
    CHECK(stiff.pressure(hydrostatic_deviation(stiff, 9.81, 0.001)) == doctest::Approx(9.81).epsilon(1e-8));
}

TEST_CASE("the surface level is where the pressure is zero") {
    Particles<2> s;
    const double spacing = 0.05, level = 0.6;
    fill<2>(s, {{{0, 0}, {0.5, 1}}}, spacing, water, 9.81, level);
    REQUIRE(s.count == 200);
    for (std::size_t i = 0; i < s.count; ++i) {
        const double depth = level - s.x[1][i];
        if (depth <= 0) {
            CHECK(s.p[i] == 0);
        } else {
            CHECK(s.p[i] == doctest::Approx(water.pressure(hydrostatic_deviation(water, 9.81, depth))).epsilon(1e-14));
            CHECK(s.p[i] == doctest::Approx(9810 * depth).epsilon(0.02));
        }
        CHECK(s.volume[i] == doctest::Approx(spacing * spacing).epsilon(1e-14));
        CHECK(s.mass[i] == doctest::Approx((1000 + s.deviation[i]) * spacing * spacing).epsilon(1e-14));
    }
}

TEST_CASE("unused lanes are harmless") {
    Particles<2> s;
    fill<2>(s, {{{0, 0}, {0.3, 0.3}}}, 0.1, water, 9.81, 0.3);
    REQUIRE(s.size() == 16);
    for (std::size_t i = s.count; i < s.size(); ++i) {
        CHECK(s.id[i] == -1);
        CHECK(s.volume[i] == 0);
        CHECK(s.mass[i] == 0);
        CHECK(s.x[0][i] > 1e6);
    }
    s.resize(4, 3);  // fewer: the freed lanes turn harmless too, ghosts get theirs
    CHECK(s.size() == 16);
    CHECK(s.ghost_begin() == 8);
    for (std::size_t i = 4; i < 8; ++i) CHECK(s.volume[i] == 0);
    for (std::size_t i = 11; i < 16; ++i) CHECK(s.volume[i] == 0);
    CHECK(s.id[3] == 3);
}
