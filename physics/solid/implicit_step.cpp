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
// It is made at the last accepted state, within a step at the present iterate. If that fails, the step is tried once
// more with a new one wherever the residual falls slowly, and then from unchanged displacements: at long steps the
// predictor "same acceleration" can lie beyond what the material stands. Costs are counted in linear solves, never
// measured, so that runs repeat bit by bit.
//
// Newton starts from the accelerations of the step before. Those of modes much faster than the step are what is left of
// a load's sudden beginning and change their sign every step: where the start leaves many times the force that there
// was in the body and is put on it, unchanged displacements are tried, and the smaller residual is taken.
//
// The rate of convergence θ is that of the corrections, |δu_k|/|δu_k-1| (Hairer & Wanner, Solving ODE II, IV.8): the
// residual of the first correction is mostly what bending has stretched, large in force and next to nothing in
// displacement, and the second correction takes it away. Converged: |r| <= residual_tolerance × max(|F_ext|, |F_int|,
// |M a|), and the displacement error that is left, θ/(1-θ) |δu|, is below increment_tolerance × |u_n+1 - u_n|. Or |r|
// is no larger than rounding makes it. At least one correction is made in the first case; after one, the residuals
// stand for the corrections.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {
constexpr double smallest_step_ratio = 0.7, largest_step_ratio = 1.4;
constexpr int factorisation_cost = 10;     // linear solves with their residuals; measured 8 to 15 on plane meshes
constexpr double newton_tolerance = 1e-5;  // of conjugate gradients: Newton corrects what is left
// The most iterations of so many steps of about the size that it was made for are what a new factorisation needs.
constexpr int steps_when_new = 4;
constexpr double steady = 0.05;
constexpr double far_out = 10;
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
void Solver<D>::Implementation::guess(Guess guess, double dt) {
    const double to_displacement = newmark.beta * dt * dt;
    for (const std::size_t f : assembly.freedoms()) {
        a[f] = guess == Guess::same_accelerations ? old_a[f] : (old_u[f] - predicted_u[f]) / to_displacement;
        u[f] = predicted_u[f] + to_displacement * a[f];
    }
    if (is_damped()) update_velocities(dt);
    motions.place(time, u, v, a);
    bodies.begin_step(time, dt, newmark, guess == Guess::same_displacements);
    bodies.place(u, v, a);
}

template <int D>
double Solver<D>::Implementation::norm_of_forces() const {
    double loads2 = 0, internal2 = contact_size2;
    for (std::size_t f = 0; f < u.size(); ++f) {
        loads2 += external[f] * external[f];
        internal2 += previous_internal[f] * previous_internal[f];
    }
    return std::sqrt(std::max(loads2, internal2));
}

template <int D>
double Solver<D>::Implementation::first_iterate(double dt, Attempt attempt, BlockLoop loop) {
    const auto start = [&](Guess from) {
        guess(from, dt);
        return evaluate_forces(loop);
    };
    if (attempt == Attempt::from_rest) return start(Guess::same_displacements);
    const double smallest_J = start(Guess::same_accelerations);
    if (attempt == Attempt::renewing) return smallest_J;
    const double norm = std::sqrt(dynamic_residual(loop).residual);
    if (norm <= far_out * norm_of_forces()) return smallest_J;
    const double smallest_J_at_rest = start(Guess::same_displacements);
    if (!(norm <= std::sqrt(dynamic_residual(loop).residual))) return smallest_J_at_rest;
    return start(Guess::same_accelerations);
}

template <int D>
NewtonResult Solver<D>::Implementation::solve_step(double dt, Attempt attempt, BlockLoop loop) {
    const double to_displacement = newmark.beta * dt * dt;
    NewtonResult result;
    using Outcome = NewtonResult::Outcome;
    bool factor_is_new = false;
    if (attempt != Attempt::reusing) {  // at the last accepted state: a predictor may be far out
        linearise_at_start();
        if (!factorise_dynamic(dt, loop)) return result.outcome = Outcome::not_positive_definite, result;
        factor_is_new = true;
    }
    double smallest_J = first_iterate(dt, attempt, loop);
    double previous_norm = 0, increment = 0, previous_increment = 0;
    for (;; ++result.iterations) {
        if (result.iterations > 0) smallest_J = evaluate_forces(loop);
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
            const double rate = result.iterations > 1 ? increment / previous_increment : norm / previous_norm;
            const double error = rate < 1 ? rate / (1 - rate) * increment : std::numeric_limits<double>::infinity();
            if (norm <= target && error <= options.increment_tolerance * std::sqrt(of.step)) return result;
            const double to_come = rate < 1 ? std::log(std::max(target, rounding) / norm) / std::log(rate)
                                            : std::numeric_limits<double>::infinity();
            const bool is_known = result.iterations > 1 || attempt >= Attempt::renewing;
            if (is_known && to_come > factorisation_cost && !(factor_is_new && rate < 0.1)) {
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
        previous_increment = increment;
        increment = to_displacement * this->norm(correction);
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
    for (const Attempt attempt : {Attempt::reusing, Attempt::factorising, Attempt::renewing, Attempt::from_rest}) {
        if (attempt == Attempt::reusing && !reusable) continue;
        result = solve_step(dt, attempt, loop);
        statistics.newton_iterations += result.iterations;
        if (result.converged()) break;
    }
    if (!result.converged()) return result;
    const int iterations = result.iterations - result.iterations_before_factor;
    if (factor.steps < steps_when_new && std::fabs(dt - factor.time_step) < steady * dt) {
        ++factor.steps;
        factor.iterations_when_new = std::max(factor.iterations_when_new, iterations);
    } else {
        factor.excess += std::max(0, iterations - factor.iterations_when_new);
    }
    update_velocities(dt);
    return result;
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
