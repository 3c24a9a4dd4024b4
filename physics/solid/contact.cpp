#include "physics/solid/contact.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

#include "physics/solid/elements/dispatch.hpp"

namespace aquagraph::solid {

namespace {

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
    return sum;
}

// v - n (n·v)
template <std::size_t N>
std::array<double, N> tangential(std::array<double, N> v, const std::array<double, N>& n) {
    const double along = dot(v, n);
    for (std::size_t i = 0; i < N; ++i) v[i] -= along * n[i];
    return v;
}

template <int D>
double volume(const Mesh<D>& mesh, const Element& element, double thickness) {
    double sum = 0;
    with_element_type<D>(element.size(), [&]<class Type>(Type) {
        const auto X = coordinates<Type>(mesh, element);
        for (const auto& point : Type::mass_rule())
            sum += point.weight * reference_gradients(Type::shape(point.xi), X).jacobian;
    });
    return sum * (D == 2 ? thickness : 1);
}

// The element behind each facet of a surface.
template <int D>
std::vector<ElementIndex> owners(const Mesh<D>& mesh, const SurfaceFacets<D>& facets) {
    const auto key = [](const Facet& facet) {
        std::vector<NodeIndex> nodes(facet.begin(), facet.end());
        std::sort(nodes.begin(), nodes.end());
        return nodes;
    };
    std::vector<ElementIndex> owner, found;
    std::map<std::vector<NodeIndex>, ElementIndex> of;
    const auto boundary = boundary_facets(mesh, &owner);
    for (std::size_t k = 0; k < boundary.size(); ++k) of[key(boundary[k])] = owner[k];
    for (std::size_t k = 0; k < facets.count(); ++k) found.push_back(of.at(key(facets[k])));
    return found;
}

constexpr double softer_along = 0.1;  // penalty along the ground, of that across

}  // namespace

double small_strain_modulus(const Material& material) {
    if (material.law == MaterialLaw::mooney_rivlin) return 6 * (material.c10 + material.c01);
    if (material.law != MaterialLaw::uniaxial_curve) return material.youngs_modulus;
    double best = 0, modulus = 0;  // the row with the least strain that is not zero
    for (const auto& [strain, stress] : material.curve)
        if (strain != 0 && (best == 0 || std::abs(strain) < best)) {
            best = std::abs(strain);
            modulus = stress / strain;
        }
    return modulus;
}

template <int D>
GroundContact<D>::GroundContact(const Mesh<D>& mesh, const Options<D>& options, const Contact<D>& contact)
    : facets_(mesh, contact.surface, options.thickness), ground_(contact.ground), friction_(contact.friction) {
    if (!(friction_ >= 0) || !std::isfinite(friction_))
        throw std::invalid_argument("solid: the friction of a contact must not be negative");
    if (contact.penalty && !(*contact.penalty > 0))
        throw std::invalid_argument("solid: the penalty of a contact must be positive");
    std::vector<const Material*> material_of(mesh.elements.size(), &options.material);
    for (const auto& part : options.parts)
        for (const ElementIndex e : mesh.element_set(part.set)) material_of[std::size_t(e)] = &part.material;
    const std::vector<ElementIndex> owner = owners(mesh, facets_);
    for (std::size_t k = 0; k < facets_.count(); ++k) {
        double facet_area = 0;
        for (const FacetPoint& point : facets_.rule(k)) {
            const Vector normal = facets_.area_normal(point, facets_.reference(k));
            areas_.push_back(point.weight * std::sqrt(dot(normal, normal)));
            facet_area += areas_.back();
            positions_.push_back(SurfaceFacets<D>::interpolate(point, facets_.reference(k)));
        }
        constexpr double stiffer_than_element = 10;
        const Element& element = mesh.elements[std::size_t(owner[k])];
        const double modulus = small_strain_modulus(*material_of[std::size_t(owner[k])]),
                     height = volume(mesh, element, options.thickness) / facet_area;
        penalties_.resize(areas_.size(), contact.penalty.value_or(stiffer_than_element * modulus / height));
    }
    states_.resize(facets_.points());
    old_states_ = states_;
    shift_ = ground_.displacement(0);
    accept();
    reset_energies(0, 0);
}

template <int D>
void GroundContact<D>::place_ground(const Vector& start, double t, double part) {
    const Vector target = ground_.displacement(t);
    for (std::size_t i = 0; i < D; ++i) shift_[i] = part == 1 ? target[i] : start[i] + part * (target[i] - start[i]);
}

