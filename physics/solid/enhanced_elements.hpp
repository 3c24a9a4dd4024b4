// Linear quadrilaterals and hexahedra with enhanced assumed strains (Simo & Rifai, Int. J. Numer. Meth. Eng. 29, 1990;
// on the Green–Lagrange strain: Klinkel & Wagner, Int. J. Numer. Meth. Eng. 40, 1997), which lock neither in bending
// nor as ν approaches ½:
//   E = E(u) + Σ_m α_m G_m,   G_m = (det J_0 / det J) J_0^(-T) Ê_m(ξ) J_0^(-1),   J = ∂X/∂ξ, J_0 at the centre
// with Ê_m linear in one parent coordinate, and for hexahedra also in products of two (4 modes in the plane, 15 in
// space). Each Ê_m has no mean over the element, so that the patch test holds. The parameters make the energy of their
// element stationary, ∫ G_m : S dV = 0, and are solved for wherever they are needed: forces are a function of u alone,
// there is no history to keep, and the forces are the slope of the energy.
//
// Under strong compression enhanced strains can buckle into hourglasses (Wriggers & Reese, Comput. Methods Appl. Mech.
// Eng. 135, 1996); quadratic elements do not.
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "physics/solid/volume_elements.hpp"

namespace aquagraph::solid {

// Ê_m: one pair of indices and one function of ξ.
template <int D>
struct EnhancedMode {
    std::size_t pair;
    std::array<int, D> powers;  // of the parent coordinates
};

template <int D>
constexpr auto enhanced_modes() {
    if constexpr (D == 2) {
        return std::array<EnhancedMode<2>, 4>{{{0, {1, 0}}, {1, {0, 1}}, {2, {1, 0}}, {2, {0, 1}}}};
    } else {
        return std::array<EnhancedMode<3>, 15>{{{0, {1, 0, 0}},
                                                {1, {0, 1, 0}},
                                                {2, {0, 0, 1}},
                                                {3, {1, 0, 0}},
                                                {3, {0, 1, 0}},
                                                {4, {0, 1, 0}},
                                                {4, {0, 0, 1}},
                                                {5, {1, 0, 0}},
                                                {5, {0, 0, 1}},
                                                {0, {1, 1, 0}},
                                                {0, {1, 0, 1}},
                                                {1, {1, 1, 0}},
                                                {1, {0, 1, 1}},
                                                {2, {1, 0, 1}},
                                                {2, {0, 1, 1}}}};
    }
}

template <int D, class Law>
class EnhancedElements final : public ElementGroup<D> {
    using Type = Multilinear<D>;
    using Group = ElementGroup<D>;
    static constexpr std::size_t nodes = Type::node_count, pairs = pair_count<D>, points = nodes;
    static constexpr auto modes = enhanced_modes<D>();
    static constexpr std::size_t mode_count = modes.size();

    struct Point {
        Lane dN_dX[nodes][D];       // [1/m]
        Lane weight;                // [m³]
        Lane G[mode_count][pairs];  // tensor components
    };
    struct Enhancement {
        Lane alpha[mode_count];
    };

  public:
    EnhancedElements(const Mesh<D>& mesh, std::vector<ElementIndex> members, const Law& law, double thickness)
        : Group(std::move(members), nodes), law_(law), points_(Group::packs() * points), connectivity_(*this, mesh) {
        const auto rule = Type::stiffness_rule();
        for (std::size_t p = 0; p < Group::packs(); ++p)
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto X = coordinates<Type>(mesh, connectivity_.element(*this, mesh, p, l));
                const auto centre = parent_jacobian(X, {});
                for (std::size_t g = 0; g < points; ++g)
                    set_point(points_[p * points + g], l, X, centre, rule[g],
                              connectivity_.real(*this, p, l) ? thickness : 0);
            }
    }

