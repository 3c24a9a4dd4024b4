#include "physics/solid/dead_loads.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/solid/elements/facets.hpp"

namespace aquagraph::solid {

namespace {

// |∂X/∂ξ| of an edge, |∂X/∂ξ × ∂X/∂η| of a face.
template <int D, std::size_t Nodes>
double area_element(const Mesh<D>& mesh, const Facet& facet, const Shape<D - 1, Nodes>& s) {
    std::array<std::array<double, D>, D - 1> tangent{};
    for (std::size_t k = 0; k < D - 1; ++k)
        for (std::size_t a = 0; a < Nodes; ++a)
            for (std::size_t i = 0; i < D; ++i) tangent[k][i] += s.dN[a][k] * mesh.nodes[std::size_t(facet[a])][i];
    if constexpr (D == 2) {
        return std::hypot(tangent[0][0], tangent[0][1]);
    } else {
        const auto &p = tangent[0], &q = tangent[1];
        return std::hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]);
    }
}

}  // namespace

template <int D>
std::vector<double> traction_forces(const Mesh<D>& mesh, const std::string& surface,
                                    std::type_identity_t<const std::array<double, D>&> t, double thickness) {
    std::vector<double> forces(D * mesh.nodes.size(), 0.0);
    for (const Facet& facet : mesh.surface(surface))
        with_facet_type<D>(facet.size(), [&]<class Type>(Type) {
            for (const auto& point : Type::rule()) {
                const auto s = Type::shape(point.xi);
                const double dA =
                    point.weight * area_element<D, Type::node_count>(mesh, facet, s) * (D == 2 ? thickness : 1);
                for (std::size_t a = 0; a < Type::node_count; ++a)
                    for (std::size_t i = 0; i < D; ++i) forces[D * std::size_t(facet[a]) + i] += dA * s.N[a] * t[i];
            }
        });
    return forces;
}

template <int D>
std::vector<double> shared_force(const Mesh<D>& mesh, std::span<const NodeIndex> nodes,
                                 std::type_identity_t<const std::array<double, D>&> force) {
    std::vector<double> forces(D * mesh.nodes.size(), 0.0);
    for (const NodeIndex node : nodes)
        for (std::size_t i = 0; i < D; ++i) forces[D * std::size_t(node) + i] += force[i] / double(nodes.size());
    return forces;
}

void sum_at(const std::vector<DeadLoad>& loads, double t, std::span<double> forces) {
    std::fill(forces.begin(), forces.end(), 0.0);
    for (const DeadLoad& load : loads) {
        const double factor = load.factor ? load.factor(t) : 1;
        if (!std::isfinite(factor))
            throw std::domain_error("solid: the factor of a load is no finite number at t = " + std::to_string(t) +
                                    " s; look at its formula");
        for (std::size_t f = 0; f < forces.size(); ++f) forces[f] += factor * load.forces[f];
    }
}

template std::vector<double> traction_forces<2>(const Mesh<2>&, const std::string&, const std::array<double, 2>&,
                                                double);
template std::vector<double> traction_forces<3>(const Mesh<3>&, const std::string&, const std::array<double, 3>&,
                                                double);
template std::vector<double> shared_force<2>(const Mesh<2>&, std::span<const NodeIndex>, const std::array<double, 2>&);
template std::vector<double> shared_force<3>(const Mesh<3>&, std::span<const NodeIndex>, const std::array<double, 3>&);

}  // namespace aquagraph::solid
