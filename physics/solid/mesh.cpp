#include "physics/solid/mesh.hpp"

#include <cmath>
#include <map>
#include <set>

#include "physics/solid/elements/dispatch.hpp"

namespace aquagraph::solid {

namespace {

template <class Sets>
const typename Sets::mapped_type& find_set(const Sets& sets, const std::string& name, const std::string& kind) {
    const auto found = sets.find(name);
    if (found != sets.end()) return found->second;
    std::string known;
    for (const auto& [other, content] : sets) known += (known.empty() ? "" : ", ") + other;
    throw std::invalid_argument("the mesh has no " + kind + " '" + name +
                                "'; it has: " + (known.empty() ? "none" : known));
}

// The corners of a facet in ascending order: the same for both elements that share it.
template <int D>
Facet key(const Facet& facet) {
    Facet corners;
    for (std::size_t k = 0; k < corner_count<D>(facet); ++k) {
        corners.push_back(facet[k]);
        for (std::size_t j = k; j > 0 && corners[j] < corners[j - 1]; --j) std::swap(corners[j], corners[j - 1]);
    }
    return corners;
}

const std::vector<std::vector<int>>& local_sides(int dimension, std::size_t nodes) {
    static const std::map<std::pair<int, std::size_t>, std::vector<std::vector<int>>> tables{{{2, 4}, Quad4::sides()},
                                                                                             {{2, 8}, Quad8::sides()},
                                                                                             {{3, 8}, Hex8::sides()},
                                                                                             {{3, 20}, Hex20::sides()},
                                                                                             {{3, 10}, Tet10::sides()}};
    return tables.at({dimension, nodes});
}

}  // namespace

template <int D>
const std::vector<NodeIndex>& Mesh<D>::node_set(const std::string& name) const {
    return find_set(node_sets, name, "node set");
}

template <int D>
const std::vector<ElementIndex>& Mesh<D>::element_set(const std::string& name) const {
    return find_set(element_sets, name, "element set");
}

template <int D>
const std::vector<Facet>& Mesh<D>::surface(const std::string& name) const {
    return find_set(surfaces, name, "surface");
}

template <int D>
std::size_t corner_count(const Facet& facet) {
    if constexpr (D == 2) return 2;
    return facet.size() == 6 || facet.size() == 3 ? 3 : 4;
}

template <int D>
std::vector<Facet> sides(const Element& element) {
    std::vector<Facet> all;
    for (const auto& side : local_sides(D, element.size())) {
        Facet& facet = all.emplace_back();
        for (const int a : side) facet.push_back(element[std::size_t(a)]);
    }
    return all;
}

template <int D>
std::vector<Facet> boundary_facets(const Mesh<D>& mesh, std::vector<ElementIndex>* owner) {
    std::map<Facet, int> uses;
    for (const Element& element : mesh.elements)
        for (const Facet& facet : sides<D>(element)) ++uses[key<D>(facet)];
    std::vector<Facet> boundary;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        for (const Facet& facet : sides<D>(mesh.elements[e]))
            if (uses.at(key<D>(facet)) == 1) {
                boundary.push_back(facet);
                if (owner != nullptr) owner->push_back(ElementIndex(e));
            }
    return boundary;
}

std::vector<Facet> chain(const std::vector<Facet>& edges) {
    std::map<NodeIndex, std::size_t> starting_at;
    std::set<NodeIndex> ends;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        if (!starting_at.emplace(edges[k][0], k).second)
            throw MeshError("two edges of a surface start at node " + std::to_string(edges[k][0]) +
                            "; split the surface where it branches");
        ends.insert(edges[k][1]);
    }
    std::vector<Facet> ordered;
    std::vector<bool> taken(edges.size(), false);
    const auto follow = [&](std::size_t k) {
        while (!taken[k]) {
            taken[k] = true;
            ordered.push_back(edges[k]);
            const auto next = starting_at.find(edges[k][1]);
            if (next == starting_at.end()) return;
            k = next->second;
        }
    };
    for (std::size_t k = 0; k < edges.size(); ++k)
        if (!ends.contains(edges[k][0])) follow(k);
    for (std::size_t k = 0; k < edges.size(); ++k) follow(k);
    return ordered;
}

