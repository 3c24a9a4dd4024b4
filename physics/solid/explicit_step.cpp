// Central differences with lumped masses (thesis (3.47)-(3.49); Newmark with β = 0, γ = 1/2):
//   u_n+1 = u_n + Δt (v_n + Δt/2 a_n),   M_L a_n+1 = F_ext_n+1 - F_int(u_n+1),   v_n+1 = v_n + Δt/2 (a_n + a_n+1)
// stable for Δt <= 2/ω_max (√(1 + ψ²) - ψ), ψ the part of critical damping at ω_max. Damping takes the velocity of
// mid-step. Bodies add Tᵀ M_L T and their own masses, a small matrix.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

template <int D>
bool Solver<D>::Implementation::solve_lumped(BlockLoop) {
    const std::size_t equations = assembly.equations(), unknowns = bodies.unknowns().size();
    for (std::size_t e = 0; e < equations; ++e)
        correction[e] = residual[e] / assembly.lumped_masses()[assembly.freedoms()[e] / D];
    if (unknowns == 0) return true;
    for (std::size_t n = 0; n < unknowns; ++n) {
        std::fill(column_product.begin(), column_product.end(), 0.0);
        bodies.column(n, bodies.motions(), column_product);
        for (std::size_t f = 0; f < u.size(); ++f) column_product[f] *= assembly.lumped_masses()[f / D];
        for (std::size_t m = 0; m < unknowns; ++m) {
            std::fill(column.begin(), column.end(), 0.0);
            bodies.column(m, bodies.motions(), column);
            double& entry = lumped_border.corner(m, n);
            entry = bodies.own_mass(m, n, bodies.motions());
            for (std::size_t f = 0; f < column.size(); ++f) entry += column[f] * column_product[f];
        }
    }
    const auto nothing = [](std::span<const double>, std::span<double>) { return true; };
    const auto body_residual = std::span<const double>(residual).subspan(equations);
    return lumped_border.condense(nothing) &&
           lumped_border.solve(body_residual, std::span(correction).subspan(equations), nothing);
}

template <int D>
NewtonResult Solver<D>::Implementation::step_explicitly(double dt, BlockLoop loop) {
    NewtonResult result;
    using Outcome = NewtonResult::Outcome;
    for (const std::size_t f : assembly.freedoms()) {
        u[f] = old_u[f] + dt * (old_v[f] + 0.5 * dt * old_a[f]);
        v[f] = old_v[f] + 0.5 * dt * old_a[f];  // of mid-step, for damping
        a[f] = 0;
    }
    motions.place(time, u, v, a);
    bodies.begin_step(time, dt, newmark, false);
    bodies.place(u, v, a);
    const double smallest_J = evaluate_forces(loop);
    const Magnitudes of = dynamic_residual(loop);
    result.first_residual = result.last_residual = std::sqrt(of.residual);
    result.reference = of.reference();
    if (!std::isfinite(of.residual)) return result.outcome = Outcome::not_finite, result;
    if (!(smallest_J > 0)) return result.outcome = Outcome::inside_out, result;
    if (!solve_lumped(loop)) return result.outcome = Outcome::not_positive_definite, result;
    for (std::size_t e = 0; e < assembly.equations(); ++e) a[assembly.freedoms()[e]] = correction[e];
    bodies.correct(std::span<const double>(correction).subspan(assembly.equations()));
    bodies.place(u, v, a);
    for (const std::size_t f : assembly.freedoms()) v[f] = old_v[f] + 0.5 * dt * (old_a[f] + a[f]);
    result.last_residual = std::sqrt(dynamic_residual(loop).residual);
    return result;
}

// ω_max by the power method on M_L⁻¹ K about the present state, every contact taken as closed and sticking. Nodes of
// rigid bodies are taken as free: to join them can only lower the frequency. The method approaches from below, hence
// the factor of safety, which also covers what the step adds to the stiffness.
// A body that stiffens as it deforms bears shorter steps than at first: every hundred steps the method goes on from the
// mode that it had come to, a few iterations. What it then finds within 2 % of what it had is left alone.
template <int D>
double Solver<D>::Implementation::largest_stable_step() {
    constexpr int renewal = 100;
    constexpr double unchanged = 0.02;
    if (stable_step > 0 && stable_step_age < renewal) return stable_step;
    const bool again = stable_step > 0;
    stable_step_age = 0;
    const double found = find_stable_step(again);
    if (!again || std::abs(found - stable_step) > unchanged * stable_step) stable_step = found;
    return stable_step;
}

template <int D>
double Solver<D>::Implementation::find_stable_step(bool again) {
    constexpr double safety = 0.9;
    constexpr int most_iterations = 300;
    const int fewest_iterations = again ? 3 : 20;
    const double settled = again ? 1e-5 : 1e-8;  // change of ω² in an iteration
    linearise_here();
    factor = {};
    add_surface_tangents(serial_loop);
    std::span<double> matrices = assembly.facet_matrices().subspan(surface_loads.matrix_size());
    for (const GroundContact<D>& contact : contacts) {
        contact.largest_tangents(matrices);
        matrices = matrices.subspan(contact.matrix_size());
    }
    assembly.system_matrix(u, 1, 0, cholesky.values(), serial_loop);
    Options<D> held = options;
    held.rigid_bodies.clear();
    const std::vector<bool> is_held = held_freedoms(mesh, held);
    std::vector<double>& x = stiffest_mode;
    std::vector<double> Kx(u.size());
    x.resize(u.size());
    // Of another place that has become stiffer, the old mode need not hold anything.
    const double kept = again ? 10 : 0;
    for (std::size_t f = 0; f < x.size(); ++f)
        x[f] = is_held[f] ? 0 : kept * x[f] + (f % 2 == 0 ? 1.0 : -1.0) + 0.1 * double(f % 7);
    double omega_squared = 0;
    for (int k = 0; k < most_iterations; ++k) {
        assembly.multiply_stiffness(x, Kx, serial_loop);
        double xKx = 0, xMx = 0, size = 0;
        for (std::size_t f = 0; f < x.size(); ++f) {
            const double mass = assembly.lumped_masses()[f / D];
            xKx += x[f] * Kx[f];
            xMx += mass * x[f] * x[f];
            x[f] = is_held[f] ? 0 : Kx[f] / mass;
            size = std::max(size, std::abs(x[f]));
        }
        if (!(size > 0)) return std::numeric_limits<double>::infinity();
        for (double& value : x) value /= size;
        const double before = omega_squared;
        omega_squared = xKx / xMx;
        if (k > fewest_iterations && std::abs(omega_squared - before) < settled * omega_squared) break;
    }
    const double omega = std::sqrt(omega_squared),
                 psi = 0.5 * (options.mass_damping / omega + options.stiffness_damping * omega);
    return safety * 2 / omega * (std::sqrt(1 + psi * psi) - psi);
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
