// The equation of motion over the unknowns: its forces and its residual. Rigid bodies take part with the generalised
// forces of their nodes (rigid_bodies.hpp).
#include <algorithm>
#include <cmath>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

template <int D>
double Solver<D>::Implementation::evaluate_forces(BlockLoop loop, Motion motion) {
    const std::vector<double>& gravity = assembly.gravity_forces();
    for (std::size_t f = 0; f < u.size(); ++f) external[f] = loads[f] + gravity[f];
    surface_loads.add_forces(time, u, external, loop);
    const double smallest_J = assembly.internal_forces(u, internal, loop);
    add_contact_forces(loop);
    if (is_damped() && motion == Motion::moving) add_damping(loop);
    gather_body_forces();
    return smallest_J;
}

// To the internal forces. Their size counts among the forces that residuals are compared with: a body between a clamp
// and the ground, at rest, has no other at its free nodes.
template <int D>
void Solver<D>::Implementation::add_contact_forces(BlockLoop loop) {
    contact_size2 = 0;
    if (contacts.empty()) return;
    std::fill(contact_forces.begin(), contact_forces.end(), 0.0);
    for (GroundContact<D>& contact : contacts) contact.add_forces(1, u, contact_forces, loop);
    for (std::size_t f = 0; f < u.size(); ++f) {
        internal[f] -= contact_forces[f];
        contact_size2 += contact_forces[f] * contact_forces[f];
    }
}

// F_d = α M v + ∫ F S_d · ∇N dV; bodies' own masses are not damped.
template <int D>
void Solver<D>::Implementation::add_damping(BlockLoop loop) {
    if (assembly.is_viscous())
        assembly.viscous_forces(u, v, damping, loop);
    else
        std::fill(damping.begin(), damping.end(), 0.0);
    if (options.mass_damping > 0) {
        multiply_mass(v, momentum, loop);
        for (std::size_t f = 0; f < u.size(); ++f) damping[f] += options.mass_damping * momentum[f];
    }
    for (std::size_t f = 0; f < u.size(); ++f) internal[f] += damping[f];
}

template <int D>
void Solver<D>::Implementation::gather_body_forces() {
    if (bodies.empty()) return;
    bodies.gather(external, body_external);
    bodies.add_gravity(options.gravity, body_external);
    bodies.loads(time, body_loads);
    for (std::size_t k = 0; k < body_loads.size(); ++k) body_external[k] += body_loads[k];
    bodies.gather(internal, body_internal);
}

// r = w_1 (F_ext_n+1 - F_int_n+1) + w_0 (F_ext_n - F_int_n) - M a
template <int D>
Magnitudes Solver<D>::Implementation::dynamic_residual(BlockLoop loop) {
    multiply_mass(a, inertia, loop);
    Magnitudes of;
    const std::size_t equations = assembly.equations();
    for (std::size_t e = 0; e < equations; ++e) {
        const std::size_t f = assembly.freedoms()[e];
        residual[e] = newmark.weight_new * (external[f] - internal[f]) +
                      newmark.weight_old * (previous_external[f] - previous_internal[f]) - inertia[f];
        of.residual += residual[e] * residual[e];
        of.external += external[f] * external[f];
        of.internal += internal[f] * internal[f];
        of.inertia += inertia[f] * inertia[f];
        of.step += (u[f] - old_u[f]) * (u[f] - old_u[f]);
    }
    of.internal += contact_size2;
    for (const std::size_t f : motions.freedoms()) {
        of.internal += internal[f] * internal[f];
        of.inertia += inertia[f] * inertia[f];
    }
    if (bodies.empty()) return of;
    bodies.gather(inertia, body_inertia);
    bodies.add_own_inertia(body_inertia);
    for (std::size_t k = 0; k < bodies.coordinates(); ++k) {
        of.external += body_external[k] * body_external[k];
        of.internal += body_internal[k] * body_internal[k];
        of.inertia += body_inertia[k] * body_inertia[k];
    }
    for (std::size_t n = 0; n < bodies.unknowns().size(); ++n) {
        const std::size_t k = bodies.unknowns()[n];
        double& r = residual[equations + n];
        r = newmark.weight_new * (body_external[k] - body_internal[k]) +
            newmark.weight_old * (body_previous_external[k] - body_previous_internal[k]) - body_inertia[k];
        of.residual += r * r;
    }
    return of;
}

// r = F_ext - F_int; the loads are those that hold the start, less and less, and the wanted ones, more and more.
template <int D>
Magnitudes Solver<D>::Implementation::static_residual() {
    Magnitudes of;
    const std::size_t equations = assembly.equations();
    const auto between = [this](double start, double target) {
        return load_factor == 1 ? target : start + load_factor * (target - start);
    };
    for (std::size_t f = 0; f < u.size(); ++f) external[f] = between(static_start[f], external[f]);
    for (std::size_t e = 0; e < equations; ++e) {
        const std::size_t f = assembly.freedoms()[e];
        residual[e] = external[f] - internal[f];
        of.residual += residual[e] * residual[e];
        of.external += external[f] * external[f];
        of.internal += internal[f] * internal[f];
    }
    of.internal += contact_size2;
    for (const std::size_t f : motions.freedoms()) of.internal += internal[f] * internal[f];
    for (std::size_t k = 0; k < bodies.coordinates(); ++k) {
        body_external[k] = between(body_static_start[k], body_external[k]);
        of.external += body_external[k] * body_external[k];
        of.internal += body_internal[k] * body_internal[k];
    }
    for (std::size_t n = 0; n < bodies.unknowns().size(); ++n) {
        double& r = residual[equations + n];
        r = body_external[bodies.unknowns()[n]] - body_internal[bodies.unknowns()[n]];
        of.residual += r * r;
    }
    return of;
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