template <int D>
typename GroundContact<D>::State GroundContact<D>::state_at(std::size_t point, const Vector& x, const Vector& shift,
                                                            const ContactHistory<D>& history) const {
    State state;
    state.place = ground_.at(x, shift);
    if (!(state.place.gap < 0)) return state;
    state.pressure = -penalties_[point] * state.place.gap;
    if (friction_ == 0) return state;
    for (std::size_t i = 0; i < D; ++i)
        state.trial[i] =
            history.tractions[D * point + i] -
            softer_along * penalties_[point] * (x[i] - history.positions[D * point + i] - shift[i] + history.shift[i]);
    state.traction = state.trial = tangential(state.trial, state.place.normal);
    const double size = std::sqrt(dot(state.trial, state.trial)), most = friction_ * state.pressure;
    state.slips = size > most;
    if (state.slips)
        for (double& t : state.traction) t *= most / size;
    return state;
}

template <int D>
void GroundContact<D>::add_forces(double factor, std::span<const double> u, std::span<double> nodal, BlockLoop loop) {
    facets_.for_each(loop, [&](std::size_t k) {
        const auto x = facets_.positions(k, u);
        auto& f = facets_.forces(k);
        f = {};
        std::size_t g = facets_.first_point(k);
        for (const FacetPoint& point : facets_.rule(k)) {
            positions_[g] = SurfaceFacets<D>::interpolate(point, x);
            const State& state = states_[g] = state_at(g, positions_[g], shift_, history_);
            if (state.pressure > 0)
                for (std::size_t a = 0; a < facets_[k].size(); ++a)
                    for (std::size_t i = 0; i < D; ++i)
                        f[a][i] +=
                            areas_[g] * point.N[a] * (state.pressure * state.place.normal[i] + state.traction[i]);
            ++g;
        }
    });
    facets_.add_forces(factor, nodal);
}

// -∂f/∂x = ε n⊗n - p ∂n/∂x, and of friction ε P while it sticks, µ p ε/|trial| (P - τ⊗τ) where it slips, P = I - n⊗n.
template <int D>
void GroundContact<D>::tangents(const Vector& shift, std::span<const double> u, const ContactHistory<D>& history,
                                std::span<double> matrices, BlockLoop loop) const {
    std::fill_n(matrices.begin(), matrix_size(), 0.0);
    facets_.for_each(loop, [&](std::size_t k) {
        const auto x = facets_.positions(k, u);
        std::size_t g = facets_.first_point(k);
        for (const FacetPoint& point : facets_.rule(k)) {
            const State state = state_at(g, SurfaceFacets<D>::interpolate(point, x), shift, history);
            const double epsilon = penalties_[g], epsilon_along = softer_along * epsilon, area = areas_[g];
            ++g;
            if (!(state.pressure > 0)) continue;
            const Vector& n = state.place.normal;
            const double size = std::sqrt(dot(state.trial, state.trial));
            double A[D][D];
            for (std::size_t i = 0; i < D; ++i)
                for (std::size_t j = 0; j < D; ++j) {
                    A[i][j] = epsilon * n[i] * n[j] - state.pressure * ground_.normal_slope(state.place, i, j);
                    if (friction_ == 0) continue;
                    const double P = (i == j ? 1 : 0) - n[i] * n[j];
                    A[i][j] += state.slips ? friction_ * state.pressure * epsilon_along / size *
                                                 (P - state.trial[i] * state.trial[j] / (size * size))
                                           : epsilon_along * P;
                }
            add_tangent(k, point, area, A, matrices);
        }
    });
}

template <int D>
void GroundContact<D>::add_tangent(std::size_t facet, const FacetPoint& point, double area, const double (&A)[D][D],
                                   std::span<double> matrices) const {
    double* K = &matrices[facets_.first_matrix(facet)];
    for (std::size_t r = 0; r < D * facets_[facet].size(); ++r)
        for (std::size_t c = 0; c <= r; ++c, ++K) *K += area * point.N[r / D] * point.N[c / D] * A[r % D][c % D];
}

template <int D>
void GroundContact<D>::largest_tangents(std::span<double> matrices) const {
    std::fill_n(matrices.begin(), matrix_size(), 0.0);
    std::size_t g = 0;
    for (std::size_t k = 0; k < facets_.count(); ++k)
        for (const FacetPoint& point : facets_.rule(k)) {
            double A[D][D] = {};
            for (std::size_t i = 0; i < D; ++i) A[i][i] = penalties_[g];
            add_tangent(k, point, areas_[g++], A, matrices);
        }
}

