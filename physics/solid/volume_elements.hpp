// Isoparametric elements of one type and one law: gradients of the shape functions are computed once, the loops over
// Gauss points run on packs of elements side by side.
#pragma once
#include <algorithm>
#include <utility>

#include "physics/solid/element_group.hpp"
#include "physics/solid/elements/dispatch.hpp"
#include "physics/solid/materials/law.hpp"

namespace aquagraph::solid {

// Nodes of packs of elements.
template <std::size_t Nodes, int D>
class Connectivity {
  public:
    Connectivity(const ElementGroup<D>& group, const Mesh<D>& mesh) : nodes_(group.packs() * Nodes * lanes) {
        for (std::size_t p = 0; p < group.packs(); ++p)
            for (std::size_t l = 0; l < lanes; ++l)
                for (std::size_t a = 0; a < Nodes; ++a)
                    nodes_[(p * Nodes + a) * lanes + l] = element(group, mesh, p, l)[a];
    }
    // Whether there is an element on this lane; the last one stands in where there is none.
    static bool real(const ElementGroup<D>& group, std::size_t p, std::size_t l) {
        return p * lanes + l < group.members().size();
    }
    static const Element& element(const ElementGroup<D>& group, const Mesh<D>& mesh, std::size_t p, std::size_t l) {
        return mesh.elements[std::size_t(group.members()[std::min(p * lanes + l, group.members().size() - 1)])];
    }
    void gather(std::size_t p, std::span<const double> u, Lane (&U)[Nodes][D]) const {
        for (std::size_t a = 0; a < Nodes; ++a)
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto node = std::size_t(nodes_[(p * Nodes + a) * lanes + l]);
                for (std::size_t i = 0; i < D; ++i) U[a][i][l] = u[D * node + i];
            }
    }

  private:
    std::vector<int> nodes_;  // [pack][node][lane]
};

// The law as it is in pack p: laws with directions of their own differ from element to element.
template <class Law>
decltype(auto) law_of_pack(const Law& law, std::size_t p) {
    if constexpr (requires { law.of_pack(p); })
        return law.of_pack(p);
    else
        return (law);
}

// In arrays of double there is no promise of 64-byte alignment.
using UnalignedLane = double __attribute__((vector_size(lanes * sizeof(double)), aligned(sizeof(double)), may_alias));

template <std::size_t Nodes, int D>
inline Tensor<D, Lane> displacement_gradient(const auto& point, const Lane (&U)[Nodes][D]) {
    Tensor<D, Lane> H;
    for (std::size_t a = 0; a < Nodes; ++a)
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t J = 0; J < D; ++J) H(i, J) += U[a][i] * point.dN_dX[a][J];
    return H;
}

// K_ai,bk += w N_a,J A_iJkL N_b,L
template <std::size_t Nodes, int D>
inline void add_tangent(const auto& point, const FullTangent<D, Lane>& A, UnalignedLane* K) {
    for (std::size_t b = 0; b < Nodes; ++b) {
        Lane along[D * D][D] = {};  // w A_iJkL N_b,L
        for (std::size_t iJ = 0; iJ < D * D; ++iJ)
            for (std::size_t k = 0; k < D; ++k) {
                for (std::size_t L = 0; L < D; ++L) along[iJ][k] += A.c[iJ][D * k + L] * point.dN_dX[b][L];
                along[iJ][k] *= point.weight;
            }
        for (std::size_t a = b; a < Nodes; ++a)
            for (std::size_t i = 0; i < D; ++i)
                for (std::size_t k = 0; k < (a == b ? i + 1 : D); ++k) {
                    UnalignedLane& entry = K[packed_index(D * a + i, D * b + k)];
                    Lane sum = entry;
                    for (std::size_t J = 0; J < D; ++J) sum += point.dN_dX[a][J] * along[D * i + J][k];
                    entry = sum;
                }
    }
}

template <std::size_t Nodes, int D>
inline void store_forces(const Lane (&f)[Nodes][D], double* out) {
    for (std::size_t a = 0; a < Nodes; ++a)
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t l = 0; l < lanes; ++l) out[(D * a + i) * lanes + l] = f[a][i][l];
}

template <class Type, class Law>
class VolumeElements final : public ElementGroup<Type::dimension> {
    static constexpr int D = Type::dimension;
    static constexpr std::size_t nodes = Type::node_count;
    using Group = ElementGroup<D>;

    struct Point {
        Lane dN_dX[nodes][D];  // [1/m]
        Lane weight;           // Gauss weight × det ∂X/∂ξ × thickness [m³]
    };

