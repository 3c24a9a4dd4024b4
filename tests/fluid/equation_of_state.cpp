// Tait's equation: inverse, sound speed, precision at small pressures, and what a particle's state makes of it.
#include "physics/fluid/equation_of_state.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "physics/fluid/time_integration.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {
const Tait laws[] = {{1000, 1500, 7}, {1000, 20, 7}, {1.2, 340, 1.4}};
}

TEST_CASE("pressure and deviation are inverse to each other") {
    for (const Tait& tait : laws)
        for (const double x : {-0.9, -0.3, -1e-3, -1e-9, 0.0, 1e-12, 1e-6, 0.01, 0.5, 3.0}) {
            const double p = x * tait.stiffness(), back = tait.pressure(tait.deviation(p));
            CHECK(std::fabs(back - p) <= 2e-14 * std::fabs(p) + (std::fabs(x) > 0.1 ? 1e-14 * tait.stiffness() : 0));
        }
}

TEST_CASE("pressure is that of the formula") {
    for (const Tait& tait : laws)
        for (const double compression : {0.8, 0.99, 1.0, 1.02, 1.3}) {
            const double p = tait.reference_density * tait.sound_speed * tait.sound_speed / tait.exponent *
                             (std::pow(compression, tait.exponent) - 1);
            CHECK(std::fabs(tait.pressure(tait.reference_density * (compression - 1)) - p) < 1e-13 * tait.stiffness());
        }
}

TEST_CASE("the sound speed is the derivative of the pressure") {
    for (const Tait& tait : laws)
        for (const double strain : {-0.2, -0.01, 0.0, 1e-5, 0.02, 0.3}) {
            const double deviation = strain * tait.reference_density, h = 1e-4 * tait.reference_density;
            const auto p = [&](int k) { return tait.pressure(deviation + k * h); };
            const double derivative = (8 * (p(1) - p(-1)) - (p(2) - p(-2))) / (12 * h);  // fourth order
            const double c = tait.sound_speed_at(deviation);
            CHECK(c * c == doctest::Approx(derivative).epsilon(1e-11));
        }
}

TEST_CASE("a pressure of 1 Pa survives at 1500 m/s") {
    const Tait tait{1000, 1500};
    CHECK(std::fabs(tait.pressure(tait.deviation(1)) - 1) < 1e-14);
    // … through a particle's state too. By way of ρ itself it would be off by 1e-7.
    Particles<2> s = place<2>({{0, 0}}, 0.01, {}, tait);
    s.deviation[0] = tait.deviation(1);
    update_state(s, tait, lanes_of_block(s, 0));
    CHECK(std::fabs(s.p[0] - 1) < 1e-14);
}

TEST_CASE("a particle's state follows from mass and deviation") {
    Particles<3> s = place<3>({{0, 0, 0}}, 0.1);
    s.mass[0] = 1.3;
    s.deviation[0] = 40;
    update_state(s, water, lanes_of_block(s, 0));
    CHECK(s.volume[0] == doctest::Approx(1.3 / 1040).epsilon(1e-15));
    CHECK(s.p[0] == water.pressure(40));
    CHECK(s.impedance[0] == doctest::Approx(1040 * water.sound_speed_at(40)).epsilon(1e-15));
}

TEST_CASE("water bears tension inside and none near its surface") {
    Particles<2> s = place<2>({{0, 0}, {1, 0}, {2, 0}}, 0.1);
    for (std::size_t i = 0; i < 3; ++i) s.deviation[i] = -1;
    s.fullness[0] = 1;
    s.fullness[1] = fullness_of_interior - 1e-9;
    s.fullness[2] = 0.1;
    update_state(s, water, lanes_of_block(s, 0));
    CHECK(s.p[0] == water.pressure(-1));
    CHECK(s.p[1] == 0);
    CHECK(s.p[2] == 0);
    for (std::size_t i = 0; i < 3; ++i) CHECK(s.volume[i] == s.mass[i] / 999);  // the density stays
    s.deviation[1] = 1;
    update_state(s, water, lanes_of_block(s, 0));
    CHECK(s.p[1] == water.pressure(1));
}