    void internal_forces(std::span<const double> u, std::size_t first, std::size_t last, std::span<double> forces,
                         std::span<double> smallest_J) const override {
        for (std::size_t p = first; p < last; ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D], f[nodes][D] = {}, smallest = Lane{} + 1.0;
            connectivity_.gather(p, u, U);
            const Enhancement enhancement = enhance(law, p, U);
            for (std::size_t g = 0; g < points; ++g) {
                const Point& point = points_[p * points + g];
                const auto k = state(point, U, enhancement);
                smallest = smaller(determinant_minus_1(k.H) + 1.0, smaller(k.J_minus_1 + 1.0, smallest));
                const Tensor<D, Lane> P = first_piola(law, k);
                for (std::size_t a = 0; a < nodes; ++a)
                    for (std::size_t i = 0; i < D; ++i)
                        for (std::size_t J = 0; J < D; ++J) f[a][i] += point.weight * P(i, J) * point.dN_dX[a][J];
            }
            store_forces<nodes, D>(f, &forces[p * Group::force_size()]);
            smallest_J[p] = smallest_lane(smallest);
        }
    }

    // K = K_uu - K_uα K_αα⁻¹ K_αu
    void tangents(std::span<const double> u, std::size_t first, std::size_t last,
                  std::span<double> matrices) const override {
        for (std::size_t p = first; p < last; ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D];
            connectivity_.gather(p, u, U);
            const Enhancement enhancement = enhance(law, p, U);
            auto* K = reinterpret_cast<UnalignedLane*>(&matrices[p * Group::matrix_size()]);
            std::fill(K, K + packed_index(D * nodes, 0), Lane{});
            Lane mixed[mode_count][D * nodes] = {};  // K_αu
            ModeMatrix inner{};
            for (std::size_t g = 0; g < points; ++g) {
                const Point& point = points_[p * points + g];
                const auto k = state(point, U, enhancement);
                add_tangent<nodes>(point, full_tangent(law, k), K);
                const auto along = add_inner(point, law.tangent(k), inner);
                for (std::size_t m = 0; m < mode_count; ++m) {  // (F C:G_m)·∇N_a
                    Tensor<D, Lane> FD = along[m];
                    if constexpr (!Law::small_strain)
                        for (std::size_t i = 0; i < D; ++i)
                            for (std::size_t J = 0; J < D; ++J)
                                for (std::size_t n = 0; n < D; ++n) FD(i, J) += k.H(i, n) * along[m](n, J);
                    for (std::size_t a = 0; a < nodes; ++a)
                        for (std::size_t i = 0; i < D; ++i)
                            for (std::size_t J = 0; J < D; ++J)
                                mixed[m][D * a + i] += point.weight * FD(i, J) * point.dN_dX[a][J];
                }
            }
            condense(inner, mixed, K);
        }
    }

    void energies(std::span<const double> u, std::size_t first, std::size_t last,
                  std::span<double> energies) const override {
        for (std::size_t p = first; p < last; ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D], sum{};
            connectivity_.gather(p, u, U);
            const Enhancement enhancement = enhance(law, p, U);
            for (std::size_t g = 0; g < points; ++g)
                sum += points_[p * points + g].weight * law.energy(state(points_[p * points + g], U, enhancement));
            energies[p] = sum_of_lanes(sum);
        }
    }

    void von_mises(std::span<const double> u, std::span<double> stress) const override {
        for (std::size_t p = 0; p < Group::packs(); ++p) {
            const auto& law = law_of_pack(law_, p);
            Lane U[nodes][D], sum{};
            connectivity_.gather(p, u, U);
            const Enhancement enhancement = enhance(law, p, U);
            for (std::size_t g = 0; g < points; ++g)
                sum += solid::von_mises(law, state(points_[p * points + g], U, enhancement));
            for (std::size_t l = 0; l < lanes && connectivity_.real(*this, p, l); ++l)
                stress[std::size_t(Group::members()[p * lanes + l])] = sum[l] / double(points);
        }
    }

  private:
    using ModeMatrix = std::array<std::array<Lane, mode_count>, mode_count>;  // lower triangle
    // Newton for α: quadratic; linear laws need one step, rubber at large strain up to six.
    static constexpr int most_iterations = 15;
    static constexpr double tolerance = 1e-13;  // of α, which is a strain

    static Eigen::Matrix<double, D, D> parent_jacobian(const auto& X, const std::array<double, D>& xi) {
        const auto s = Type::shape(xi);
        Eigen::Matrix<double, D, D> J;
        J.setZero();
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t i = 0; i < D; ++i)
                for (std::size_t k = 0; k < D; ++k) J(int(i), int(k)) += X[a][i] * s.dN[a][k];
        return J;
    }

    static void set_point(Point& point, std::size_t l, const auto& X, const Eigen::Matrix<double, D, D>& centre,
                          const GaussPoint<D>& at, double thickness) {
        const auto gradients = reference_gradients(Type::shape(at.xi), X);
        point.weight[l] = at.weight * gradients.jacobian * thickness;
        for (std::size_t a = 0; a < nodes; ++a)
            for (std::size_t i = 0; i < D; ++i) point.dN_dX[a][i][l] = gradients.dN_dX[a][i];
        const Eigen::Matrix<double, D, D> inverse = centre.inverse();
        const double ratio = centre.determinant() / gradients.jacobian;
        constexpr auto index = index_pairs<D>();
        for (std::size_t m = 0; m < mode_count; ++m) {
            double size = ratio;
            for (std::size_t d = 0; d < D; ++d)
                for (int n = 0; n < modes[m].powers[d]; ++n) size *= at.xi[d];
            const auto [i, j] = index[modes[m].pair];
            // scaled to strains of order α: J_0 has the size of the element
            const double scale = std::pow(std::abs(centre.determinant()), 2.0 / D);
            for (std::size_t q = 0; q < pairs; ++q) {
                const auto I = int(index[q][0]), J = int(index[q][1]);
                double value = inverse(int(i), I) * inverse(int(j), J);
                if (i != j) value += inverse(int(j), I) * inverse(int(i), J);
                point.G[m][q][l] = size * scale * value;
            }
        }
    }

    static Kinematics<D, Lane> state(const Point& point, const Lane (&U)[nodes][D], const Enhancement& enhancement) {
        auto k = kinematics<Law, D, Lane>(displacement_gradient<nodes, D>(point, U));
        constexpr auto index = index_pairs<D>();
        k.trace = Lane{};
        for (std::size_t q = 0; q < pairs; ++q) {
            Lane sum = k.E(index[q][0], index[q][1]);
            for (std::size_t m = 0; m < mode_count; ++m) sum += enhancement.alpha[m] * point.G[m][q];
            k.E(index[q][0], index[q][1]) = k.E(index[q][1], index[q][0]) = sum;
            if (q < D) k.trace += sum;
        }
        if constexpr (!Law::small_strain) {  // J² = det(I + 2E)
            Tensor<D, Lane> twice;
            for (std::size_t i = 0; i < D; ++i)
                for (std::size_t j = 0; j < D; ++j) twice(i, j) = 2.0 * k.E(i, j);
            const Lane square_minus_1 = determinant_minus_1(twice);
            k.J_minus_1 = square_minus_1 / (1.0 + square_root(square_minus_1 + 1.0));
        }
        return k;
    }

    // inner += w G_m:C:G_n; returns C:G_m as tensors.
    static std::array<Tensor<D, Lane>, mode_count> add_inner(const Point& point, const SymmetricTangent<D, Lane>& C,
                                                             ModeMatrix& inner) {
        std::array<Tensor<D, Lane>, mode_count> along;
        constexpr auto index = index_pairs<D>();
        for (std::size_t m = 0; m < mode_count; ++m) {
            for (std::size_t q = 0; q < pairs; ++q) {
                Lane sum{};
                for (std::size_t r = 0; r < pairs; ++r) sum += (r < D ? 1.0 : 2.0) * C.c[q][r] * point.G[m][r];
                along[m](index[q][0], index[q][1]) = along[m](index[q][1], index[q][0]) = sum;
            }
            for (std::size_t n = 0; n <= m; ++n) inner[m][n] += point.weight * mode_dot(point.G[n], along[m]);
        }
        return along;
    }

    static Lane mode_dot(const Lane (&G)[pairs], const Tensor<D, Lane>& S) {
        constexpr auto index = index_pairs<D>();
        Lane sum{};
        for (std::size_t q = 0; q < pairs; ++q) sum += (q < D ? 1.0 : 2.0) * G[q] * S(index[q][0], index[q][1]);
        return sum;
    }

    // L D Lᵀ in place; lanes without weight (pivot 0) are left alone.
    static void factorise(ModeMatrix& A) {
        for (std::size_t m = 0; m < mode_count; ++m) {
            for (std::size_t n = 0; n < m; ++n) {
                for (std::size_t k = 0; k < n; ++k) A[m][n] -= A[m][k] * A[n][k] * A[k][k];
                A[m][n] = A[n][n] == 0.0 ? Lane{} : A[m][n] / A[n][n];
            }
            for (std::size_t k = 0; k < m; ++k) A[m][m] -= A[m][k] * A[m][k] * A[k][k];
        }
    }
    static void solve(const ModeMatrix& A, Lane* x) {
        for (std::size_t m = 0; m < mode_count; ++m)
            for (std::size_t k = 0; k < m; ++k) x[m] -= A[m][k] * x[k];
        for (std::size_t m = 0; m < mode_count; ++m) x[m] = A[m][m] == 0.0 ? Lane{} : x[m] / A[m][m];
        for (std::size_t m = mode_count; m-- > 0;)
            for (std::size_t k = m + 1; k < mode_count; ++k) x[m] -= A[k][m] * x[k];
    }

    template <class PackLaw>
    Enhancement enhance(const PackLaw& law, std::size_t p, const Lane (&U)[nodes][D]) const {
        Enhancement enhancement{};
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            ModeMatrix inner{};
            Lane residual[mode_count] = {};
            for (std::size_t g = 0; g < points; ++g) {
                const Point& point = points_[p * points + g];
                const auto k = state(point, U, enhancement);
                const auto S = law.stress(k);
                for (std::size_t m = 0; m < mode_count; ++m) residual[m] -= point.weight * mode_dot(point.G[m], S);
                add_inner(point, law.tangent(k), inner);
            }
            factorise(inner);
            solve(inner, residual);
            double largest = 0;
            for (std::size_t m = 0; m < mode_count; ++m) {
                enhancement.alpha[m] += residual[m];
                for (std::size_t l = 0; l < lanes; ++l) largest = std::max(largest, std::abs(residual[m][l]));
            }
            // quadratic: what is left after a correction this small is below rounding
            if (!(largest * largest > tolerance)) break;
        }
        return enhancement;
    }

    static void condense(ModeMatrix& inner, const Lane (&mixed)[mode_count][D * nodes], UnalignedLane* K) {
        factorise(inner);
        for (std::size_t column = 0; column < D * nodes; ++column) {
            Lane x[mode_count];
            for (std::size_t m = 0; m < mode_count; ++m) x[m] = mixed[m][column];
            solve(inner, x);
            for (std::size_t row = column; row < D * nodes; ++row) {
                Lane sum{};
                for (std::size_t m = 0; m < mode_count; ++m) sum += mixed[m][row] * x[m];
                K[packed_index(row, column)] = Lane(K[packed_index(row, column)]) - sum;
            }
        }
    }

    Law law_;
    std::vector<Point> points_;  // [pack][point]
    Connectivity<nodes, D> connectivity_;
};

}  // namespace aquagraph::solid
