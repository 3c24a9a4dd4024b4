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
NewtonResult Solver<D>::Implementation::solve_increment(double part, bool predict, BlockLoop loop) {
    NewtonResult result;
    load_factor = part;
    for (std::size_t k = 0; k < contacts.size(); ++k)
        contacts[k].place_ground(static_start_contacts[k].shift, time, part);
    using Outcome = NewtonResult::Outcome;
    double relative_correction = 1;
    if (!move_held(predict, loop)) return result.outcome = Outcome::not_positive_definite, result;
    for (;; ++result.iterations) {
        const double smallest_J = evaluate_forces(loop, Motion::at_rest);
        const Magnitudes of = static_residual();
        result.last_residual = std::sqrt(of.residual);
        result.reference = of.reference();
        if (result.iterations == 0) result.first_residual = result.last_residual;
        if (!std::isfinite(result.last_residual)) return result.outcome = Outcome::not_finite, result;
        if (!(smallest_J > 0)) return result.outcome = Outcome::inside_out, result;
        if (result.iterations > 0 && result.last_residual <= rounding_floor()) return result;
        if (result.last_residual <= options.residual_tolerance * result.reference &&
            relative_correction * relative_correction <= options.increment_tolerance)
            return result;
        if (result.iterations == options.max_iterations) return result.outcome = Outcome::too_many_iterations, result;

        linearise_here();
        if (!prepare_system(0, 1, loop) || !correct_displacements(loop))
            return result.outcome = Outcome::not_positive_definite, result;
        const double size = size_of_displacements();
        relative_correction = size > 0 ? norm(correction) / size : 0;
    }
}

template <int D>
bool Solver<D>::Implementation::correct_displacements(BlockLoop loop) {
    constexpr double no_gradients = 0;  // without a mass there is always a factor
    if (!solve_system(no_gradients, loop)) return false;
    for (std::size_t e = 0; e < assembly.equations(); ++e) u[assembly.freedoms()[e]] += correction[e];
    bodies.move(std::span<const double>(correction).subspan(assembly.equations()));
    bodies.place(u);
    return true;
}

template <int D>
double Solver<D>::Implementation::size_of_displacements() const {
    double sum = 0;
    for (const std::size_t f : assembly.freedoms()) sum += u[f] * u[f];
    for (const auto& motion : bodies.motions())
        for (const double q : motion.q) sum += q * q;
    return std::sqrt(sum);
}

// Takes what is prescribed to its place. With `predict` the rest follows by one linear step, r - K Δu: elements beside
// the moved nodes would be crushed before Newton could begin. False: not positive definite.
template <int D>
bool Solver<D>::Implementation::move_held(bool predict, BlockLoop loop) {
    if (motions.freedoms().empty() && bodies.prescribed().empty()) return true;
    if (predict) {
        linearise_here();
        evaluate_forces(loop, Motion::at_rest);
        static_residual();
        if (!prepare_system(0, 1, loop)) return false;
    }
    motions.ramp(time, load_factor, static_start_u, u);
    bodies.ramp(time, load_factor, static_start_bodies);
    bodies.place(u);
    if (!predict) return true;
    std::vector<double> step = u, product(u.size()), body_product(bodies.coordinates());
    for (std::size_t f = 0; f < u.size(); ++f) step[f] -= linearised.u[f];
    assembly.multiply_stiffness(step, product, loop);
    for (std::size_t e = 0; e < assembly.equations(); ++e) residual[e] -= product[assembly.freedoms()[e]];
    bodies.gather(product, body_product);
    for (std::size_t n = 0; n < bodies.unknowns().size(); ++n)
        residual[assembly.equations() + n] -= body_product[bodies.unknowns()[n]];
    return correct_displacements(loop);
}

template <int D>
void Solver<D>::Implementation::solve_static(std::span<const double> given_loads, BlockLoop loop) {
    take_loads(given_loads);
    const std::vector<double> start_external = external, start_internal = internal;
    static_start_u = u;
    static_start_bodies = bodies.motions();
    factor = {};
    keep_histories(static_start_contacts);
    for (GroundContact<D>& contact : contacts) contact.place_ground(contact.history().shift, time, 0);
    evaluate_forces(loop, Motion::at_rest);
    static_start = internal;
    body_static_start = body_internal;

    double reached = 0, increment = 1, last_increment = 0;
    std::vector<double> u_reached = u, u_before = u;
    BodyMotions bodies_reached = bodies.motions(), bodies_before = bodies_reached;
    while (reached < 1) {
        const double next = std::min(1.0, reached + increment);
        const double ratio = last_increment > 0 ? (next - reached) / last_increment : 0;
        for (std::size_t f = 0; f < u.size(); ++f) u[f] = u_reached[f] + ratio * (u_reached[f] - u_before[f]);
        bodies.set_motions(bodies_reached);
        bodies.extrapolate(bodies_before, ratio);
        bodies.place(u);
        const NewtonResult result = solve_increment(next, last_increment == 0, loop);
        statistics.newton_iterations += result.iterations;
        if (result.converged()) {
            for (GroundContact<D>& contact : contacts) contact.accept();
            std::swap(u_before, u_reached);
            u_reached = u;
            std::swap(bodies_before, bodies_reached);
            bodies_reached = bodies.motions();
            last_increment = next - reached;
            reached = next;
            statistics.last_iterations = result.iterations;
            statistics.last_residual = result.reference > 0 ? result.last_residual / result.reference : 0;
            if (result.iterations <= easy_iterations) increment *= 2;
            continue;
        }
        increment = 0.5 * (next - reached);
        if (increment >= smallest_increment) continue;
        u = static_start_u;
        bodies.set_motions(static_start_bodies);
        for (std::size_t k = 0; k < contacts.size(); ++k) contacts[k].set_history(static_start_contacts[k], u);
        load_factor = 1;
        external = start_external;
        internal = start_internal;
        std::swap(previous_loads, loads);
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
    std::fill(inertia.begin(), inertia.end(), 0.0);
    bodies.come_to_rest();
    for (GroundContact<D>& contact : contacts) contact.reset_energies(0, 0);
    accelerations_known = false;
    account = {};
    stable_step = 0;
    update_positions();
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
