// The facets of one surface, for what acts on surfaces: where their Gauss points are, and how their forces come to the
// nodes and their tangents to the matrix. Forces and matrices of a facet are its own, so that facets may be done by any
// number of threads; sums at nodes are made in a fixed order.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/solid/element_group.hpp"
#include "physics/solid/elements/facets.hpp"
#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

inline constexpr std::size_t most_facet_nodes = 8;

// Shape functions at a Gauss point of a facet, whatever its type.
struct FacetPoint {
    std::array<double, most_facet_nodes> N{};
    std::array<std::array<double, 2>, most_facet_nodes> dN{};  // ∂N_a/∂ξ_k; D = 2: k = 0 only
    double weight = 0;
};

// The Gauss points of facets of this many nodes. Throws std::invalid_argument if there are no such facets.
template <int D>
std::vector<FacetPoint> facet_points(std::size_t nodes) {
    return with_facet_type<D>(nodes, [](const auto& type) {
        std::vector<FacetPoint> points;
        for (const auto& gauss : type.rule()) {
            const auto s = type.shape(gauss.xi);
            FacetPoint& point = points.emplace_back();
            point.weight = gauss.weight;
            for (std::size_t a = 0; a < s.N.size(); ++a) {
                point.N[a] = s.N[a];
                for (std::size_t k = 0; k < s.dN[a].size(); ++k) point.dN[a][k] = s.dN[a][k];
            }
        }
        return points;
    });
}

template <int D>
class SurfaceFacets {
  public:
    using Vector = std::array<double, D>;
    using Nodal = std::array<Vector, most_facet_nodes>;  // of one facet

    // thickness: of a plane mesh [m]. Throws std::invalid_argument for an unknown surface.
    SurfaceFacets(const Mesh<D>& mesh, const std::string& surface, double thickness)
        : facets_(mesh.surface(surface)), thickness_(D == 2 ? thickness : 1) {
        for (const Facet& facet : facets_) {
            first_point_.push_back(points_);
            first_matrix_.push_back(matrix_size_);
            if (rules_[facet.size()].empty()) rules_[facet.size()] = facet_points<D>(facet.size());
            points_ += rules_[facet.size()].size();
            matrix_size_ += packed_index(D * facet.size(), 0);
            Nodal& X = reference_.emplace_back();
            for (std::size_t a = 0; a < facet.size(); ++a) X[a] = mesh.nodes[std::size_t(facet[a])];
        }
        forces_.resize(facets_.size());
    }

    std::size_t count() const { return facets_.size(); }
    const Facet& operator[](std::size_t k) const { return facets_[k]; }
    const std::vector<FacetPoint>& rule(std::size_t k) const { return rules_[facets_[k].size()]; }
    std::size_t points() const { return points_; }  // Gauss points of all
    std::size_t first_point(std::size_t k) const { return first_point_[k]; }
    std::size_t matrix_size() const { return matrix_size_; }  // of all: packed lower triangles, one after the other
    std::size_t first_matrix(std::size_t k) const { return first_matrix_[k]; }

    const Nodal& reference(std::size_t k) const { return reference_[k]; }
    Nodal positions(std::size_t k, std::span<const double> u) const {
        Nodal x = reference_[k];
        for (std::size_t a = 0; a < facets_[k].size(); ++a)
            for (std::size_t i = 0; i < D; ++i) x[a][i] += u[D * std::size_t(facets_[k][a]) + i];
        return x;
    }

    static Vector interpolate(const FacetPoint& point, const Nodal& values) {
        Vector sum{};
        for (std::size_t a = 0; a < most_facet_nodes; ++a)
            for (std::size_t i = 0; i < D; ++i) sum[i] += point.N[a] * values[a][i];
        return sum;
    }
    // ∂x/∂ξ_k
    static Vector along(const FacetPoint& point, const Nodal& x, std::size_t k) {
        Vector g{};
        for (std::size_t a = 0; a < most_facet_nodes; ++a)
            for (std::size_t i = 0; i < D; ++i) g[i] += point.dN[a][k] * x[a][i];
        return g;
    }
    // Outward normal × area of the facet per area of the parent domain [m²], thickness included.
    Vector area_normal(const FacetPoint& point, const Nodal& x) const {
        const Vector g = along(point, x, 0);
        if constexpr (D == 2) {
            return {thickness_ * g[1], -thickness_ * g[0]};
        } else {
            const Vector h = along(point, x, 1);
            return {g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0]};
        }
    }
    double thickness() const { return thickness_; }

    // body(k) for every facet
    template <class Body>
    void for_each(BlockLoop loop, const Body& body) const {
        constexpr std::size_t facets_per_block = 128;
        const std::size_t blocks = (count() + facets_per_block - 1) / facets_per_block;
        const auto block = [&](std::size_t b) {
            for (std::size_t k = b * facets_per_block; k < std::min(count(), (b + 1) * facets_per_block); ++k) body(k);
        };
        if (blocks == 1) return block(0);
        loop(blocks, block);
    }

    // The forces on the nodes of each facet, to be written, and summed up: nodal += factor × forces.
    Nodal& forces(std::size_t k) { return forces_[k]; }
    void add_forces(double factor, std::span<double> nodal) const {
        for (std::size_t k = 0; k < count(); ++k)
            for (std::size_t a = 0; a < facets_[k].size(); ++a)
                for (std::size_t i = 0; i < D; ++i)
                    nodal[D * std::size_t(facets_[k][a]) + i] += factor * forces_[k][a][i];
    }

  private:
    std::vector<Facet> facets_;
    std::vector<Nodal> reference_, forces_;
    std::array<std::vector<FacetPoint>, most_facet_nodes + 1> rules_;  // by number of nodes
    std::vector<std::size_t> first_point_, first_matrix_;
    std::size_t points_ = 0, matrix_size_ = 0;
    double thickness_;
};

// The facets that have tangents, in the order of their matrices: those of the pressures, then of the contacts.
template <int D>
std::vector<Facet> stiff_facets(const Mesh<D>& mesh, const Options<D>& options) {
    std::vector<Facet> facets;
    const auto add = [&](const std::string& surface) {
        facets.insert(facets.end(), mesh.surface(surface).begin(), mesh.surface(surface).end());
    };
    for (const Pressure& pressure : options.pressures) add(pressure.surface);
    for (const Contact<D>& contact : options.contacts) add(contact.surface);
    return facets;
}

}  // namespace aquagraph::solid
