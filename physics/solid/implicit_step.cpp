// One implicit step. The unknown is the acceleration a_n+1, with u_n+1 = u* + β Δt² a_n+1: at the tiny steps that the
// fluid imposes, an acceleration recovered from a difference of displacements would have lost its digits.
//   residual     r(a) = w_1 (F_ext_n+1 - F_int(u)) + w_0 (F_ext_n - F_int_n) - M a
//   correction   B δa = r,   B = M + w_1 β Δt² K
// With damping, forces F_d(u, v) belong to F_int, v follows a by γ Δt, and B gets w_1 γ Δt ∂F_d/∂v.
// B hardly depends on Δt and K while M leads, so its factorisation lasts for many steps (modified Newton). It is
// renewed
//  - when Δt has left 0.7 … 1.4 of the one it was made for (stiff modes converge with the rate |1 - (Δt/Δt_made)²|);
//  - within a step, when the iterations that are still to come at the present rate would cost more than a new one;
//  - before a step, when the iterations spent because it is old add up to the cost of a new one.
// It is made at the last accepted state, within a step at the present iterate. If all fails, the step is tried once
// more from unchanged displacements: at long steps the predictor "same acceleration" can lie beyond what the material
// stands. Costs are counted in linear solves, never measured, so that runs repeat bit by bit.
//
// Converged: |r| <= residual_tolerance × max(|F_ext|, |F_int|, |M a|), and the displacement error that is left,
// estimated from the rate of convergence θ as θ/(1-θ) |δu| (Hairer & Wanner, Solving ODE II, IV.8), is below
// increment_tolerance × |u_n+1 - u_n|. Or |r| is no larger than rounding makes it. At least one correction is made in
// the first case.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {
constexpr double smallest_step_ratio = 0.7, largest_step_ratio = 1.4;
constexpr int factorisation_cost = 10;     // linear solves with their residuals; measured 8 to 15 on plane meshes
constexpr double newton_tolerance = 1e-5;  // of conjugate gradients: Newton corrects what is left
constexpr int steps_when_new = 4;          // the most iterations of so many steps are what a new factorisation needs
}  // namespace

template <int D>
bool Solver<D>::Implementation::factorise_dynamic(double dt, BlockLoop loop) {
    const double w = newmark.weight_new, mass_factor = 1 + w * newmark.gamma * dt * options.mass_damping;
    factor = {prepare_system(mass_factor, w * newmark.beta * dt * dt, loop, newmark.gamma / (newmark.beta * dt)), dt, 0,
              0, 0};
    return factor.valid;
}

template <int D>
void Solver<D>::Implementation::correct_accelerations(double to_displacement, double dt) {
    const std::size_t equations = assembly.equations();
    for (std::size_t e = 0; e < equations; ++e) {
        const std::size_t f = assembly.freedoms()[e];
        a[f] += correction[e];
        u[f] = predicted_u[f] + to_displacement * a[f];
    }
    if (is_damped()) update_velocities(dt);
    bodies.correct(std::span<const double>(correction).subspan(equations));
    bodies.place(u, v, a);
}

template <int D>
void Solver<D>::Implementation::update_velocities(double dt) {
    for (const std::size_t f : assembly.freedoms())
        v[f] = old_v[f] + dt * ((1 - newmark.gamma) * old_a[f] + newmark.gamma * a[f]);
}

template <int D>
NewtonResult Solver<D>::Implementation::solve_step(double dt, Attempt attempt, BlockLoop loop) {
    const double to_displacement = newmark.beta * dt * dt;
    for (const std::size_t f : assembly.freedoms()) {
        a[f] = attempt == Attempt::from_rest ? (old_u[f] - predicted_u[f]) / to_displacement : old_a[f];
        u[f] = predicted_u[f] + to_displacement * a[f];
    }
    if (is_damped()) update_velocities(dt);
    motions.place(time, u, v, a);
    bodies.begin_step(time, dt, newmark, attempt == Attempt::from_rest);
    bodies.place(u, v, a);
    NewtonResult result;
    using Outcome = NewtonResult::Outcome;
    bool factor_is_new = false;
    if (attempt != Attempt::reusing) {  // at the last accepted state: a predictor may be far out
        linearise_at_start();
        if (!factorise_dynamic(dt, loop)) return result.outcome = Outcome::not_positive_definite, result;
        factor_is_new = true;
    }
    double previous_norm = 0, last_increment = 0;
    for (;; ++result.iterations) {
        const double smallest_J = evaluate_forces(loop);
        const Magnitudes of = dynamic_residual(loop);
        const double norm = std::sqrt(of.residual);
        result.last_residual = norm;
        result.reference = of.reference();
        if (result.iterations == 0) result.first_residual = norm;
        if (!std::isfinite(norm)) return result.outcome = Outcome::not_finite, result;
        if (!(smallest_J > 0)) return result.outcome = Outcome::inside_out, result;

        const double target = options.residual_tolerance * result.reference;
        const double rounding = rounding_floor();
        if (norm <= rounding) return result;
        if (result.iterations > 0) {
            const double rate = norm / previous_norm;
            const double error =
                rate < 1 ? rate / (1 - rate) * last_increment : std::numeric_limits<double>::infinity();
            if (norm <= target && error <= options.increment_tolerance * std::sqrt(of.step)) return result;
            const double to_come = rate < 1 ? std::log(std::max(target, rounding) / norm) / std::log(rate)
                                            : std::numeric_limits<double>::infinity();
            if (to_come > factorisation_cost && !(factor_is_new && rate < 0.1)) {
                linearise_here();
                if (!factorise_dynamic(dt, loop)) return result.outcome = Outcome::not_positive_definite, result;
                factor_is_new = true;
                result.iterations_before_factor = result.iterations;
            }
        }
        if (result.iterations == options.max_iterations) return result.outcome = Outcome::too_many_iterations, result;

        if (!solve_system(newton_tolerance, loop)) return result.outcome = Outcome::not_positive_definite, result;
        correct_accelerations(to_displacement, dt);
        previous_norm = norm;
        last_increment = to_displacement * this->norm(correction);
    }
}

template <int D>
NewtonResult Solver<D>::Implementation::step_implicitly(double dt, BlockLoop loop) {
    for (const std::size_t f : assembly.freedoms())
        predicted_u[f] = old_u[f] + dt * old_v[f] + dt * dt * (0.5 - newmark.beta) * old_a[f];
    const double step_ratio = factor.valid ? dt / factor.time_step : 0;
    const bool reusable =
        step_ratio >= smallest_step_ratio && step_ratio <= largest_step_ratio && factor.excess < factorisation_cost;
    NewtonResult result;
    for (const Attempt attempt : {Attempt::reusing, Attempt::factorising, Attempt::from_rest}) {
        if (attempt == Attempt::reusing && !reusable) continue;
        result = solve_step(dt, attempt, loop);
        statistics.newton_iterations += result.iterations;
        if (result.converged()) break;
    }
    if (!result.converged()) return result;
    const int iterations = result.iterations - result.iterations_before_factor;
    if (factor.steps++ < steps_when_new)
        factor.iterations_when_new = std::max(factor.iterations_when_new, iterations);
    else
        factor.excess += std::max(0, iterations - factor.iterations_when_new);
    update_velocities(dt);
    return result;
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
