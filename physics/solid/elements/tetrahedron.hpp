// The ten-node tetrahedron on the unit tetrahedron, with L_0 = 1 - ξ - η - ζ, L_1 = ξ, L_2 = η, L_3 = ζ (Zienkiewicz &
// Taylor, The Finite Element Method, vol. 1, 8.11): corners L (2L - 1), middles 4 L_p L_q.
#pragma once
#include "physics/solid/elements/shape.hpp"

namespace aquagraph::solid {

struct Tet10 {
    static constexpr int dimension = 3;
    static constexpr std::size_t node_count = 10, corner_count = 4;

    static constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

    static constexpr std::array<std::array<double, 3>, node_count> parent_nodes = [] {
        std::array<std::array<double, 3>, node_count> nodes{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        for (std::size_t e = 0; e < 6; ++e)
            for (std::size_t d = 0; d < 3; ++d) nodes[4 + e][d] = 0.5 * (nodes[edges[e][0]][d] + nodes[edges[e][1]][d]);
        return nodes;
    }();

    static Shape<3, node_count> shape(const std::array<double, 3>& xi) {
        const double L[4] = {1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};
        constexpr double dL[4][3] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        Shape<3, node_count> s;
        for (std::size_t a = 0; a < 4; ++a) {
            s.N[a] = L[a] * (2 * L[a] - 1);
            for (std::size_t k = 0; k < 3; ++k) s.dN[a][k] = (4 * L[a] - 1) * dL[a][k];
        }
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [p, q] = edges[e];
            s.N[4 + e] = 4 * L[p] * L[q];
            for (std::size_t k = 0; k < 3; ++k) s.dN[4 + e][k] = 4 * (dL[p][k] * L[q] + L[p] * dL[q][k]);
        }
        return s;
    }

    static std::vector<GaussPoint<3>> stiffness_rule() {  // four points, second degree
        const double a = (5 - std::sqrt(5.0)) / 20, b = 1 - 3 * a, w = 1.0 / 24;
        return {{{a, a, a}, w}, {{b, a, a}, w}, {{a, b, a}, w}, {{a, a, b}, w}};
    }
    // Fourteen points, fifth degree (Walkington, Quadrature on simplices of arbitrary dimension, 2000).
    static std::vector<GaussPoint<3>> mass_rule() {
        std::vector<GaussPoint<3>> rule;
        for (const auto& [a, w] : {std::array{0.31088591926330060980, 0.11268792571801585080 / 6},
                                   std::array{0.092735250310891226402, 0.073493043116361949544 / 6}}) {
            const double b = 1 - 3 * a;
            for (const auto& xi : {std::array{a, a, a}, std::array{b, a, a}, std::array{a, b, a}, std::array{a, a, b}})
                rule.push_back({xi, w});
        }
        const double a = 0.045503704125649649492, b = 0.5 - a, w = 0.042546020777081466438 / 6;
        for (const auto& xi : {std::array{a, a, b}, std::array{a, b, a}, std::array{b, a, a}, std::array{a, b, b},
                               std::array{b, a, b}, std::array{b, b, a}})
            rule.push_back({xi, w});
        return rule;
    }

    static std::vector<std::vector<int>> sides() {
        return {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}};
    }
};

}  // namespace aquagraph::solid
