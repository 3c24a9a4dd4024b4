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

const Options& checked(const Options& options) {
    const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
    require(positive(options.youngs_modulus), "Young's modulus must be positive");
    require(options.poissons_ratio > -1 && options.poissons_ratio < 0.5, "Poisson's ratio must lie in ]-1, 1/2[");
    require(positive(options.density), "the density must be positive");
    require(positive(options.thickness), "the thickness must be positive");
    require(options.alpha > -1.0 / 3 && options.alpha <= 0,
            "alpha must lie in ]-1/3, 0], it is " + std::to_string(options.alpha));
    require(std::isfinite(options.gravity[0]) && std::isfinite(options.gravity[1]), "gravity must be finite");
    require(positive(options.residual_tolerance) && positive(options.increment_tolerance),
            "the tolerances must be positive");
    require(options.max_iterations > 0, "max_iterations must be positive");
    return options;
}

Mesh checked(Mesh mesh) {
    check(mesh);
    return mesh;
}

}  // namespace

Solver::Implementation::Implementation(Mesh given_mesh, const Options& given_options)
    : mesh(checked(std::move(given_mesh))),
      options(checked(given_options)),
      newmark(newmark_coefficients(options.scheme, options.alpha)),
      assembly(mesh, options),
      cholesky(assembly.column_starts(), assembly.rows()) {
    require(assembly.equations() > 0, "the clamps leave nothing free");
    for (auto* field : {&u, &v, &a, &positions, &internal, &inertia, &external, &previous_external, &previous_internal,
                        &old_u, &old_v, &old_a, &predicted_u, &static_start, &static_target})
        field->assign(2 * mesh.nodes.size(), 0.0);
    residual.assign(assembly.equations(), 0.0);
    correction.assign(assembly.equations(), 0.0);
    update_positions();
}

double Solver::Implementation::norm(std::span<const double> equations) const {
    double sum = 0;
    for (const double x : equations) sum += x * x;
    return std::sqrt(sum);
}

double Solver::Implementation::norm_of_free(std::span<const double> full) const {
    double sum = 0;
    for (const std::size_t f : assembly.freedoms()) sum += full[f] * full[f];
    return std::sqrt(sum);
}

// Displacements are stored to rounding, so forces cannot be better than rounding × K_ii |u_i|, some terms together.
double Solver::Implementation::rounding_floor() const {
    constexpr double terms = 4;
    double sum = 0;
    for (std::size_t e = 0; e < residual.size(); ++e) {
        const double force = assembly.stiffness_diagonal()[e] * u[assembly.freedoms()[e]];
        sum += force * force;
    }
    return terms * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
}

void Solver::Implementation::update_positions() {
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        for (std::size_t i = 0; i < 2; ++i) positions[2 * n + i] = mesh.nodes[n][i] + u[2 * n + i];
}

Solver::Solver(Mesh mesh, const Options& options)
    : implementation_(std::make_unique<Implementation>(std::move(mesh), options)) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::solve_static(std::span<const double> external_forces, BlockLoop loop) {
    implementation_->solve_static(external_forces, loop);
}
void Solver::advance(double dt, std::span<const double> external_forces, BlockLoop loop) {
    implementation_->advance(dt, external_forces, loop);
}

const Mesh& Solver::mesh() const {
    return implementation_->mesh;
}
const Options& Solver::options() const {
    return implementation_->options;
}
std::span<const double> Solver::positions() const {
    return implementation_->positions;
}
std::span<const double> Solver::displacements() const {
    return implementation_->u;
}
std::span<const double> Solver::velocities() const {
    return implementation_->v;
}
std::span<const double> Solver::accelerations() const {
    return implementation_->a;
}
Statistics Solver::statistics() const {
    return implementation_->statistics;
}
double Solver::mass() const {
    return implementation_->assembly.mass();
}
double Solver::largest_stable_step() const {
    return std::numeric_limits<double>::infinity();
}

Energies Solver::energies() const {
    const Implementation& self = *implementation_;
    std::vector<double> momentum(self.u.size());
    self.assembly.multiply_mass(self.v, momentum, serial_loop);
    Energies energies;
    for (std::size_t f = 0; f < self.u.size(); ++f) {
        energies.kinetic += 0.5 * self.v[f] * momentum[f];
        energies.gravity_potential -= self.assembly.gravity_forces()[f] * self.u[f];
    }
    energies.strain = self.assembly.elements().energy(self.u);
    energies.external_work = self.external_work;
    return energies;
}

void Solver::element_stress(std::span<double> von_mises) const {
    require(von_mises.size() == implementation_->mesh.elements.size(), "one stress per element is written");
    implementation_->assembly.elements().von_mises(implementation_->u, von_mises);
}

void Solver::save(State& state) {
    Implementation& self = *implementation_;
    self.factor = {};
    state.displacements = self.u;
    state.velocities = self.v;
    state.accelerations = self.a;
    state.external_forces = self.external;
    state.accelerations_known = self.accelerations_known;
    state.external_work = self.external_work;
    state.statistics = self.statistics;
}

void Solver::restore(const State& state) {
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
    self.statistics = state.statistics;
    self.factor = {};
    self.update_positions();
}

}  // namespace aquagraph::solid
