// What every element type says about itself, on its parent domain ([-1, 1]^D, or the unit tetrahedron):
//   dimension, node_count, corner_count
//   parent_nodes                   parent coordinates of its nodes, in the order of mesh.hpp
//   shape(ξ)                       N_a and ∂N_a/∂ξ_k
//   stiffness_rule(), mass_rule()  Gauss points for internal forces, and for ∫ N_a N_b
//   sides()                        local nodes of each side, as facets of mesh.hpp
// and what follows from it for all alike.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace aquagraph::solid {

template <int D, std::size_t Nodes>
struct Shape {
    std::array<double, Nodes> N{};
    std::array<std::array<double, D>, Nodes> dN{};  // ∂N_a/∂ξ_k
};

template <int D>
struct GaussPoint {
    std::array<double, D> xi{};
    double weight = 0;
};

// Gauss–Legendre points of one direction on [-1, 1]; count 1, 2 or 3.
inline std::vector<GaussPoint<1>> gauss_legendre(int count) {
    if (count == 1) return {{{0}, 2}};
    if (count == 2) return {{{-1 / std::sqrt(3.0)}, 1}, {{1 / std::sqrt(3.0)}, 1}};
    return {{{-std::sqrt(0.6)}, 5.0 / 9}, {{0}, 8.0 / 9}, {{std::sqrt(0.6)}, 5.0 / 9}};
}

// count^D points on [-1, 1]^D, the first direction running fastest.
template <int D>
std::vector<GaussPoint<D>> product_rule(int count) {
    const auto line = gauss_legendre(count);
    std::vector<GaussPoint<D>> rule{{{}, 1}};
    for (std::size_t d = 0; d < D; ++d) {
        std::vector<GaussPoint<D>> longer;
        for (const auto& along : line)
            for (GaussPoint<D> point : rule) {
                point.xi[d] = along.xi[0];
                point.weight *= along.weight;
                longer.push_back(point);
            }
        rule = std::move(longer);
    }
    return rule;
}

template <int D>
double determinant(const double (&J)[D][D]) {
    if constexpr (D == 2)
        return J[0][0] * J[1][1] - J[0][1] * J[1][0];
    else
        return J[0][0] * (J[1][1] * J[2][2] - J[1][2] * J[2][1]) - J[0][1] * (J[1][0] * J[2][2] - J[1][2] * J[2][0]) +
               J[0][2] * (J[1][0] * J[2][1] - J[1][1] * J[2][0]);
}

// Gradients with respect to the reference coordinates at a point of an element, and det ∂X/∂ξ there.
template <int D, std::size_t Nodes>
struct ReferenceGradients {
    std::array<std::array<double, D>, Nodes> dN_dX{};
    double jacobian = 0;
};

template <int D, std::size_t Nodes>
ReferenceGradients<D, Nodes> reference_gradients(
    const Shape<D, Nodes>& s, const std::type_identity_t<std::array<std::array<double, D>, Nodes>>& X) {
    double J[D][D] = {};  // J[i][k] = ∂X_i/∂ξ_k
    for (std::size_t a = 0; a < Nodes; ++a)
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t k = 0; k < D; ++k) J[i][k] += X[a][i] * s.dN[a][k];
    ReferenceGradients<D, Nodes> g;
    g.jacobian = determinant(J);
    double cofactor[D][D];  // ∂ det J / ∂ J_ik: (J⁻¹)_ki = cofactor_ik / det J
    if constexpr (D == 2) {
        cofactor[0][0] = J[1][1], cofactor[0][1] = -J[1][0], cofactor[1][0] = -J[0][1], cofactor[1][1] = J[0][0];
    } else {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
                cofactor[i][k] = J[i1][k1] * J[i2][k2] - J[i1][k2] * J[i2][k1];
            }
    }
    for (std::size_t a = 0; a < Nodes; ++a)
        for (std::size_t i = 0; i < D; ++i) {
            double sum = 0;
            for (std::size_t k = 0; k < D; ++k) sum += s.dN[a][k] * cofactor[i][k];
            g.dN_dX[a][i] = sum / g.jacobian;
        }
    return g;
}

}  // namespace aquagraph::solid
