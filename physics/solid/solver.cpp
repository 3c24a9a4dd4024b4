#include "physics/solid/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {

void require(bool holds, const std::string& message) {
    if (!holds) throw std::invalid_argument("solid: " + message);
}

bool positive(double x) {
    return x > 0 && std::isfinite(x);
}

void check(const Material& material) {
    require(positive(material.density), "the density must be positive");
    for (const CordFamily& cords : material.cords)
        require(
            positive(cords.modulus) && positive(cords.section) && positive(cords.spacing) && positive(cords.thickness),
            "modulus, section, spacing and layer thickness of cords must be positive");
    if (material.law == MaterialLaw::mooney_rivlin) {
        require(positive(material.c10 + material.c01), "C10 + C01 must be positive");
        require(positive(material.bulk_modulus), "the bulk modulus must be positive");
        return;
    }
    require(material.law == MaterialLaw::uniaxial_curve || positive(material.youngs_modulus),
            "Young's modulus must be positive");
    require(material.poissons_ratio > -1 && material.poissons_ratio < 0.5, "Poisson's ratio must lie in ]-1, 1/2[");
}

template <int D>
const Options<D>& checked(const Options<D>& options) {
    check(options.material);
    for (const Part& part : options.parts) check(part.material);
    require(positive(options.thickness), "the thickness must be positive");
    require(options.alpha > -1.0 / 3 && options.alpha <= 0,
            "alpha must lie in ]-1/3, 0], it is " + std::to_string(options.alpha));
    for (const double g : options.gravity) require(std::isfinite(g), "gravity must be finite");
    require(positive(options.residual_tolerance) && positive(options.increment_tolerance),
            "the tolerances must be positive");
    require(options.max_iterations > 0, "max_iterations must be positive");
    return options;
}

template <int D>
Mesh<D> checked(Mesh<D> mesh) {
    check(mesh);
    return mesh;
}

}  // namespace

template <int D>
Solver<D>::Implementation::Implementation(Mesh<D> given_mesh, const Options<D>& given_options)
    : mesh(checked(std::move(given_mesh))),
      options(checked(given_options)),
      newmark(newmark_coefficients(options.scheme, options.alpha)),
      assembly(mesh, options),
      cholesky(assembly.column_starts(), assembly.rows()),
      gradients(assembly.column_starts(), assembly.rows()) {
    require(assembly.equations() > 0, "the clamps leave nothing free");
    for (auto* field : {&u, &v, &a, &positions, &internal, &inertia, &external, &previous_external, &previous_internal,
                        &old_u, &old_v, &old_a, &predicted_u, &static_start, &static_target})
        field->assign(D * mesh.nodes.size(), 0.0);
    residual.assign(assembly.equations(), 0.0);
    correction.assign(assembly.equations(), 0.0);
    update_positions();
}

template <int D>
double Solver<D>::Implementation::norm(std::span<const double> equations) const {
    double sum = 0;
    for (const double x : equations) sum += x * x;
    return std::sqrt(sum);
}

template <int D>
double Solver<D>::Implementation::norm_of_free(std::span<const double> full) const {
    double sum = 0;
    for (const std::size_t f : assembly.freedoms()) sum += full[f] * full[f];
    return std::sqrt(sum);
}

