// The four-node quadrilateral and the eight-node hexahedron: N_a = Π_d ½ (1 + ξ_ad ξ_d) (Zienkiewicz & Taylor, The
// Finite Element Method, vol. 1, 8.4). On their own they lock; enhanced_elements.hpp is the remedy.
#pragma once
#include "physics/solid/elements/shape.hpp"

namespace aquagraph::solid {

template <int D>
struct Multilinear {
    static constexpr int dimension = D;
    static constexpr std::size_t node_count = D == 2 ? 4 : 8, corner_count = node_count;

    static constexpr std::array<std::array<double, D>, node_count> parent_nodes = [] {
        std::array<std::array<double, D>, node_count> nodes{};
        constexpr double x[4] = {-1, 1, 1, -1}, y[4] = {-1, -1, 1, 1};
        for (std::size_t a = 0; a < node_count; ++a) {
            nodes[a][0] = x[a % 4];
            nodes[a][1] = y[a % 4];
            if constexpr (D == 3) nodes[a][2] = a < 4 ? -1 : 1;
        }
        return nodes;
    }();

    static Shape<D, node_count> shape(const std::array<double, D>& xi) {
        Shape<D, node_count> s;
        for (std::size_t a = 0; a < node_count; ++a) {
            std::array<double, D> factor;
            s.N[a] = 1;
            for (std::size_t d = 0; d < D; ++d) s.N[a] *= factor[d] = 0.5 * (1 + parent_nodes[a][d] * xi[d]);
            for (std::size_t k = 0; k < D; ++k) {
                s.dN[a][k] = 0.5 * parent_nodes[a][k];
                for (std::size_t d = 0; d < D; ++d)
                    if (d != k) s.dN[a][k] *= factor[d];
            }
        }
        return s;
    }

    static std::vector<GaussPoint<D>> stiffness_rule() { return product_rule<D>(2); }
    static std::vector<GaussPoint<D>> mass_rule() { return product_rule<D>(2); }

    static std::vector<std::vector<int>> sides() {
        if constexpr (D == 2) return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
        return {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    }
};

using Quad4 = Multilinear<2>;
using Hex8 = Multilinear<3>;

}  // namespace aquagraph::solid
