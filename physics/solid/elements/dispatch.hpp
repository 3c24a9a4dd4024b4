// From the number of nodes of an element, known when a mesh is read, to its type, known to the compiler.
#pragma once
#include <stdexcept>
#include <string>

#include "physics/solid/elements/serendipity.hpp"
#include "physics/solid/elements/tetrahedron.hpp"

namespace aquagraph::solid {

template <int D>
constexpr bool is_element_type(std::size_t node_count) {
    return D == 2 ? node_count == 4 || node_count == 8 : node_count == 8 || node_count == 10 || node_count == 20;
}

// Calls f(Type{}) with the element type of this many nodes. Throws std::invalid_argument if there is none.
template <int D, class F>
decltype(auto) with_element_type(std::size_t node_count, const F& f) {
    if constexpr (D == 2) {
        if (node_count == 4) return f(Quad4{});
        if (node_count == 8) return f(Quad8{});
    } else {
        if (node_count == 8) return f(Hex8{});
        if (node_count == 10) return f(Tet10{});
        if (node_count == 20) return f(Hex20{});
    }
    throw std::invalid_argument("there is no element of " + std::to_string(node_count) + " nodes in " +
                                std::to_string(D) + " dimensions");
}

template <class Type>
auto coordinates(const auto& mesh, const auto& element) {
    std::array<std::array<double, Type::dimension>, Type::node_count> X;
    for (std::size_t a = 0; a < Type::node_count; ++a) X[a] = mesh.nodes[static_cast<std::size_t>(element[a])];
    return X;
}

}  // namespace aquagraph::solid
