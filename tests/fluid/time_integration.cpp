// The order of the time integration: on oscillators with a known solution and on water itself.
#include "physics/fluid/time_integration.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

double order_between(double coarse, double fine) {
    return std::log2(coarse / fine);
}

// Every particle is an oscillator with damping and frequency of its own, x'' = -ω² x - 2κ x', and its density decays
// against its place, δ' = x - κ δ, so that all three rates depend on one another's results.
template <int D>
double oscillator_error(int steps, IntegrationScheme scheme) {
    constexpr std::size_t n = 150;  // two blocks
    std::vector<Point<D>> points(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t d = 0; d < D; ++d) points[i][d] = 1 + 0.1 * static_cast<double>(d);
    Particles<D> s = place<D>(points, 0.1);
    TimeIntegration<D> rk;
    rk.scheme = scheme;
    rk.resize(s);
    const auto omega = [](std::size_t i) { return 1 + 0.01 * static_cast<double>(i); };
    const double kappa = 0.2, dt = 1.0 / steps;
    const auto rates = [&](LaneRange lanes) {
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            for (std::size_t d = 0; d < D; ++d)
                s.acceleration[d][i] = -omega(i) * omega(i) * s.x[d][i] - 2 * kappa * s.v[d][i];
            s.deviation_rate[i] = s.x[0][i] - kappa * s.deviation[i];
        }
    };
    for (std::size_t block = 0; block < s.blocks(); ++block) {
        const LaneRange lanes = lanes_of_block(s, block);
        rates(lanes);
        for (int step = 0; step < steps; ++step) {
            if (rk.predicts()) predict(s, rk, water, dt, lanes);
            for (int stage = 0; stage < rk.stages(); ++stage) {
                rates(lanes);
                advance_stage(s, rk, water, stage, dt, lanes);
            }
        }
    }
    // From rest: x = x0 e^{-κt} (cos βt + κ/β sin βt), β² = ω² - κ², and e^{κt} δ = ∫ e^{κt} x dt.
    double error = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double beta = std::sqrt(omega(i) * omega(i) - kappa * kappa), t = 1, decay = std::exp(-kappa * t);
        const double shape = decay * (std::cos(beta * t) + kappa / beta * std::sin(beta * t));
        const double slope = -decay * omega(i) * omega(i) / beta * std::sin(beta * t);
        for (std::size_t d = 0; d < D; ++d) {
            error = std::max(error, std::fabs(s.x[d][i] - points[i][d] * shape));
            error = std::max(error, std::fabs(s.v[d][i] - points[i][d] * slope));
        }
        const double deviation =
            decay * points[i][0] * (std::sin(beta * t) / beta + kappa / (beta * beta) * (1 - std::cos(beta * t)));
        error = std::max(error, std::fabs(s.deviation[i] - deviation));
        CHECK(s.p[i] == water.pressure(s.deviation[i]));
    }
    return error;
}

// A free square of water at a pressure high enough that tension never arises, stirred smoothly. Reconstruction is off:
// the limiter has kinks, and RK4 loses its order at each of them. What is left are pairs that cross the edge of the
// support, where W' ~ (1 - r/R)³ has a jump in its third derivative: worth O(Δt⁴) once per crossing, like the method.
Fluid<2> stirred_square() {
    Fluid<2> fluid = make_fluid<2>(0.1, Tait{1000, 10}, {.muscl = false});
    Random random(3);
    fluid.particles = place<2>(lattice<2>({12, 11}, fluid.spacing, 0.1, random), fluid.spacing);
    auto& s = fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        s.v[0][i] = 0.3 * std::sin(2 * s.x[1][i]) + 0.2 * s.x[0][i];
        s.v[1][i] = -0.4 * std::cos(3 * s.x[0][i]);
        s.deviation[i] = 20 + 3 * std::sin(2 * s.x[0][i] + s.x[1][i]);
        s.mass[i] = (1000 + s.deviation[i]) * fluid.spacing * fluid.spacing;
    }
    fluid.lists.skin = 3 * fluid.spacing;  // built once: nothing changes but Δt
    return fluid;
}

std::vector<double> state_after(double until, int steps, IntegrationScheme scheme) {
    Driver<2> driver(stirred_square());
    driver.fluid.integration.scheme = scheme;
    driver.start();
    for (int step = 0; step < steps; ++step) driver.step(until / steps);
    CHECK(driver.fluid.rebuilds == 1);
    for (std::size_t i = 0; i < driver.fluid.particles.count; ++i) CHECK(driver.fluid.particles.p[i] > 0);
    return state_by_id(driver.fluid.particles);
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE("oscillators converge with the order of the integration") {
    const std::pair<IntegrationScheme, double> schemes[] = {
        {IntegrationScheme::rk4, 4}, {IntegrationScheme::rk3, 3}, {IntegrationScheme::verlet, 2}};
    for (const auto& [scheme, expected] : schemes)
        for (const bool three : {false, true}) {
            CAPTURE(expected);
            const auto error = [&](int steps) {
                return three ? oscillator_error<3>(steps, scheme) : oscillator_error<2>(steps, scheme);
            };
            const double errors[] = {error(20), error(40), error(80), error(160)};
            for (int k = 0; k < 3; ++k) {
                const double order = order_between(errors[k], errors[k + 1]);
                CAPTURE(errors[k + 1]);
                CHECK(order > expected - 0.1);
                CHECK(order < expected + 0.2);
            }
        }
}

TEST_CASE("water converges with the order of the integration in time") {
    const double until = 0.012;  // the largest stable step of RK4 is 0.375 R/c = 0.015
    const auto reference = state_after(until, 64, IntegrationScheme::rk4);
    const std::tuple<IntegrationScheme, int, double> schemes[] = {
        {IntegrationScheme::rk4, 1, 3.9}, {IntegrationScheme::rk3, 2, 2.9}, {IntegrationScheme::verlet, 4, 1.9}};
    for (const auto& [scheme, first, expected] : schemes) {
        CAPTURE(expected);
        double errors[4];
        for (int k = 0; k < 4; ++k) errors[k] = difference(state_after(until, first << k, scheme), reference);
        for (int k = 0; k < 3; ++k) {
            const double order = order_between(errors[k], errors[k + 1]);
            CAPTURE(errors[k]);
            CAPTURE(errors[k + 1]);
            CHECK(order > expected);
        }
    }
}

TEST_CASE("water with an open support bears no tension and keeps nine tenths of its density") {
    Particles<2> s = place<2>({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, 0.1);
    const double deviation[] = {-500, -50, -500, 20}, fullness[] = {0.5, 0.5, 1, 0.5};
    for (std::size_t i = 0; i < 4; ++i) {
        s.deviation[i] = deviation[i];
        s.fullness[i] = fullness[i];
    }
    update_state(s, water, LaneRange{0, 4});
    CHECK(s.deviation[0] == doctest::Approx(-100).epsilon(1e-12));
    CHECK(s.volume[0] == doctest::Approx(s.mass[0] / 900).epsilon(1e-12));
    CHECK(s.p[0] == 0);
    CHECK(s.deviation[1] == -50);
    CHECK(s.p[1] == 0);
    CHECK(s.deviation[2] == -500);  // inside it is the state of the water
    CHECK(s.p[2] == water.pressure(-500));
    CHECK(s.p[3] == water.pressure(20));
}
