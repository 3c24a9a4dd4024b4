// What the next step depends on, out of a solver and into one.
#include <stdexcept>
#include <utility>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {

void require(bool holds, const std::string& message) {
    if (!holds) throw std::invalid_argument("solid: " + message);
}

// Of each body: coordinates, velocities, accelerations, rotation matrix by rows.
template <int D>
void write(const std::vector<typename RigidBodies<D>::Motion>& motions, std::vector<double>& flat) {
    flat.clear();
    for (const auto& motion : motions) {
        for (const auto* part : {&motion.q, &motion.velocity, &motion.acceleration})
            flat.insert(flat.end(), part->begin(), part->end());
        for (Eigen::Index i = 0; i < D; ++i)
            for (Eigen::Index j = 0; j < D; ++j) flat.push_back(motion.rotation(i, j));
    }
}

template <int D>
void read(const std::vector<double>& flat, std::vector<typename RigidBodies<D>::Motion>& motions) {
    require(flat.size() == motions.size() * (3 * rigid_freedoms<D> + D * D),
            "the saved state has another number of rigid bodies");
    auto from = flat.begin();
    for (auto& motion : motions) {
        for (auto* part : {&motion.q, &motion.velocity, &motion.acceleration})
            for (double& value : *part) value = *from++;
        for (Eigen::Index i = 0; i < D; ++i)
            for (Eigen::Index j = 0; j < D; ++j) motion.rotation(i, j) = *from++;
    }
}

template <int D>
void write(const ContactHistory<D>& history, std::vector<double>& flat) {
    flat.insert(flat.end(), history.shift.begin(), history.shift.end());
    flat.insert(flat.end(), history.tractions.begin(), history.tractions.end());
    flat.insert(flat.end(), history.positions.begin(), history.positions.end());
}

template <int D>
void read(std::vector<double>::const_iterator& from, ContactHistory<D>& history) {
    for (double& x : history.shift) x = *from++;
    for (double& x : history.tractions) x = *from++;
    for (double& x : history.positions) x = *from++;
}

}  // namespace

template <int D>
void Solver<D>::save(State& state) const {
    const Implementation& self = *implementation_;
    state.time = self.time;
    state.displacements = self.u;
    state.velocities = self.v;
    state.accelerations = self.a;
    state.external_forces = self.external;
    state.internal_forces = self.internal;
    state.loads = self.loads;
    write<D>(self.bodies.motions(), state.rigid_bodies);
    state.contacts.clear();
    for (const GroundContact<D>& contact : self.contacts) {
        write<D>(contact.history(), state.contacts);
        state.contacts.insert(state.contacts.end(), {contact.friction_dissipation(), contact.ground_work()});
    }
    state.accelerations_known = self.accelerations_known;
    state.external_work = self.account.external_work;
    state.load_work = self.account.load_work;
    state.numerical_dissipation = self.account.numerical;
    state.damping_forces = self.damping;
    state.damping_dissipation = self.account.damping;
    state.stable_step = self.stable_step;
    state.stable_step_age = self.stable_step_age;
    state.stiffest_mode = self.stiffest_mode;
    state.statistics = self.statistics;
    state.factor_valid = self.factor.valid;
    state.by_gradients = self.by_gradients;
    state.factor_time_step = self.factor.time_step;
    state.factor_steps = self.factor.steps;
    state.factor_iterations_when_new = self.factor.iterations_when_new;
    state.factor_excess = self.factor.excess;
    state.factor_displacements.clear();
    state.factor_rigid_bodies.clear();
    state.factor_contacts.clear();
    state.factor_time = 0;
    if (!self.factor.valid) return;
    state.factor_displacements = self.linearised.u;
    write<D>(self.linearised.bodies, state.factor_rigid_bodies);
    state.factor_time = self.linearised.time;
    for (std::size_t k = 0; k < self.linearised.contacts.size(); ++k) {
        write<D>(self.linearised.contacts[k], state.factor_contacts);
        const auto& shift = self.linearised.ground_shifts[k];
        state.factor_contacts.insert(state.factor_contacts.end(), shift.begin(), shift.end());
    }
}

template <int D>
void Solver<D>::restore(const State& state) {
    Implementation& self = *implementation_;
    for (const auto* field : {&state.displacements, &state.velocities, &state.accelerations, &state.external_forces,
                              &state.internal_forces, &state.loads})
        require(field->size() == self.u.size(), "the saved state has " + std::to_string(field->size()) +
                                                    " components, this mesh has " + std::to_string(self.u.size()));
    require(state.damping_forces.size() == self.damping.size(), "the saved state has another damping");
    auto motions = self.bodies.motions();
    read<D>(state.rigid_bodies, motions);
    std::vector<ContactHistory<D>> histories;
    self.keep_histories(histories);  // for their sizes
    std::size_t numbers = 2 * histories.size();
    for (const auto& history : histories) numbers += D + history.tractions.size() + history.positions.size();
    require(state.contacts.size() == numbers, "the saved state has other contacts");
    self.bodies.set_motions(motions);
    auto from = state.contacts.begin();
    for (std::size_t k = 0; k < histories.size(); ++k) {
        read<D>(from, histories[k]);
        self.contacts[k].set_history(histories[k], state.displacements);
        self.contacts[k].reset_energies(from[0], from[1]);
        from += 2;
    }
    self.time = state.time;
    self.u = state.displacements;
    self.v = state.velocities;
    self.a = state.accelerations;
    self.external = state.external_forces;
    self.internal = state.internal_forces;
    self.loads = state.loads;
    self.multiply_mass(self.a, self.inertia, serial_loop);
    self.gather_body_forces();
    self.accelerations_known = state.accelerations_known;
    self.account.external_work = state.external_work;
    self.account.load_work = state.load_work;
    self.account.numerical = state.numerical_dissipation;
    self.damping = state.damping_forces;
    self.account.damping = state.damping_dissipation;
    self.stable_step = state.stable_step;
    self.stable_step_age = state.stable_step_age;
    self.stiffest_mode = state.stiffest_mode;
    self.restore_factor(state);
    self.statistics = state.statistics;
    self.update_positions();
}

template <int D>
void Solver<D>::Implementation::restore_factor(const State& state) {
    if (!state.factor_valid) {
        factor = {};
        return;
    }
    require(state.factor_displacements.size() == u.size(), "the saved factorisation is of another number of nodes");
    Linearisation saved{state.factor_displacements, bodies.motions(), state.factor_time, {}, {}};
    read<D>(state.factor_rigid_bodies, saved.bodies);
    keep_histories(saved.contacts);
    auto from = state.factor_contacts.begin();
    for (ContactHistory<D>& history : saved.contacts) {
        read<D>(from, history);
        for (double& x : saved.ground_shifts.emplace_back()) x = *from++;
    }
    const bool in_use = factor.valid && factor.time_step == state.factor_time_step && linearised == saved;
    if (!in_use) {
        linearised = std::move(saved);
        factorise_dynamic(state.factor_time_step, serial_loop);
    }
    if (by_gradients && !state.by_gradients) cholesky.factorise();  // gradients had failed on this matrix
    by_gradients = state.by_gradients;
    factor = {factor.valid, state.factor_time_step, state.factor_steps, state.factor_iterations_when_new,
              state.factor_excess};
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;
template void Solver<2>::save(State&) const;
template void Solver<3>::save(State&) const;
template void Solver<2>::restore(const State&);
template void Solver<3>::restore(const State&);

}  // namespace aquagraph::solid
