// The forecast of a stable p: closed forms of a free mass, and an elastic body that the finite element solver steps
// against a damper ρ0 c0 staggered by hand.
#include "physics/coupling/staggered_stability.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::coupling;
using doctest::Approx;

namespace {

StaggeredScheme scheme(bool side_by_side, solid::Scheme of_time, double alpha,
                       Extrapolation extrapolation = Extrapolation::linear) {
    return {.side_by_side = side_by_side,
            .extrapolation = extrapolation,
            .newmark = solid::newmark_coefficients(of_time, alpha)};
}

// The z where a free mass begins to grow, by bisection.
double limit_of_free_mass(const StaggeredScheme& of) {
    double stable = 0.1, unstable = 20;
    while (unstable - stable > 1e-6) {
        const double z = 0.5 * (stable + unstable);
        (growth_per_cycle(of, z, 0) <= 1 + 1e-9 ? stable : unstable) = z;
    }
    return stable;
}

// A stiff block on a soft layer between smooth walls: one mode far below all others. Water that radiates stands on it.
struct Piston {
    static constexpr double width = 0.2, density = 2000, E = 2e5;
    solid::Mesh<2> mesh = solid::box_mesh({0, 0}, {width, 0.2}, 1, 2);
    solid::Options<2> options;
    double omega = 0, mass_per_area = 0;

    Piston(solid::Scheme of_time, double alpha) {
        mesh.element_sets["block"] = {1};
        options.material.density = 0.01 * density;
        options.material.youngs_modulus = E;
        options.parts = {{"block", options.material}};
        options.parts[0].material.density = density;
        options.parts[0].material.youngs_modulus = 1e5 * E;
        options.scheme = of_time;
        options.alpha = alpha;
        options.clamps = {{"bottom", {true, true}}, {"left", {true, false}}, {"right", {true, false}}};
        solid::Solver<2> body(mesh, options);
        const solid::NaturalMode mode = body.natural_modes(1, serial_loop).front();
        const double w = mode.shape[2 * top() + 1];
        omega = std::sqrt(mode.eigenvalue);
        mass_per_area = mode.mass / (w * w * width);
    }
    std::size_t top() const { return std::size_t(mesh.node_set("top").front()); }

    // By how much it grows in a cycle, staggered by hand: the load is the answer to the velocity of one exchange
    // (CSS) or two exchanges (CPS) ago.
    double growth(const StaggeredScheme& of, double impedance, double dt) const {
        solid::Solver<2> body(mesh, options);
        constexpr double start = 1e-8;
        body.set_velocity({0, start});
        constexpr int cycles = 120, from = 60;
        std::vector<double> velocity{start, start, start};  // of the last exchanges, the latest first
        const auto answer = [&](int cycles_ago) {
            return of.extrapolation == Extrapolation::quadratic
                       ? 2 * velocity[std::size_t(cycles_ago)] - velocity[std::size_t(cycles_ago) + 1]
                       : velocity[std::size_t(cycles_ago)];
        };
        double early = 0, late = 0;
        for (int n = 1; n <= cycles; ++n) {
            const double pressure = impedance * answer(of.side_by_side ? 1 : 0);
            body.advance(dt, solid::test::traction(mesh, "top", {0, -pressure}), serial_loop);
            const double v = body.velocities()[2 * top() + 1], x = body.displacements()[2 * top() + 1];
            velocity = {v, velocity[0], velocity[1]};
            const double size = std::hypot(v * dt, x);
            if (n > from - 20 && n <= from) early = std::max(early, size);
            if (n > cycles - 20) late = std::max(late, size);
        }
        return std::pow(late / early, 1.0 / (cycles - from));
    }
};

}  // namespace

