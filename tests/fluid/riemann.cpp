// The Riemann problem: the acoustic solver against the exact one, the exact one against the waves' own relations.
#include "physics/fluid/riemann.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "physics/fluid/schemes/ale_pair.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

struct State {
    double u, p;
};

double density(double p) {
    return water.reference_density * std::pow(1 + p / water.stiffness(), 1 / water.exponent);
}
double sound(double p) {
    return water.sound_speed * std::pow(density(p) / water.reference_density, (water.exponent - 1) / 2);
}
InterfaceState acoustic(State L, State R) {
    return acoustic_riemann(L.u, L.p, density(L.p) * sound(L.p), R.u, R.p, density(R.p) * sound(R.p));
}
InterfaceState exact(State L, State R) {
    return exact_riemann(water, L.u, L.p, R.u, R.p);
}

// Across the wave between (u, p) and the interface state; `side` is -1 for the left wave, 1 for the right one.
void check_wave(State outer, InterfaceState e, int side) {
    const double rho = density(outer.p), rho_e = density(e.pressure);
    if (e.pressure > outer.p * (1 + 1e-9)) {  // shock of speed s: mass and momentum go through it unchanged
        const double s = (rho_e * e.velocity - rho * outer.u) / (rho_e - rho);
        CHECK(side * (s - outer.u) > sound(outer.p) * (1 - 1e-6));        // faster than sound ahead of it …
        CHECK(side * (s - e.velocity) < sound(e.pressure) * (1 + 1e-6));  // … slower than sound behind
        const double before = rho * outer.u * (outer.u - s) + outer.p,
                     behind = rho_e * e.velocity * (e.velocity - s) + e.pressure;
        CHECK(std::fabs(before - behind) < 1e-9 * water.stiffness());
    } else {  // rarefaction: u ± 2c/(γ-1) goes through
        const double factor = -side * 2 / (water.exponent - 1);
        CHECK(std::fabs(outer.u + factor * sound(outer.p) - e.velocity - factor * sound(e.pressure)) <
              1e-11 * water.sound_speed);
    }
}

const double c0 = water.sound_speed, K = water.stiffness();

}  // namespace

TEST_CASE("equal states stay as they are") {
    for (const State s : {State{0, 0}, State{3, 1000}, State{-2, -500}}) {
        for (const InterfaceState e : {acoustic(s, s), exact(s, s)}) {
            CHECK(e.velocity == doctest::Approx(s.u).epsilon(1e-14));
            CHECK(std::fabs(e.pressure - s.p) < 1e-12 * K);
        }
    }
}

TEST_CASE("symmetric states meet at rest: pushed together the pressure rises, pulled apart it falls") {
    for (const double u : {0.05 * c0, -0.05 * c0}) {
        for (const InterfaceState e : {acoustic({u, 500}, {-u, 500}), exact({u, 500}, {-u, 500})}) {
            CHECK(std::fabs(e.velocity) < 1e-13 * c0);
            CHECK((e.pressure > 500) == (u > 0));
        }
    }
    // By hand: p_e = p + ρ c u.
    CHECK(acoustic({1, 500}, {-1, 500}).pressure == doctest::Approx(500 + density(500) * sound(500)).epsilon(1e-14));
}

TEST_CASE("the solution does not know left from right, nor a moving observer") {
    Random random;
    for (int k = 0; k < 50; ++k) {
        const State L{0.1 * c0 * random(), 0.3 * K * random()}, R{0.1 * c0 * random(), 0.3 * K * random()};
        const double boost = c0 * random();
        for (const auto solve : {acoustic, exact}) {
            const InterfaceState e = solve(L, R), mirrored = solve({-R.u, R.p}, {-L.u, L.p}),
                                 moving = solve({L.u + boost, L.p}, {R.u + boost, R.p});
            CHECK(std::fabs(e.velocity + mirrored.velocity) < 1e-12 * c0);
            CHECK(std::fabs(e.velocity + boost - moving.velocity) < 1e-12 * c0);
            CHECK(std::fabs(e.pressure - mirrored.pressure) < 1e-12 * K);
            CHECK(std::fabs(e.pressure - moving.pressure) < 1e-12 * K);
        }
    }
}