// Displacements are stored to rounding, so forces cannot be better than rounding × K_ii |u_i|, some terms together.
template <int D>
double Solver<D>::Implementation::rounding_floor() const {
    constexpr double terms = 4;
    double sum = 0;
    for (std::size_t e = 0; e < residual.size(); ++e) {
        const double force = assembly.stiffness_diagonal()[e] * u[assembly.freedoms()[e]];
        sum += force * force;
    }
    return terms * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

template <int D>
void Solver<D>::Implementation::update_positions() {
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        for (std::size_t i = 0; i < D; ++i) positions[D * n + i] = mesh.nodes[n][i] + u[D * n + i];
}

template <int D>
Solver<D>::Solver(Mesh<D> mesh, const Options<D>& options)
    : implementation_(std::make_unique<Implementation>(std::move(mesh), options)) {}
template <int D>
Solver<D>::~Solver() = default;
template <int D>
Solver<D>::Solver(Solver&&) noexcept = default;
template <int D>
Solver<D>& Solver<D>::operator=(Solver&&) noexcept = default;

template <int D>
void Solver<D>::solve_static(std::span<const double> external_forces, BlockLoop loop) {
    implementation_->solve_static(external_forces, loop);
}
template <int D>
void Solver<D>::advance(double dt, std::span<const double> external_forces, BlockLoop loop) {
    implementation_->advance(dt, external_forces, loop);
}

template <int D>
const Mesh<D>& Solver<D>::mesh() const {
    return implementation_->mesh;
}
template <int D>
const Options<D>& Solver<D>::options() const {
    return implementation_->options;
}
template <int D>
std::span<const double> Solver<D>::positions() const {
    return implementation_->positions;
}
template <int D>
std::span<const double> Solver<D>::displacements() const {
    return implementation_->u;
}
template <int D>
std::span<const double> Solver<D>::velocities() const {
    return implementation_->v;
}
template <int D>
std::span<const double> Solver<D>::accelerations() const {
    return implementation_->a;
}
template <int D>
Statistics Solver<D>::statistics() const {
    return implementation_->statistics;
}
template <int D>
double Solver<D>::mass() const {
    return implementation_->assembly.mass();
}
template <int D>
double Solver<D>::largest_stable_step() const {
    return std::numeric_limits<double>::infinity();
}

template <int D>
Energies Solver<D>::energies() const {
    const Implementation& self = *implementation_;
    std::vector<double> momentum(self.u.size());
    self.assembly.multiply_mass(self.v, momentum, serial_loop);
    Energies energies;
    for (std::size_t f = 0; f < self.u.size(); ++f) {
        energies.kinetic += 0.5 * self.v[f] * momentum[f];
        energies.gravity_potential -= self.assembly.gravity_forces()[f] * self.u[f];
    }
    energies.strain = self.assembly.energy(self.u);
    energies.external_work = self.external_work;
    return energies;
}

template <int D>
void Solver<D>::element_stress(std::span<double> von_mises) const {
    require(von_mises.size() == implementation_->mesh.elements.size(), "one stress per element is written");
    implementation_->assembly.von_mises(implementation_->u, von_mises);
}

template <int D>
void Solver<D>::save(State& state) const {
    const Implementation& self = *implementation_;
    state.displacements = self.u;
    state.velocities = self.v;
    state.accelerations = self.a;
    state.external_forces = self.external;
    state.accelerations_known = self.accelerations_known;
    state.external_work = self.external_work;
    state.statistics = self.statistics;
    state.factor_valid = self.factor.valid;
    state.by_gradients = self.by_gradients;
    state.factor_time_step = self.factor.time_step;
    state.factor_steps = self.factor.steps;
    state.factor_iterations_when_new = self.factor.iterations_when_new;
    state.factor_excess = self.factor.excess;
    state.factor_displacements = self.factored_at;
}

template <int D>
void Solver<D>::restore(const State& state) {
    Implementation& self = *implementation_;
    for (const auto* field : {&state.displacements, &state.velocities, &state.accelerations, &state.external_forces})
        require(field->size() == self.u.size(), "the saved state has " + std::to_string(field->size()) +
                                                    " components, this mesh has " + std::to_string(self.u.size()));
    self.u = state.displacements;
    self.v = state.velocities;
    self.a = state.accelerations;
    self.external = state.external_forces;
    self.assembly.internal_forces(self.u, self.internal, serial_loop);  // the same bits as when u was accepted
    self.accelerations_known = state.accelerations_known;
    self.external_work = state.external_work;
    if (state.factor_valid) {
        require(state.factor_displacements.size() == self.u.size(),
                "the saved factorisation is of another number of nodes");
        const bool in_use = self.factor.valid && self.factor.time_step == state.factor_time_step &&
                            self.factored_at == state.factor_displacements;
        if (!in_use) self.factorise_dynamic(state.factor_displacements, state.factor_time_step, serial_loop);
        if (self.by_gradients && !state.by_gradients) self.cholesky.factorise();  // gradients had failed on this matrix
        self.by_gradients = state.by_gradients;
        self.factor = {self.factor.valid, state.factor_time_step, state.factor_steps, state.factor_iterations_when_new,
                       state.factor_excess};
    } else {
        self.factor = {};
    }
    self.statistics = state.statistics;
    self.update_positions();
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;
template class Solver<2>;
template class Solver<3>;

}  // namespace aquagraph::solid
