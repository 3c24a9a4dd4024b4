// Isoparametric elements of one type and one law: gradients of the shape functions are computed once, the loops over
// Gauss points run on packs of elements side by side.
#pragma once
#include <algorithm>
#include <utility>

#include "physics/solid/element_group.hpp"
#include "physics/solid/elements/dispatch.hpp"
#include "physics/solid/materials/law.hpp"

namespace aquagraph::solid {

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
    VolumeElements(const Mesh<D>& mesh, std::vector<ElementIndex> members, const Law& law, double thickness)
        : Group(std::move(members), nodes), law_(law), points_per_element_(Type::stiffness_rule().size()) {
        const auto rule = Type::stiffness_rule();
        points_.resize(Group::packs() * points_per_element_);
        connectivity_.resize(Group::packs() * nodes * lanes);
        for (std::size_t p = 0; p < Group::packs(); ++p)
            for (std::size_t l = 0; l < lanes; ++l) {
                const std::size_t member = p * lanes + l, count = Group::members().size();
                const Element& element = mesh.elements[std::size_t(Group::members()[std::min(member, count - 1)])];
                const auto X = coordinates<Type>(mesh, element);
                for (std::size_t a = 0; a < nodes; ++a) connectivity_[(p * nodes + a) * lanes + l] = element[a];
                for (std::size_t g = 0; g < points_per_element_; ++g) {
                    const auto gradients = reference_gradients(Type::shape(rule[g].xi), X);
                    Point& point = points_[p * points_per_element_ + g];
                    point.weight[l] = member < count ? rule[g].weight * gradients.jacobian * thickness : 0;
                    for (std::size_t a = 0; a < nodes; ++a)
                        for (std::size_t i = 0; i < D; ++i) point.dN_dX[a][i][l] = gradients.dN_dX[a][i];
                }
            }
    }

    void internal_forces(std::span<const double> u, std::size_t first, std::size_t last, std::span<double> forces,
                         std::span<double> smallest_J) const override {
        for (std::size_t p = first; p < last; ++p) {
            Lane U[nodes][D], f[nodes][D] = {};
            gather(p, u, U);
            Lane smallest = Lane{} + 1.0;
            for (std::size_t g = 0; g < points_per_element_; ++g) {
                const Point& point = points_[p * points_per_element_ + g];
                const auto k = kinematics<Law, D, Lane>(gradient(point, U));
                smallest = smaller(k.J_minus_1 + 1.0, smallest);
                const Tensor<D, Lane> P = first_piola(law_, k);
                for (std::size_t i = 0; i < D; ++i) {
                    Lane weighted[D];
                    for (std::size_t J = 0; J < D; ++J) weighted[J] = point.weight * P(i, J);
                    for (std::size_t a = 0; a < nodes; ++a)
                        for (std::size_t J = 0; J < D; ++J) f[a][i] += weighted[J] * point.dN_dX[a][J];
                }
            }
            double* out = &forces[p * Group::force_size()];
            for (std::size_t a = 0; a < nodes; ++a)
                for (std::size_t i = 0; i < D; ++i)
                    for (std::size_t l = 0; l < lanes; ++l) out[(D * a + i) * lanes + l] = f[a][i][l];
            smallest_J[p] = smallest[0];
            for (std::size_t l = 1; l < lanes; ++l) smallest_J[p] = std::min(smallest_J[p], smallest[l]);
        }
    }

    // K_ai,bk = Σ w N_a,J A_iJkL N_b,L
    void tangents(std::span<const double> u, std::size_t first, std::size_t last,
                  std::span<double> matrices) const override {
        for (std::size_t p = first; p < last; ++p) {
            Lane U[nodes][D];
            gather(p, u, U);
            auto* K = reinterpret_cast<UnalignedLane*>(&matrices[p * Group::matrix_size()]);
            std::fill(K, K + packed_index(Group::rows(), 0), Lane{});
            for (std::size_t g = 0; g < points_per_element_; ++g) {
                const Point& point = points_[p * points_per_element_ + g];
                const auto k = kinematics<Law, D, Lane>(gradient(point, U));
                add_tangent(point, full_tangent(law_, k), K);
            }
        }
    }

