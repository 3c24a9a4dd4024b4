// One implicit step. The unknown is the acceleration a_n+1, with u_n+1 = u* + β Δt² a_n+1: at the tiny steps that the
// fluid imposes, an acceleration recovered from a difference of displacements would have lost its digits.
//   residual     r(a) = w_1 (F_ext_n+1 - F_int(u)) + w_0 (F_ext_n - F_int_n) - M a
//   correction   B δa = r,   B = M + w_1 β Δt² K
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
#include <sstream>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {
constexpr double smallest_step_ratio = 0.7, largest_step_ratio = 1.4;
constexpr int factorisation_cost = 10;     // linear solves with their residuals; measured 8 to 15 on plane meshes
constexpr double newton_tolerance = 1e-5;  // of conjugate gradients: Newton corrects what is left
constexpr double to_rounding = 1e-14;      // a system that Newton does not come back to
constexpr int steps_when_new = 4;          // the most iterations of so many steps are what a new factorisation needs
}  // namespace

std::string NewtonResult::description() const {
    std::ostringstream text;
    switch (outcome) {
        case Outcome::converged:
            text << "converged";
            break;
        case Outcome::too_many_iterations:
            text << "the residual did not fall far enough";
            break;
        case Outcome::inside_out:
            text << "an element turned inside out";
            break;
        case Outcome::not_finite:
            text << "the residual is not finite";
            break;
        case Outcome::not_positive_definite:
            text << "the system matrix is not positive definite";
            break;
    }
    text << " (residual " << first_residual << " N at first, " << last_residual << " N after " << iterations
         << " iterations, reference force " << reference << " N)";
    return text.str();
}

template <int D>
bool Solver<D>::Implementation::factorise_dynamic(const std::vector<double>& at, double dt, BlockLoop loop) {
    assembly.system_matrix(at, newmark.weight_new * newmark.beta * dt * dt, 1, cholesky.values(), loop);
    ++statistics.matrices;
    factor = {true, dt, 0, 0, 0};
    factored_at = at;
    by_gradients = gradients_are_cheaper(dt);
    if (by_gradients) return true;
    return factor.valid = factorise();
}

// M a_n = F_ext - F_int
template <int D>
void Solver<D>::Implementation::find_initial_accelerations(BlockLoop loop) {
    assembly.internal_forces(u, internal, loop);
    assembly.system_matrix(u, 0, 1, cholesky.values(), loop);
    ++statistics.matrices;
    factor = {};
    for (std::size_t e = 0; e < residual.size(); ++e) {
        const std::size_t f = assembly.freedoms()[e];
        residual[e] = external[f] - internal[f];
    }
    by_gradients = gradients_are_cheaper(0);
    if ((!by_gradients && !factorise()) || !solve_linear(residual, correction, loop, to_rounding))
        throw ConvergenceError("solid: the mass matrix is not positive definite");
    std::fill(old_a.begin(), old_a.end(), 0.0);
    for (std::size_t e = 0; e < correction.size(); ++e) old_a[assembly.freedoms()[e]] = correction[e];
}

