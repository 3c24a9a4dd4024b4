// The eight-node serendipity quadrilateral on the parent square [-1, 1]² (Zienkiewicz & Taylor, The Finite Element
// Method, vol. 1, 8.6): shape functions N_a(ξ, η) and their derivatives.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "physics/solid/mesh.hpp"

namespace aquagraph::solid::quad8 {

inline constexpr std::size_t node_count = 8;

// Parent coordinates of the nodes, in the order of Quad8Nodes.
inline constexpr std::array<std::array<double, 2>, node_count> parent_nodes{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

struct Shape {
    std::array<double, node_count> N{};
    std::array<std::array<double, 2>, node_count> dN{};  // ∂N_a/∂ξ, ∂N_a/∂η
};

inline Shape shape(double xi, double eta) {
    Shape s;
    for (std::size_t a = 0; a < 4; ++a) {  // corners: N = ¼ (1 + ξ_a ξ)(1 + η_a η)(ξ_a ξ + η_a η - 1)
        const double xi_a = parent_nodes[a][0], eta_a = parent_nodes[a][1];
        const double p = 1 + xi_a * xi, q = 1 + eta_a * eta;
        s.N[a] = 0.25 * p * q * (p + q - 3);
        s.dN[a] = {0.25 * xi_a * q * (2 * p + q - 3), 0.25 * eta_a * p * (p + 2 * q - 3)};
    }
    for (const std::size_t a : {std::size_t{4}, std::size_t{6}}) {  // ξ_a = 0: N = ½ (1 - ξ²)(1 + η_a η)
        const double eta_a = parent_nodes[a][1];
        s.N[a] = 0.5 * (1 - xi * xi) * (1 + eta_a * eta);
        s.dN[a] = {-xi * (1 + eta_a * eta), 0.5 * eta_a * (1 - xi * xi)};
    }
    for (const std::size_t a : {std::size_t{5}, std::size_t{7}}) {  // η_a = 0: N = ½ (1 + ξ_a ξ)(1 - η²)
        const double xi_a = parent_nodes[a][0];
        s.N[a] = 0.5 * (1 + xi_a * xi) * (1 - eta * eta);
        s.dN[a] = {0.5 * xi_a * (1 - eta * eta), -eta * (1 + xi_a * xi)};
    }
    return s;
}

struct GaussPoint {
    double xi = 0, eta = 0, weight = 0;
};

// 2 × 2 points, for the internal forces: with the full 3 × 3 rule the element stiffens as ν approaches ½. Measured on
// Cook's membrane, ν = 0.4999, 4 × 4 elements: 6.85 of 7.38 (3 × 3: 6.41); on a beam of five elements 8 times as long
// as thick: 0.83 of beam theory (0.68). The price is one mode without energy, which does not survive in two elements
// (tested).
inline const std::array<GaussPoint, 4> reduced_rule = [] {
    const double g = 1 / std::sqrt(3.0);
    return std::array<GaussPoint, 4>{{{-g, -g, 1}, {g, -g, 1}, {g, g, 1}, {-g, g, 1}}};
}();

// 3 × 3 points, for the mass: exact for N_a N_b on a parallelogram but for its highest term.
inline const std::array<GaussPoint, 9> full_rule = [] {
    const std::array<double, 3> x{-std::sqrt(0.6), 0, std::sqrt(0.6)}, w{5.0 / 9, 8.0 / 9, 5.0 / 9};
    std::array<GaussPoint, 9> rule;
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) rule[3 * j + i] = {x[i], x[j], w[i] * w[j]};
    return rule;
}();

// Gradients with respect to the reference coordinates at a point of an element, and det ∂X/∂ξ there.
struct ReferenceGradients {
    std::array<std::array<double, 2>, node_count> dN_dX{};
    double jacobian = 0;
};

inline ReferenceGradients reference_gradients(const Shape& s, std::span<const std::array<double, 2>, node_count> X) {
    double J[2][2] = {};  // J[i][k] = ∂X_i/∂ξ_k
    for (std::size_t a = 0; a < node_count; ++a)
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t k = 0; k < 2; ++k) J[i][k] += X[a][i] * s.dN[a][k];
    ReferenceGradients g;
    g.jacobian = J[0][0] * J[1][1] - J[0][1] * J[1][0];
    for (std::size_t a = 0; a < node_count; ++a)
        g.dN_dX[a] = {(s.dN[a][0] * J[1][1] - s.dN[a][1] * J[1][0]) / g.jacobian,
                      (s.dN[a][1] * J[0][0] - s.dN[a][0] * J[0][1]) / g.jacobian};
    return g;
}

inline std::array<std::array<double, 2>, node_count> coordinates(const Mesh& mesh, const Quad8Nodes& nodes) {
    std::array<std::array<double, 2>, node_count> X;
    for (std::size_t a = 0; a < node_count; ++a) X[a] = mesh.nodes[static_cast<std::size_t>(nodes[a])];
    return X;
}

}  // namespace aquagraph::solid::quad8