    void energies(std::span<const double> u, std::size_t first, std::size_t last,
                  std::span<double> energies) const override {
        for (std::size_t p = first; p < last; ++p) {
            Lane U[nodes][D], sum{};
            gather(p, u, U);
            for (std::size_t g = 0; g < points_per_element_; ++g) {
                const Point& point = points_[p * points_per_element_ + g];
                sum += point.weight * law_.energy(kinematics<Law, D, Lane>(gradient(point, U)));
            }
            energies[p] = 0;
            for (std::size_t l = 0; l < lanes; ++l) energies[p] += sum[l];
        }
    }

    void von_mises(std::span<const double> u, std::span<double> stress) const override {
        for (std::size_t p = 0; p < Group::packs(); ++p) {
            Lane U[nodes][D], sum{};
            gather(p, u, U);
            for (std::size_t g = 0; g < points_per_element_; ++g)
                sum +=
                    solid::von_mises(law_, kinematics<Law, D, Lane>(gradient(points_[p * points_per_element_ + g], U)));
            for (std::size_t l = 0; l < lanes && p * lanes + l < Group::members().size(); ++l)
                stress[std::size_t(Group::members()[p * lanes + l])] = sum[l] / double(points_per_element_);
        }
    }

  private:
    // In arrays of double there is no promise of 64-byte alignment.
    using UnalignedLane =
        double __attribute__((vector_size(lanes * sizeof(double)), aligned(sizeof(double)), may_alias));

    void gather(std::size_t p, std::span<const double> u, Lane (&U)[nodes][D]) const {
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto node = std::size_t(connectivity_[(p * nodes + a) * lanes + l]);
                for (std::size_t i = 0; i < D; ++i) U[a][i][l] = u[D * node + i];
            }
    }

    static Tensor<D, Lane> gradient(const Point& point, const Lane (&U)[nodes][D]) {
        Tensor<D, Lane> H;
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t i = 0; i < D; ++i)
                for (std::size_t J = 0; J < D; ++J) H(i, J) += U[a][i] * point.dN_dX[a][J];
        return H;
    }

    static void add_tangent(const Point& point, const FullTangent<D, Lane>& A, UnalignedLane* K) {
        for (std::size_t b = 0; b < nodes; ++b) {
            Lane along[D * D][D] = {};  // w A_iJkL N_b,L
            for (std::size_t iJ = 0; iJ < D * D; ++iJ)
                for (std::size_t k = 0; k < D; ++k) {
                    for (std::size_t L = 0; L < D; ++L) along[iJ][k] += A.c[iJ][D * k + L] * point.dN_dX[b][L];
                    along[iJ][k] *= point.weight;
                }
            for (std::size_t a = b; a < nodes; ++a)
                for (std::size_t i = 0; i < D; ++i)
                    for (std::size_t k = 0; k < (a == b ? i + 1 : D); ++k) {
                        UnalignedLane& entry = K[packed_index(D * a + i, D * b + k)];
                        Lane sum = entry;
                        for (std::size_t J = 0; J < D; ++J) sum += point.dN_dX[a][J] * along[D * i + J][k];
                        entry = sum;
                    }
        }
    }

    Law law_;
    std::size_t points_per_element_;
    std::vector<Point> points_;      // [pack][point]
    std::vector<int> connectivity_;  // [pack][node][lane]
};

// The group of this law, whatever the type of the elements.
template <int D, class Law>
std::unique_ptr<ElementGroup<D>> volume_elements(const Mesh<D>& mesh, std::vector<ElementIndex> members, const Law& law,
                                                 double thickness) {
    const std::size_t nodes = mesh.elements[std::size_t(members.front())].size();
    return with_element_type<D>(nodes, [&]<class Type>(Type) -> std::unique_ptr<ElementGroup<D>> {
        return std::make_unique<VolumeElements<Type, Law>>(mesh, std::move(members), law, thickness);
    });
}

}  // namespace aquagraph::solid