  public:
    VolumeElements(const Mesh<D>& mesh, std::vector<ElementIndex> members, const Law& law, double thickness,
                   const std::vector<GaussPoint<D>>& rule)
        : Group(std::move(members), nodes),
          law_(law),
          points_per_element_(rule.size()),
          points_(Group::packs() * points_per_element_),
          connectivity_(*this, mesh) {
        for (std::size_t p = 0; p < Group::packs(); ++p)
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto X = coordinates<Type>(mesh, connectivity_.element(*this, mesh, p, l));
                for (std::size_t g = 0; g < points_per_element_; ++g) {
                    const auto gradients = reference_gradients(Type::shape(rule[g].xi), X);
                    Point& point = points_[p * points_per_element_ + g];
                    point.weight[l] =
                        connectivity_.real(*this, p, l) ? rule[g].weight * gradients.jacobian * thickness : 0;
                    for (std::size_t a = 0; a < nodes; ++a)
                        for (std::size_t i = 0; i < D; ++i) point.dN_dX[a][i][l] = gradients.dN_dX[a][i];
                }
            }
    }

    void internal_forces(std::span<const double> u, std::size_t first, std::size_t last, std::span<double> forces,
                         std::span<double> smallest_J) const override {
        for (std::size_t p = first; p < last; ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D], f[nodes][D] = {};
            connectivity_.gather(p, u, U);
            Lane smallest = Lane{} + 1.0;
            for (std::size_t g = 0; g < points_per_element_; ++g) {
                const Point& point = points_[p * points_per_element_ + g];
                const auto k = kinematics<Law, D, Lane>(displacement_gradient<nodes, D>(point, U));
                smallest = smaller(k.J_minus_1 + 1.0, smallest);
                const Tensor<D, Lane> P = first_piola(law, k);
                for (std::size_t i = 0; i < D; ++i) {
                    Lane weighted[D];
                    for (std::size_t J = 0; J < D; ++J) weighted[J] = point.weight * P(i, J);
                    for (std::size_t a = 0; a < nodes; ++a)
                        for (std::size_t J = 0; J < D; ++J) f[a][i] += weighted[J] * point.dN_dX[a][J];
                }
            }
            store_forces<nodes, D>(f, &forces[p * Group::force_size()]);
            smallest_J[p] = smallest_lane(smallest);
        }
    }

    // K_ai,bk = Σ w N_a,J A_iJkL N_b,L
    void tangents(std::span<const double> u, std::size_t first, std::size_t last,
                  std::span<double> matrices) const override {
        for (std::size_t p = first; p < last; ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D];
            connectivity_.gather(p, u, U);
            auto* K = reinterpret_cast<UnalignedLane*>(&matrices[p * Group::matrix_size()]);
            std::fill(K, K + packed_index(Group::rows(), 0), Lane{});
            for (std::size_t g = 0; g < points_per_element_; ++g) {
                const Point& point = points_[p * points_per_element_ + g];
                const auto k = kinematics<Law, D, Lane>(displacement_gradient<nodes, D>(point, U));
                add_tangent<nodes>(point, full_tangent(law, k), K);
            }
        }
    }

    void energies(std::span<const double> u, std::size_t first, std::size_t last,
                  std::span<double> energies) const override {
        for (std::size_t p = first; p < last; ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D], sum{};
            connectivity_.gather(p, u, U);
            for (std::size_t g = 0; g < points_per_element_; ++g) {
                const Point& point = points_[p * points_per_element_ + g];
                sum += point.weight * law.energy(kinematics<Law, D, Lane>(displacement_gradient<nodes, D>(point, U)));
            }
            energies[p] = sum_of_lanes(sum);
        }
    }

    void von_mises(std::span<const double> u, std::span<double> stress) const override {
        for (std::size_t p = 0; p < Group::packs(); ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D], sum{};
            connectivity_.gather(p, u, U);
            for (std::size_t g = 0; g < points_per_element_; ++g)
                sum += solid::von_mises(law, kinematics<Law, D, Lane>(displacement_gradient<nodes, D>(
                                                 points_[p * points_per_element_ + g], U)));
            for (std::size_t l = 0; l < lanes && p * lanes + l < Group::members().size(); ++l)
                stress[std::size_t(Group::members()[p * lanes + l])] = sum[l] / double(points_per_element_);
        }
    }

  private:
    Law law_;
    std::size_t points_per_element_;
    std::vector<Point> points_;  // [pack][point]
    Connectivity<nodes, D> connectivity_;
};

}  // namespace aquagraph::solid
