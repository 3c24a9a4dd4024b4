// What the steps of all schemes have in common: their start, the first accelerations, their end.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {
constexpr double to_rounding = 1e-14;  // a system that Newton does not come back to
}

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

// M a_n = F_ext - F_int, with the loads of the end of the step; what is prescribed has the rates of its law.
// Resolved: (M + w β Δt² K) a_n instead, w the weight of the step's end. A mode then has F/(m (1 + w β ω² Δt²)): those
// that the step resolves keep theirs but for O(ω² Δt²), once, so that the order stays, and those that are much faster
// move in a step by about as much as they would statically.
template <int D>
void Solver<D>::Implementation::find_initial_accelerations(double dt, BlockLoop loop) {
    std::fill(a.begin(), a.end(), 0.0);
    motions.set_rates(time, v, a);
    bodies.set_rates(time);
    bodies.place(u, v, a);
    for (GroundContact<D>& contact : contacts) contact.place_ground({}, time, 1);
    evaluate_forces(loop);
    previous_external = external;
    previous_internal = internal;
    previous_damping = damping;
    previous_loads = loads;
    body_previous_external = body_external;
    body_previous_internal = body_internal;
    body_previous_loads = body_loads;
    dynamic_residual(loop);
    linearise_here();
    factor = {};
    const bool resolves = options.first_accelerations == FirstAccelerations::resolved;
    const double stiffness_factor = resolves ? newmark.weight_new * newmark.beta * dt * dt : 0;
    const bool solved = is_explicit() ? solve_lumped(loop)
                                      : prepare_system(1, stiffness_factor, loop) && solve_system(to_rounding, loop);
    if (!solved) throw ConvergenceError("solid: the system matrix of the first accelerations is not positive definite");
    for (std::size_t e = 0; e < assembly.equations(); ++e) a[assembly.freedoms()[e]] = correction[e];
    bodies.add_accelerations(std::span<const double>(correction).subspan(assembly.equations()));
    bodies.place(u, v, a);
    dynamic_residual(loop);  // for M a
    old_v = v;
    old_a = a;
    old_bodies = bodies.motions();
}

// The forces at the end of the last step are those at the start of this one.
template <int D>
void Solver<D>::Implementation::keep_forces() {
    std::swap(previous_external, external);
    std::swap(previous_internal, internal);
    std::swap(previous_damping, damping);
    std::swap(body_previous_external, body_external);
    std::swap(body_previous_internal, body_internal);
    std::swap(body_previous_loads, body_loads);
}

// Remembers the start of the step and everything that acts there.
template <int D>
void Solver<D>::Implementation::begin_step(double dt, std::span<const double> given_loads, BlockLoop loop) {
    if (!(dt > 0) || !std::isfinite(dt))
        throw std::invalid_argument("solid: the time step must be positive, it is " + std::to_string(dt));
    take_loads(given_loads);
    old_u = u;
    old_v = v;
    old_a = a;
    old_bodies = bodies.motions();
    old_time = time;
    load_factor = 1;
    if (accelerations_known) {
        bodies.gather(inertia, body_inertia);
        bodies.add_own_inertia(body_inertia);
        keep_forces();
    } else {
        find_initial_accelerations(dt, loop);
    }
    open_account(loop);
    bodies.keep_start();
    time += dt;
    for (GroundContact<D>& contact : contacts) contact.place_ground({}, time, 1);
}

// Undoes begin_step and whatever followed.
template <int D>
void Solver<D>::Implementation::abandon_step() {
    time = old_time;
    u = old_u;
    v = old_v;
    a = old_a;
    bodies.set_motions(old_bodies);
    keep_forces();
    std::swap(previous_loads, loads);
    if (!accelerations_known) {
        std::fill(a.begin(), a.end(), 0.0);
        bodies.forget_accelerations();
    }
    multiply_mass(a, inertia, serial_loop);
    factor = {};
}

template <int D>
void Solver<D>::Implementation::accept_step(BlockLoop loop) {
    close_account(loop);
    for (GroundContact<D>& contact : contacts) contact.accept();
    accelerations_known = true;
    update_positions();
    ++statistics.steps;
    ++stable_step_age;
}

template <int D>
void Solver<D>::Implementation::advance(double dt, std::span<const double> given_loads, BlockLoop loop) {
    begin_step(dt, given_loads, loop);
    const NewtonResult result = is_explicit() ? step_explicitly(dt, loop) : step_implicitly(dt, loop);
    if (!result.converged()) {
        abandon_step();
        std::ostringstream text;
        text << "solid: " << (is_explicit() ? "the explicit scheme" : "Newton") << " failed in step "
             << statistics.steps + 1 << " of size " << dt << " s: " << result.description()
             << ". Reduce the time step of the solid (or the ratio p); if it fails at any step, look at the loads, the "
                "clamps and the mesh";
        throw ConvergenceError(text.str());
    }
    accept_step(loop);
    statistics.last_iterations = result.iterations;
    statistics.last_residual = result.reference > 0 ? result.last_residual / result.reference : 0;
}

template <int D>
void Solver<D>::Implementation::multiply_mass(std::span<const double> x, std::span<double> y, BlockLoop loop) const {
    if (!is_explicit()) return assembly.multiply_mass(x, y, loop);
    for (std::size_t f = 0; f < x.size(); ++f) y[f] = assembly.lumped_masses()[f / D] * x[f];
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
