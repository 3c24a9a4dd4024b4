// Static equilibrium F_int(u) = F_ext by Newton with the tangent of every iterate, from the forces that hold the
// present displacements to the wanted ones in increments: all at once first, half of it where that fails, twice where
// it was easy. Each increment starts from the one before continued along its direction.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {
constexpr double smallest_increment = 1.0 / 4096;
constexpr int easy_iterations = 6;
}  // namespace

// Newton at start + load_factor (target - start). Converged: |r| <= residual_tolerance × max(|F_ext|, |F_int|) and the
// last correction, squared by Newton's convergence, is below increment_tolerance × |u|; or rounding is reached.
template <int D>
NewtonResult Solver<D>::Implementation::solve_increment(double load_factor, BlockLoop loop) {
    NewtonResult result;
    using Outcome = NewtonResult::Outcome;
    double relative_correction = 1;
    for (;; ++result.iterations) {
        const double smallest_J = assembly.internal_forces(u, internal, loop);
        for (std::size_t e = 0; e < residual.size(); ++e) {
            const std::size_t f = assembly.freedoms()[e];
            external[f] = static_start[f] + load_factor * (static_target[f] - static_start[f]);
            residual[e] = external[f] - internal[f];
        }
        result.last_residual = norm(residual);
        result.reference = std::max(norm_of_free(external), norm_of_free(internal));
        if (result.iterations == 0) result.first_residual = result.last_residual;
        if (!std::isfinite(result.last_residual)) return result.outcome = Outcome::not_finite, result;
        if (!(smallest_J > 0)) return result.outcome = Outcome::inside_out, result;
        if (result.iterations > 0 && result.last_residual <= rounding_floor()) return result;
        if (result.last_residual <= options.residual_tolerance * result.reference &&
            relative_correction * relative_correction <= options.increment_tolerance)
            return result;
        if (result.iterations == options.max_iterations) return result.outcome = Outcome::too_many_iterations, result;

        assembly.system_matrix(u, 1, 0, cholesky.values(), loop);
        ++statistics.matrices;
        if (!factorise()) return result.outcome = Outcome::not_positive_definite, result;
        cholesky.solve(residual, correction);
        for (std::size_t e = 0; e < correction.size(); ++e) u[assembly.freedoms()[e]] += correction[e];
        const double size = norm_of_free(u);
        relative_correction = size > 0 ? norm(correction) / size : 0;
    }
}

template <int D>
void Solver<D>::Implementation::solve_static(std::span<const double> loads, BlockLoop loop) {
    if (loads.size() != u.size())
        throw std::invalid_argument("solid: " + std::to_string(loads.size()) + " load components were given, " +
                                    std::to_string(u.size()) + " are needed (" + std::to_string(D) + " per node)");
    const std::vector<double> start_u = u, start_external = external, start_internal = internal;
    factor = {};
    assembly.internal_forces(u, static_start, loop);
    for (std::size_t f = 0; f < u.size(); ++f) static_target[f] = loads[f] + assembly.gravity_forces()[f];

    double reached = 0, increment = 1, last_increment = 0;
    std::vector<double> u_reached = u, u_before = u;
    while (reached < 1) {
        const double next = std::min(1.0, reached + increment);
        for (std::size_t f = 0; f < u.size(); ++f)
            u[f] = u_reached[f] +
                   (last_increment > 0 ? (next - reached) / last_increment : 0) * (u_reached[f] - u_before[f]);
        const NewtonResult result = solve_increment(next, loop);
        statistics.newton_iterations += result.iterations;
        if (result.converged()) {
            std::swap(u_before, u_reached);
            u_reached = u;
            last_increment = next - reached;
            reached = next;
            statistics.last_iterations = result.iterations;
            statistics.last_residual = result.reference > 0 ? result.last_residual / result.reference : 0;
            if (result.iterations <= easy_iterations) increment *= 2;
            continue;
        }
        increment = 0.5 * (next - reached);
        if (increment >= smallest_increment) continue;
        u = start_u;
        external = start_external;
        internal = start_internal;
        std::ostringstream text;
        text << "solid: no static equilibrium beyond " << 100 * reached << " % of the load: " << result.description();
        if (result.outcome == NewtonResult::Outcome::not_positive_definite)
            text << ". Either the clamps leave the body free to move, or it buckles under this load: clamp it or load "
                    "it less. (A column of quadratic hexahedra one by one across moves without energy: give it two "
                    "across, or full integration)";
        else
            text << ". Load it less, or refine the mesh where it deforms most";
        throw ConvergenceError(text.str());
    }
    std::fill(v.begin(), v.end(), 0.0);
    std::fill(a.begin(), a.end(), 0.0);
    external = static_target;
    accelerations_known = false;
    external_work = 0;
    update_positions();
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
