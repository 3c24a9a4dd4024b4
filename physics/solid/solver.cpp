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
    for (const double rate : {options.mass_damping, options.stiffness_damping})
        require(rate >= 0 && std::isfinite(rate), "damping must not be negative");
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
      motions(mesh, options.motions),
      bodies(mesh, options),
      surface_loads(mesh, options),
      cholesky(assembly.column_starts(), assembly.rows()),
      gradients(assembly.column_starts(), assembly.rows()),
      border(assembly.equations(), bodies.unknowns().size()),
      lumped_border(0, bodies.unknowns().size()) {
    require(assembly.equations() > 0, "the clamps leave nothing free");
    for (auto* field :
         {&u, &v, &a, &positions, &loads, &previous_loads, &internal, &inertia, &external, &previous_external,
          &previous_internal, &old_u, &old_v, &old_a, &predicted_u, &static_start, &momentum})
        field->assign(D * mesh.nodes.size(), 0.0);
    for (auto* field : {&body_external, &body_internal, &body_inertia, &body_previous_external, &body_previous_internal,
                        &body_loads, &body_previous_loads})
        field->assign(bodies.coordinates(), 0.0);
    if (is_damped()) damping.assign(u.size(), 0.0);
    previous_damping = damping;
    if (!bodies.empty()) column.assign(u.size(), 0.0);
    column_product = column;
    residual.assign(assembly.equations() + bodies.unknowns().size(), 0.0);
    correction = residual;
    for (const Contact<D>& contact : options.contacts) contacts.emplace_back(mesh, options, contact);
    if (!contacts.empty()) contact_forces.assign(u.size(), 0.0);
    update_positions();
}

template <int D>
void Solver<D>::Implementation::take_loads(std::span<const double> given) {
    if (given.size() != loads.size())
        throw std::invalid_argument("solid: " + std::to_string(given.size()) + " load components were given, " +
                                    std::to_string(loads.size()) + " are needed (" + std::to_string(D) + " per node)");
    std::swap(previous_loads, loads);
    std::copy(given.begin(), given.end(), loads.begin());
}

template <int D>
double Solver<D>::Implementation::norm(std::span<const double> unknowns) const {
    double sum = 0;
    for (const double x : unknowns) sum += x * x;
    return std::sqrt(sum);
}

// Displacements are stored to rounding, so forces cannot be better than rounding × K_ii |u_i|, some terms together.
template <int D>
double Solver<D>::Implementation::rounding_floor() const {
    constexpr double terms = 4;
    double sum = 0;
    for (std::size_t e = 0; e < assembly.equations(); ++e) {
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
    return implementation_->is_explicit() ? implementation_->largest_stable_step()
                                          : std::numeric_limits<double>::infinity();
}
template <int D>
ContactReport<D> Solver<D>::contact(std::size_t contact) const {
    require(contact < implementation_->contacts.size(), "there is no contact " + std::to_string(contact));
    return implementation_->contacts[contact].report(implementation_->u);
}

template <int D>
void Solver<D>::contact_pressure(std::span<double> nodal) const {
    require(nodal.size() == implementation_->mesh.nodes.size(), "one pressure per node is written");
    std::vector<double> weights(nodal.size(), 0.0);
    std::fill(nodal.begin(), nodal.end(), 0.0);
    for (const GroundContact<D>& contact : implementation_->contacts)
        contact.add_nodal_pressure(implementation_->u, nodal, weights);
    for (std::size_t n = 0; n < nodal.size(); ++n)
        if (weights[n] > 0) nodal[n] /= weights[n];
}

template <int D>
void Solver<D>::set_velocity(const std::array<double, D>& velocity) {
    Implementation& self = *implementation_;
    for (const double v : velocity) require(std::isfinite(v), "the velocity must be finite");
    for (const std::size_t f : self.assembly.freedoms()) self.v[f] = velocity[f % D];
    auto motions = self.bodies.motions();
    for (std::size_t b = 0; b < motions.size(); ++b)
        for (std::size_t i = 0; i < D; ++i)
            if (!self.options.rigid_bodies[b].motion[i]) motions[b].velocity[i] = velocity[i];
    self.bodies.set_motions(motions);
    self.bodies.place(self.u, self.v, self.a);
    self.accelerations_known = false;
}

template <int D>
double Solver<D>::time() const {
    return implementation_->time;
}
template <int D>
void Solver<D>::set_time(double time) {
    require(std::isfinite(time), "the time must be finite");
    implementation_->time = time;
}

template <int D>
std::array<double, D> Solver<D>::reaction(const std::string& set) const {
    const Implementation& self = *implementation_;
    std::array<double, D> sum{};
    for (const NodeIndex node : self.mesh.node_set(set))
        for (std::size_t i = 0; i < D; ++i) {
            const std::size_t f = D * std::size_t(node) + i;
            if (self.assembly.equation_of()[f] < 0) sum[i] += self.inertia[f] + self.internal[f] - self.external[f];
        }
    return sum;
}

template <int D>
RigidBodyState<D> Solver<D>::rigid_body(std::size_t body) const {
    const Implementation& self = *implementation_;
    require(body < self.bodies.motions().size(), "there is no rigid body " + std::to_string(body));
    const std::size_t all = self.bodies.coordinates(), first = body * rigid_freedoms<D>;
    std::vector<double> inertia(all), internal(all), external(all), loads(all);
    self.bodies.gather(self.inertia, inertia);
    self.bodies.add_own_inertia(inertia);
    self.bodies.gather(self.internal, internal);
    self.bodies.gather(self.external, external);
    self.bodies.add_gravity(self.options.gravity, external);
    self.bodies.loads(self.time, loads);
    RigidBodyState<D> state;
    const auto& motion = self.bodies.motion(body);
    for (std::size_t i = 0; i < rigid_freedoms<D>; ++i) {
        const double arm = i < D ? 1 : self.bodies.arm(body);
        state.displacement[i] = motion.q[i] / arm;
        state.velocity[i] = motion.velocity[i] / arm;
        state.acceleration[i] = motion.acceleration[i] / arm;
        if (self.options.rigid_bodies[body].motion[i]) {
            const std::size_t k = first + i;
            state.reaction[i] = arm * (inertia[k] + internal[k] - external[k] - loads[k]);
        }
    }
    return state;
}

template <int D>
Energies Solver<D>::energies() const {
    Implementation& self = *implementation_;
    Energies energies;
    energies.kinetic = self.kinetic_energy(serial_loop);
    for (std::size_t f = 0; f < self.u.size(); ++f)
        energies.gravity_potential -= self.assembly.gravity_forces()[f] * self.u[f];
    energies.gravity_potential += self.bodies.gravity_potential(self.bodies.motions(), self.options.gravity);
    energies.strain = self.assembly.energy(self.u);
    energies.external_work = self.account.external_work;
    energies.load_work = self.account.load_work;
    energies.numerical = self.account.numerical;
    energies.damping = self.account.damping;
    for (const GroundContact<D>& contact : self.contacts) {
        energies.contact += contact.stored();
        energies.friction += contact.friction_dissipation();
        energies.external_work += contact.ground_work();
    }
    return energies;
}

template <int D>
double Solver<D>::work_of_loads() const {
    return implementation_->account.load_work;
}

template <int D>
void Solver<D>::element_stress(std::span<double> von_mises) const {
    require(von_mises.size() == implementation_->mesh.elements.size(), "one stress per element is written");
    implementation_->assembly.von_mises(implementation_->u, von_mises);
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;
template class Solver<2>;
template class Solver<3>;

}  // namespace aquagraph::solid