// Works are trapezoidal, as everywhere: the ground's on its way, and that of friction over the slip, of which the part
// that is stored in the springs is not lost.
template <int D>
void GroundContact<D>::accept() {
    for (std::size_t g = 0; g < states_.size(); ++g) {
        const State &now = states_[g], &old = old_states_[g];
        if (!(now.pressure > 0) && !(old.pressure > 0)) continue;
        double ground = 0, slip_work = 0, stored = 0;
        for (std::size_t i = 0; i < D; ++i) {
            const double travel = shift_[i] - history_.shift[i];
            ground += 0.5 * travel *
                      (now.pressure * now.place.normal[i] + now.traction[i] + old.pressure * old.place.normal[i] +
                       old.traction[i]);
            if (friction_ == 0) continue;
            const double slip = positions_[g][i] - history_.positions[D * g + i] - travel;
            slip_work -= 0.5 * (now.traction[i] + old.traction[i]) * slip;
            stored += (now.traction[i] * now.traction[i] - old.traction[i] * old.traction[i]) /
                      (2 * softer_along * penalties_[g]);
        }
        ground_work_ += areas_[g] * ground;
        friction_dissipation_ += areas_[g] * (slip_work - stored);
    }
    history_.shift = shift_;
    old_states_ = states_;
    if (friction_ == 0) return;
    history_.tractions.resize(D * states_.size());
    history_.positions.resize(D * states_.size());
    for (std::size_t g = 0; g < states_.size(); ++g)
        for (std::size_t i = 0; i < D; ++i) {
            history_.tractions[D * g + i] = states_[g].traction[i];
            history_.positions[D * g + i] = positions_[g][i];
        }
}

template <int D>
void GroundContact<D>::set_history(const ContactHistory<D>& history, std::span<const double> u) {
    history_ = history;
    shift_ = history.shift;
    for (std::size_t k = 0; k < facets_.count(); ++k) {
        const auto x = facets_.positions(k, u);
        std::size_t g = facets_.first_point(k);
        for (const FacetPoint& point : facets_.rule(k)) {
            positions_[g] = SurfaceFacets<D>::interpolate(point, x);
            State& state = states_[g] = {};
            state.place = ground_.at(positions_[g], shift_);
            if (state.place.gap < 0) {
                state.pressure = -penalties_[g] * state.place.gap;
                if (friction_ > 0) std::copy_n(&history.tractions[D * g], D, state.traction.begin());
            }
            ++g;
        }
    }
    old_states_ = states_;
}

template <int D>
double GroundContact<D>::stored() const {
    double sum = 0;
    for (std::size_t g = 0; g < states_.size(); ++g)
        sum += areas_[g] / (2 * penalties_[g]) *
               (old_states_[g].pressure * old_states_[g].pressure +
                dot(old_states_[g].traction, old_states_[g].traction) / softer_along);
    return sum;
}

template <int D>
void GroundContact<D>::reset_energies(double friction_dissipation, double ground_work) {
    friction_dissipation_ = friction_dissipation;
    ground_work_ = ground_work;
}

template <int D>
ContactReport<D> GroundContact<D>::report(std::span<const double> u) const {
    ContactReport<D> report;
    for (std::size_t k = 0; k < facets_.count(); ++k) {
        const auto x = facets_.positions(k, u);
        std::size_t g = facets_.first_point(k);
        for (const FacetPoint& point : facets_.rule(k)) {
            const State& state = old_states_[g];
            const double reference = areas_[g++];
            if (!(state.pressure > 0)) continue;
            const Vector normal = facets_.area_normal(point, x);
            ContactPoint<D>& touching = report.points.emplace_back();
            touching.position = SurfaceFacets<D>::interpolate(point, x);
            touching.area = point.weight * std::sqrt(dot(normal, normal));
            touching.pressure = state.pressure * reference / touching.area;
            report.area += touching.area;
            report.largest_pressure = std::max(report.largest_pressure, touching.pressure);
            for (std::size_t i = 0; i < D; ++i) {
                touching.friction[i] = state.traction[i] * reference / touching.area;
                report.force[i] += reference * (state.pressure * state.place.normal[i] + state.traction[i]);
            }
        }
    }
    return report;
}

template <int D>
void GroundContact<D>::add_nodal_pressure(std::span<const double> u, std::span<double> pressures,
                                          std::span<double> weights) const {
    for (std::size_t k = 0; k < facets_.count(); ++k) {
        const auto x = facets_.positions(k, u);
        std::size_t g = facets_.first_point(k);
        for (const FacetPoint& point : facets_.rule(k)) {
            const double pressure = old_states_[g].pressure, reference = areas_[g++];
            const Vector normal = facets_.area_normal(point, x);
            const double area = point.weight * std::sqrt(dot(normal, normal));
            for (std::size_t a = 0; a < facets_[k].size(); ++a) {
                const auto node = std::size_t(facets_[k][a]);
                pressures[node] += point.N[a] * point.N[a] * pressure * reference;
                weights[node] += point.N[a] * point.N[a] * area;
            }
        }
    }
}

template class GroundContact<2>;
template class GroundContact<3>;

}  // namespace aquagraph::solid
