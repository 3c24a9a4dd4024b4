// Shape functions and Gauss points of the sides of elements, as facets of mesh.hpp: edges of 2 or 3 nodes in the plane,
// quadrilaterals of 4 or 8 and triangles of 6 nodes in space.
#pragma once
#include <stdexcept>
#include <string>

#include "physics/solid/elements/serendipity.hpp"

namespace aquagraph::solid {

// Corners at ±1, first the one at -1; the third node of a quadratic edge is at 0.
template <std::size_t Nodes>
struct EdgeFacet {
    static constexpr std::size_t node_count = Nodes;
    static Shape<1, Nodes> shape(const std::array<double, 1>& xi) {
        const double s = xi[0];
        Shape<1, Nodes> shape;
        if constexpr (Nodes == 2) {
            shape.N = {0.5 * (1 - s), 0.5 * (1 + s)};
            shape.dN = {{{-0.5}, {0.5}}};
        } else {
            shape.N = {0.5 * s * (s - 1), 0.5 * s * (s + 1), 1 - s * s};
            shape.dN = {{{s - 0.5}, {s + 0.5}, {-2 * s}}};
        }
        return shape;
    }
    static std::vector<GaussPoint<1>> rule() { return gauss_legendre(3); }
};

template <class Quadrilateral>
struct QuadrilateralFacet {
    static constexpr std::size_t node_count = Quadrilateral::node_count;
    static auto shape(const std::array<double, 2>& xi) { return Quadrilateral::shape(xi); }
    static std::vector<GaussPoint<2>> rule() { return product_rule<2>(3); }
};

// L_0 = 1 - ξ - η, L_1 = ξ, L_2 = η; middles of 01, 12, 20.
struct TriangleFacet {
    static constexpr std::size_t node_count = 6;
    static Shape<2, 6> shape(const std::array<double, 2>& xi) {
        const double L[3] = {1 - xi[0] - xi[1], xi[0], xi[1]};
        constexpr double dL[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
        Shape<2, 6> s;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3;
            s.N[a] = L[a] * (2 * L[a] - 1);
            s.N[3 + a] = 4 * L[a] * L[b];
            for (std::size_t k = 0; k < 2; ++k) {
                s.dN[a][k] = (4 * L[a] - 1) * dL[a][k];
                s.dN[3 + a][k] = 4 * (dL[a][k] * L[b] + L[a] * dL[b][k]);
            }
        }
        return s;
    }
    // Six points, fourth degree (Dunavant, Int. J. Numer. Meth. Eng. 21, 1985).
    static std::vector<GaussPoint<2>> rule() {
        std::vector<GaussPoint<2>> points;
        for (const auto& [a, w] : {std::array{0.445948490915965, 0.223381589678011 / 2},
                                   std::array{0.091576213509771, 0.109951743655322 / 2}}) {
            const double b = 1 - 2 * a;
            for (const auto& xi : {std::array{a, a}, std::array{b, a}, std::array{a, b}}) points.push_back({xi, w});
        }
        return points;
    }
};

// Calls f(type) with an object of the facet's type. Throws std::invalid_argument for a number of nodes that no facet
// has.
template <int D, class F>
decltype(auto) with_facet_type(std::size_t nodes, const F& f) {
    if constexpr (D == 2) {
        if (nodes == 2) return f(EdgeFacet<2>{});
        if (nodes == 3) return f(EdgeFacet<3>{});
    } else {
        if (nodes == 4) return f(QuadrilateralFacet<Quad4>{});
        if (nodes == 8) return f(QuadrilateralFacet<Quad8>{});
        if (nodes == 6) return f(TriangleFacet{});
    }
    throw std::invalid_argument("no side of an element has " + std::to_string(nodes) + " nodes");
}

}  // namespace aquagraph::solid