TEST_CASE("a free mass against a damper of one cycle ago: closed forms of the limit") {
    using S = solid::Scheme;
    for (const double alpha : {0.0, -0.1, -0.3}) {
        CAPTURE(alpha);
        const double gamma = 0.5 - alpha;
        CHECK(limit_of_free_mass(scheme(false, S::newmark, alpha)) ==
              Approx(std::min(1 / (1 - gamma), gamma > 0.5 ? 2 / (2 * gamma - 1) : 1e9)).epsilon(1e-5));
        // λ³ - λ² + b λ + c = 0 with b = γ z, c = (1 - γ) z lies inside the unit circle while 1 - c² > b + c.
        const double c = 1 - gamma, a = c * c, b = gamma + c;
        CHECK(limit_of_free_mass(scheme(true, S::newmark, alpha)) ==
              Approx((-b + std::sqrt(b * b + 4 * a)) / (2 * a)).epsilon(1e-5));
    }
    CHECK(limit_of_free_mass(scheme(true, S::newmark, 0)) == Approx(2 * (std::sqrt(2.0) - 1)).epsilon(1e-5));
}

TEST_CASE("a body of finite elements against a staggered damper grows as forecast") {
    using S = solid::Scheme;
    struct Case {
        S of_time;
        double alpha;
        bool side_by_side;
        Extrapolation extrapolation;
    };
    int growing = 0, calm = 0;
    for (const Case& c : {Case{S::newmark, -0.3, true, Extrapolation::linear},
                          {S::newmark, -0.3, false, Extrapolation::linear},
                          {S::hht, -0.3, true, Extrapolation::linear},
                          {S::hht, -0.1, true, Extrapolation::linear},
                          {S::hht, -0.1, false, Extrapolation::linear},
                          {S::newmark, -0.3, true, Extrapolation::quadratic}}) {
        const Piston piston(c.of_time, c.alpha);
        const StaggeredScheme of = scheme(c.side_by_side, c.of_time, c.alpha, c.extrapolation);
        for (const double omega_dt : {0.1, 0.6, 1.5})
            for (const double z : {0.05, 0.15, 0.3, 0.6, 0.9, 1.5, 4.0}) {
                CAPTURE(int(c.of_time));
                CAPTURE(c.alpha);
                CAPTURE(c.side_by_side);
                CAPTURE(omega_dt);
                CAPTURE(z);
                const double dt = omega_dt / piston.omega, forecast = growth_per_cycle(of, z, omega_dt);
                // Large displacements long before the end, or nothing left but other modes.
                if (forecast > 1.12 || forecast < 0.85) continue;
                const double measured = piston.growth(of, z * piston.mass_per_area / dt, dt);
                CHECK(measured == Approx(forecast).epsilon(0.01));
                ++(forecast > 1.005 ? growing : calm);
            }
    }
    CHECK(growing > 8);
    CHECK(calm > 20);
}

TEST_CASE("the forecast of p is the last one before some mode grows") {
    const StaggeredScheme css = scheme(false, solid::Scheme::newmark, -0.3);
    // A free mass: 10/3 >= p ρ0 c0 Δt/m''.
    const WetMode heavy{0, 10}, light{0, 5};
    CHECK(largest_stable_ratio(css, std::vector{heavy}, 1000.0, 1e-2 / 3.0001, 100) == 10);
    CHECK(largest_stable_ratio(css, std::vector{heavy, light}, 1000.0, 1e-2 / 3.0001, 100) == 5);
    CHECK(largest_stable_ratio(css, std::vector{heavy}, 1000.0, 1e-4, 100) == 100);
    CHECK(largest_stable_ratio(css, std::vector{heavy}, 1000.0, 1.0, 100) == 0);
    // CPS with HHT, α = -0.3, grows from z = 0.11 on where ω Δt is about 1.2; a mode at 2 comes down to there in water.
    const StaggeredScheme cps = scheme(true, solid::Scheme::hht, -0.3);
    for (const double omega_dt : {1.2, 2.0, 3.0}) {
        CHECK(largest_stable_ratio(cps, std::vector{WetMode{omega_dt / 1e-3, 10}}, 1000.0, 1e-3, 1) == 1);
        CHECK(largest_stable_ratio(cps, std::vector{WetMode{omega_dt / 1e-3, 10}}, 2000.0, 1e-3, 1) == 0);
    }
    CHECK(largest_stable_ratio(cps, std::vector{WetMode{0.3 / 1e-3, 10}}, 2000.0, 1e-3, 1) == 1);
    const WetMode unmoved{100, std::numeric_limits<double>::infinity()};
    CHECK(largest_stable_ratio(css, std::vector{unmoved}, 1000.0, 1.0, 7) == 7);
}
