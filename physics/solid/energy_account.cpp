// What happens to energy in a step from t_n to t_n+1. Works are trapezoidal, ½ (F_n + F_n+1)·Δu; prescribed motions do
// the work of their reactions R = M a - (F_ext - F_int). What all forces do and kinetic energy does not show is what
// the scheme dissipates; for the schemes here it is
//   Δu·(½ (r_n + r_n+1)) + terms of γ - 1/2 and β - γ/2 times Δa      (Hughes, The Finite Element Method, 9.1)
// with r = F_ext - F_int - M a, zero but for the weights of HHT. The balance
//   kinetic + strain + gravity potential + damping + numerical - external work = constant
// then holds as far as the trapezoidal work of F_int is the change of the strain energy: to third order in a step.
#include <numeric>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {

// Into `reactions`, for the freedoms listed.
void find_reactions(const std::vector<std::size_t>& freedoms, std::span<const double> external,
                    std::span<const double> internal, std::span<const double> inertia, std::vector<double>& reactions) {
    reactions.resize(freedoms.size());
    for (std::size_t k = 0; k < freedoms.size(); ++k) {
        const std::size_t f = freedoms[k];
        reactions[k] = inertia[f] - (external[f] - internal[f]);
    }
}

}  // namespace

template <int D>
double Solver<D>::Implementation::kinetic_energy(BlockLoop loop) {
    multiply_mass(v, momentum, loop);
    return 0.5 * std::inner_product(v.begin(), v.end(), momentum.begin(), 0.0) + bodies.kinetic_energy();
}

template <int D>
void Solver<D>::Implementation::open_account(BlockLoop loop) {
    account.kinetic = kinetic_energy(loop);
    find_reactions(motions.freedoms(), previous_external, previous_internal, inertia, account.reactions);
    find_reactions(bodies.prescribed(), body_previous_external, body_previous_internal, body_inertia,
                   account.body_reactions);
}

template <int D>
void Solver<D>::Implementation::close_account(BlockLoop loop) {
    const std::vector<double>& gravity = assembly.gravity_forces();
    double given_work = 0, external_work = 0, total_work = 0;
    for (std::size_t f = 0; f < u.size(); ++f) {
        const double half_step = 0.5 * (u[f] - old_u[f]), force = external[f] + previous_external[f];
        given_work += (loads[f] + previous_loads[f]) * half_step;
        external_work += (force - 2 * gravity[f]) * half_step;
        total_work += (force - internal[f] - previous_internal[f]) * half_step;
    }
    for (std::size_t k = 0; k < motions.freedoms().size(); ++k) {
        const std::size_t f = motions.freedoms()[k];
        const double work = 0.5 * (account.reactions[k] + inertia[f] - (external[f] - internal[f])) * (u[f] - old_u[f]);
        external_work += work;
        total_work += work;
    }
    for (std::size_t f = 0; f < damping.size(); ++f)
        account.damping += 0.5 * (damping[f] + previous_damping[f]) * (u[f] - old_u[f]);
    const auto step_of = [&](std::size_t k) {
        const std::size_t b = k / rigid_freedoms<D>, i = k % rigid_freedoms<D>;
        return bodies.motion(b).q[i] - old_bodies[b].q[i];
    };
    // The nodes of bodies have been counted above, with their own forces: here are the loads on the bodies themselves.
    if (!bodies.empty()) {
        const double gravity_work = bodies.gravity_potential(old_bodies, options.gravity) -
                                    bodies.gravity_potential(bodies.motions(), options.gravity);
        double work = 0;
        for (std::size_t k = 0; k < bodies.coordinates(); ++k)
            work += 0.5 * (body_loads[k] + body_previous_loads[k]) * step_of(k);
        for (std::size_t n = 0; n < bodies.prescribed().size(); ++n) {
            const std::size_t k = bodies.prescribed()[n];
            const double reaction = body_inertia[k] - (body_external[k] - body_internal[k]);
            work += 0.5 * (account.body_reactions[n] + reaction) * step_of(k);
        }
        external_work += work;
        total_work += work + gravity_work;
    }
    account.load_work += given_work;
    account.external_work += external_work;
    account.numerical += total_work - (kinetic_energy(loop) - account.kinetic);
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