template <int D>
std::string element_fault(const Mesh<D>& mesh, std::size_t e) {
    const Element& element = mesh.elements[e];
    if (!is_element_type<D>(element.size()))
        return "has " + std::to_string(element.size()) + " nodes; there are elements of " +
               (D == 2 ? "4 and 8" : "8, 10 and 20");
    for (const NodeIndex a : element)
        if (a < 0 || static_cast<std::size_t>(a) >= mesh.nodes.size())
            return "has node " + std::to_string(a) + ", but there are " + std::to_string(mesh.nodes.size()) + " nodes";
    if (std::set<NodeIndex>(element.begin(), element.end()).size() != element.size()) return "has a node twice";
    double smallest = INFINITY, largest = -INFINITY;
    with_element_type<D>(element.size(), [&]<class Type>(Type) {
        const auto X = coordinates<Type>(mesh, element);
        const auto look = [&](const std::array<double, D>& xi) {
            const double J = reference_gradients(Type::shape(xi), X).jacobian;
            smallest = J < smallest || std::isnan(J) ? J : smallest;
            largest = std::max(largest, J);
        };
        for (std::size_t a = 0; a < Type::corner_count; ++a) look(Type::parent_nodes[a]);
        for (const auto& point : Type::mass_rule()) look(point.xi);
    });
    if (largest < 0)
        return D == 2 ? "is numbered clockwise; number its corners counter-clockwise"
                      : "is numbered inside out; number its bottom counter-clockwise as seen from its top";
    if (!(smallest > 0))
        return "is inverted or has no " + std::string(D == 2 ? "area" : "volume") + ": its Jacobian falls to " +
               std::to_string(smallest) + "; move its nodes so that all its angles stay below 180 degrees";
    return {};
}

template <int D>
void check(const Mesh<D>& mesh) {
    if (mesh.elements.empty()) throw MeshError("the mesh of the solid has no element");
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        if (const std::string fault = element_fault(mesh, e); !fault.empty())
            throw MeshError("element " + std::to_string(e) + " " + fault);
    for (const Element& element : mesh.elements)
        if (element.size() != mesh.elements[0].size())
            throw MeshError("elements of " + std::to_string(mesh.elements[0].size()) + " and of " +
                            std::to_string(element.size()) + " nodes are mixed; mesh all with one type");
    std::vector<bool> used(mesh.nodes.size(), false);
    for (const Element& element : mesh.elements)
        for (const NodeIndex a : element) used[static_cast<std::size_t>(a)] = true;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
        const std::string who = "node " + std::to_string(a);
        if (!used[a]) throw MeshError(who + " is dangling: it belongs to no element");
        for (const double x : mesh.nodes[a])
            if (!std::isfinite(x)) throw MeshError(who + " has no finite coordinates");
    }
    for (const auto& [name, set] : mesh.node_sets)
        for (const NodeIndex a : set)
            if (a < 0 || static_cast<std::size_t>(a) >= mesh.nodes.size())
                throw MeshError("node set '" + name + "' has node " + std::to_string(a) + ", which does not exist");
    for (const auto& [name, set] : mesh.element_sets)
        for (const ElementIndex e : set)
            if (e < 0 || static_cast<std::size_t>(e) >= mesh.elements.size())
                throw MeshError("element set '" + name + "' has element " + std::to_string(e) +
                                ", which does not exist");
    if (mesh.surfaces.empty()) return;
    // The same facet may begin at any of its corners; which way round it goes is kept.
    const auto turned = [](Facet facet) {
        const std::size_t corners = corner_count<D>(facet);
        if (D == 2) return facet;
        std::size_t first = 0;
        for (std::size_t k = 1; k < corners; ++k)
            if (facet[k] < facet[first]) first = k;
        Facet result;
        for (std::size_t part = 0; part < facet.size(); part += corners)
            for (std::size_t k = 0; k < corners; ++k) result.push_back(facet[part + (first + k) % corners]);
        return result;
    };
    std::set<Facet> known;
    for (const Facet& facet : boundary_facets(mesh)) known.insert(turned(facet));
    for (const auto& [name, facets] : mesh.surfaces)
        for (const Facet& facet : facets)
            if (!known.contains(turned(facet)))
                throw MeshError("surface '" + name + "': the " + (D == 2 ? "edge" : "face") + " from node " +
                                std::to_string(facet[0]) + " to " + std::to_string(facet[1]) +
                                (D == 2 ? " is not on the boundary with the solid on its left"
                                        : " is not on the boundary, facing out of the solid"));
}

#define AQUAGRAPH_INSTANTIATE(D)                                                             \
    template struct Mesh<D>;                                                                 \
    template std::size_t corner_count<D>(const Facet&);                                      \
    template std::vector<Facet> sides<D>(const Element&);                                    \
    template std::vector<Facet> boundary_facets(const Mesh<D>&, std::vector<ElementIndex>*); \
    template std::string element_fault(const Mesh<D>&, std::size_t);                         \
    template void check(const Mesh<D>&);
AQUAGRAPH_INSTANTIATE(2)
AQUAGRAPH_INSTANTIATE(3)
#undef AQUAGRAPH_INSTANTIATE

}  // namespace aquagraph::solid