TEST_CASE("the exact solver's waves satisfy jump relations and invariants") {
    Random random;
    int shocks = 0, rarefactions = 0;
    for (int k = 0; k < 200; ++k) {
        const State L{0.15 * c0 * random(), 0.5 * K * random()}, R{0.15 * c0 * random(), 0.5 * K * random()};
        CAPTURE(k);
        const InterfaceState e = exact(L, R);
        check_wave(L, e, -1);
        check_wave(R, e, 1);
        for (const State s : {L, R}) ++(e.pressure > s.p ? shocks : rarefactions);
    }
    CHECK(shocks > 50);
    CHECK(rarefactions > 50);
}

TEST_CASE("the acoustic solver differs from the exact one in second order of the jump") {
    Random random;
    for (int k = 0; k < 20; ++k) {
        const State jump_L{c0 * random(), 6 * K * random()}, jump_R{c0 * random(), 6 * K * random()};
        double difference_u[3], difference_p[3];
        for (int level = 0; level < 3; ++level) {
            const double size = 1e-2 * std::pow(0.25, level);
            const State L{size * jump_L.u, size * jump_L.p}, R{size * jump_R.u, size * jump_R.p};
            const InterfaceState a = acoustic(L, R), e = exact(L, R);
            // Largest component, so that one of them passing through zero does not pretend an order.
            difference_u[level] = std::fabs(a.velocity - e.velocity) / c0;
            difference_p[level] = std::fabs(a.pressure - e.pressure) / K;
        }
        for (int level = 0; level < 2; ++level) {
            const auto total = [&](int l) { return std::hypot(difference_u[l], difference_p[l]); };
            const double order = std::log(total(level) / total(level + 1)) / std::log(4);
            CAPTURE(k);
            CHECK(order == doctest::Approx(2).epsilon(0.03));
        }
    }
    // Equal for tiny jumps.
    const InterfaceState a = acoustic({1e-6 * c0, 0}, {0, 1e-6 * K}), e = exact({1e-6 * c0, 0}, {0, 1e-6 * K});
    CHECK(std::fabs(a.velocity - e.velocity) < 1e-11 * c0);
    CHECK(std::fabs(a.pressure - e.pressure) < 1e-10 * K);
}

TEST_CASE("states that tear apart faster than water can follow are refused") {
    // Two rarefactions bridge at most u_R - u_L = 2c/(γ-1) each: 2/3 c0 together from rest.
    const InterfaceState e = exact({-0.32 * c0, 0}, {0.32 * c0, 0});
    CHECK(std::fabs(e.velocity) < 1e-12 * c0);
    CHECK(e.pressure > -K);
    CHECK(e.pressure < -0.9 * K);
    CHECK_THROWS_AS(exact({-0.34 * c0, 0}, {0.34 * c0, 0}), std::runtime_error);
    CHECK_THROWS_AS(exact({-2 * c0, 0}, {c0, 300}), std::runtime_error);
}

TEST_CASE("the exact solver that works in lanes is the exact solver") {
    Random random(17);
    double error_u = 0, error_p = 0;
    for (int k = 0; k < 2000; ++k) {
        // Up to Mach 0.3 and the pressures that go with it; then tiny differences, where shocks are weakest.
        const double size = k % 2 == 0 ? 1 : 1e-6;
        const State L{size * 0.3 * c0 * random(), 0.2 * K * (1 + size * random())},
            R{size * 0.3 * c0 * random(), 0.2 * K * (1 + size * random())};
        const InterfaceState reference = exact(L, R), lanes = exact_water_riemann(water, L.u, L.p, R.u, R.p);
        error_u = std::max(error_u, std::fabs(lanes.velocity - reference.velocity) / c0);
        error_p = std::max(error_p, std::fabs(lanes.pressure - reference.pressure) / K);
    }
    CAPTURE(error_u);
    CAPTURE(error_p);
    CHECK(error_u < 1e-12);
    CHECK(error_p < 1e-12);
    const InterfaceState same = exact_water_riemann(water, 1, 100, 1, 100);
    CHECK(same.velocity == doctest::Approx(1).epsilon(1e-14));
    CHECK(std::fabs(same.pressure - 100) < 1e-12 * K);
}

TEST_CASE("the series of the density is Tait's") {
    for (const double gamma : {1.4, 7.0}) {
        const Tait tait{1000, 20, gamma};
        const DensitySeries density(tait);
        for (const double s : {-0.02, -0.001, 0.0, 0.001, 0.01, 0.02}) {  // p/(ρ0 c0²): 0.02 is Mach 0.2
            const double p = s * 1000 * 20 * 20, rho = 1000 + tait.deviation(p);
            CHECK(std::fabs(density(p) - rho) < 1000 * 400 * std::pow(std::fabs(s), 5) + 1e-12 * rho);
        }
    }
}