template <int D>
NewtonResult Solver<D>::Implementation::solve_step(double dt, Attempt attempt, BlockLoop loop) {
    const double to_displacement = newmark.beta * dt * dt;
    for (const std::size_t f : assembly.freedoms()) {
        a[f] = attempt == Attempt::from_rest ? (old_u[f] - predicted_u[f]) / to_displacement : old_a[f];
        u[f] = predicted_u[f] + to_displacement * a[f];
    }
    NewtonResult result;
    using Outcome = NewtonResult::Outcome;
    bool factor_is_new = false;
    if (attempt != Attempt::reusing) {  // at the last accepted state: a predictor may be far out
        if (!factorise_dynamic(old_u, dt, loop)) return result.outcome = Outcome::not_positive_definite, result;
        factor_is_new = true;
    }
    double previous_norm = 0, last_increment = 0;
    for (;; ++result.iterations) {
        const double smallest_J = assembly.internal_forces(u, internal, loop);
        assembly.multiply_mass(a, inertia, loop);
        double external_square = 0, internal_square = 0, inertia_square = 0, step_square = 0, residual_square = 0;
        for (std::size_t e = 0; e < residual.size(); ++e) {
            const std::size_t f = assembly.freedoms()[e];
            residual[e] = newmark.weight_new * (external[f] - internal[f]) +
                          newmark.weight_old * (previous_external[f] - previous_internal[f]) - inertia[f];
            residual_square += residual[e] * residual[e];
            external_square += external[f] * external[f];
            internal_square += internal[f] * internal[f];
            inertia_square += inertia[f] * inertia[f];
            step_square += (u[f] - old_u[f]) * (u[f] - old_u[f]);
        }
        const double norm = std::sqrt(residual_square);
        result.last_residual = norm;
        result.reference = std::sqrt(std::max({external_square, internal_square, inertia_square}));
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
            if (norm <= target && error <= options.increment_tolerance * std::sqrt(step_square)) return result;
            const double to_come = rate < 1 ? std::log(std::max(target, rounding) / norm) / std::log(rate)
                                            : std::numeric_limits<double>::infinity();
            if (to_come > factorisation_cost && !(factor_is_new && rate < 0.1)) {
                if (!factorise_dynamic(u, dt, loop)) return result.outcome = Outcome::not_positive_definite, result;
                factor_is_new = true;
                result.iterations_before_factor = result.iterations;
            }
        }
        if (result.iterations == options.max_iterations) return result.outcome = Outcome::too_many_iterations, result;

        if (!solve_linear(residual, correction, loop, newton_tolerance))
            return result.outcome = Outcome::not_positive_definite, result;
        for (std::size_t e = 0; e < correction.size(); ++e) {
            const std::size_t f = assembly.freedoms()[e];
            a[f] += correction[e];
            u[f] = predicted_u[f] + to_displacement * a[f];
        }
        previous_norm = norm;
        last_increment = to_displacement * this->norm(correction);
    }
}

template <int D>
void Solver<D>::Implementation::advance(double dt, std::span<const double> loads, BlockLoop loop) {
    if (!(dt > 0) || !std::isfinite(dt))
        throw std::invalid_argument("solid: the time step must be positive, it is " + std::to_string(dt));
    if (loads.size() != u.size())
        throw std::invalid_argument("solid: " + std::to_string(loads.size()) + " load components were given, " +
                                    std::to_string(u.size()) + " are needed (" + std::to_string(D) + " per node)");
    old_u = u;
    old_v = v;
    old_a = a;
    const auto go_back = [&] {
        u = old_u;
        v = old_v;
        a = old_a;
        if (!accelerations_known) {
            std::fill(a.begin(), a.end(), 0.0);
        } else {
            external = previous_external;
            internal = previous_internal;
        }
        factor = {};
    };
    const std::vector<double>& gravity = assembly.gravity_forces();
    std::swap(previous_external, external);
    std::swap(previous_internal, internal);
    for (std::size_t f = 0; f < u.size(); ++f) external[f] = loads[f] + gravity[f];
    if (!accelerations_known) {
        find_initial_accelerations(loop);
        previous_external = external;
        previous_internal = internal;
    }
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
    if (!result.converged()) {
        go_back();
        std::ostringstream text;
        text << "solid: Newton failed in step " << statistics.steps + 1 << " of size " << dt
             << " s: " << result.description()
             << ". Reduce the time step of the solid (or the ratio p); if it fails at any step, look at the loads, the "
                "clamps and the mesh";
        throw ConvergenceError(text.str());
    }

    const int iterations = result.iterations - result.iterations_before_factor;
    if (factor.steps++ < steps_when_new)
        factor.iterations_when_new = std::max(factor.iterations_when_new, iterations);
    else
        factor.excess += std::max(0, iterations - factor.iterations_when_new);
    double work = 0;
    for (const std::size_t f : assembly.freedoms()) {
        v[f] = old_v[f] + dt * ((1 - newmark.gamma) * old_a[f] + newmark.gamma * a[f]);
        work += 0.5 * (external[f] + previous_external[f] - 2 * gravity[f]) * (u[f] - old_u[f]);
    }
    external_work += work;
    accelerations_known = true;
    update_positions();
    ++statistics.steps;
    statistics.last_iterations = result.iterations;
    statistics.last_residual = result.reference > 0 ? result.last_residual / result.reference : 0;
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
