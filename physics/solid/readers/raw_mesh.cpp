#include "physics/solid/readers/raw_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace aquagraph::solid {

namespace {

using Edge = std::pair<NodeIndex, NodeIndex>;

// Local corners of the edges that carry nodes, in the order of mesh.hpp, by the number of corners.
const std::vector<std::pair<std::size_t, std::size_t>>& edges_of(int dimension, std::size_t corners) {
    static const std::vector<std::pair<std::size_t, std::size_t>> line{{0, 1}}, triangle{{0, 1}, {1, 2}, {2, 0}},
        quadrilateral{{0, 1}, {1, 2}, {2, 3}, {3, 0}}, tetrahedron{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
        hexahedron{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    if (dimension == 1) return line;
    if (dimension == 2) return corners == 3 ? triangle : quadrilateral;
    return corners == 4 ? tetrahedron : hexahedron;
}

const char* name_of(int dimension, std::size_t nodes) {
    if (dimension == 1) return "line element";
    if (dimension == 2) return nodes % 3 == 0 ? "triangle" : "quadrilateral";
    return nodes == 4 || nodes == 10 ? "tetrahedron" : "hexahedron";
}

bool linear(const RawElement& element) {
    const std::size_t n = element.nodes.size();
    return element.dimension == 3 ? n == 4 || n == 8 : n == std::size_t(element.dimension == 2 ? 4 : 2);
}

[[noreturn]] void fail(const std::string& source, const std::string& message) {
    throw MeshError(source + ": " + message);
}

// One node in the middle of each edge, shared by all elements that have the edge.
template <int D>
void add_mid_side_nodes(RawMesh& raw) {
    std::map<Edge, NodeIndex> middle;
    for (RawElement& element : raw.elements) {
        if (element.dimension != D || !linear(element)) continue;
        for (const auto& [p, q] : edges_of(D, element.nodes.size())) {
            const NodeIndex a = element.nodes[p], b = element.nodes[q];
            const auto [found, made] = middle.emplace(std::minmax(a, b), NodeIndex(raw.nodes.size()));
            if (made) {
                std::array<double, 3> x;
                for (std::size_t d = 0; d < 3; ++d)
                    x[d] = 0.5 * (raw.nodes[std::size_t(a)][d] + raw.nodes[std::size_t(b)][d]);
                raw.nodes.push_back(x);
                raw.node_tags.push_back(0);
                raw.may_be_unused.push_back(false);
            }
            element.nodes.push_back(found->second);
        }
    }
}

// Numbers only the nodes that elements of dimension D use; those of other elements become -1.
template <int D>
void drop_unused_nodes(RawMesh& raw, const std::string& source) {
    std::vector<bool> used(raw.nodes.size(), false);
    for (const RawElement& element : raw.elements)
        if (element.dimension == D)
            for (const NodeIndex a : element.nodes) used[std::size_t(a)] = true;
    std::vector<NodeIndex> number(raw.nodes.size(), -1);
    NodeIndex next = 0;
    for (std::size_t a = 0; a < used.size(); ++a) {
        if (!used[a] && !raw.may_be_unused[a])
            fail(source, "node " + std::to_string(raw.node_tags[a]) + " is dangling: it belongs to no " +
                             (D == 2 ? "quadrilateral" : "element of three dimensions"));
        if (!used[a]) continue;
        raw.nodes[std::size_t(next)] = raw.nodes[a];
        number[a] = next++;
    }
    raw.nodes.resize(std::size_t(next));
    for (RawElement& element : raw.elements)
        for (NodeIndex& a : element.nodes) a = number[std::size_t(a)];
}

// The first so many nodes in ascending order.
Facet ascending(const NodeIndex* nodes, std::size_t count) {
    Facet sorted;
    for (std::size_t k = 0; k < count; ++k) {
        sorted.push_back(nodes[k]);
        for (std::size_t j = k; j > 0 && sorted[j] < sorted[j - 1]; --j) std::swap(sorted[j], sorted[j - 1]);
    }
    return sorted;
}

template <int D>
void make_sets(const RawMesh& raw, const std::string& source, Mesh<D>& mesh) {
    std::map<std::string, std::set<NodeIndex>> nodes;
    std::map<Facet, std::pair<Facet, int>> sides_of_all;  // by corners; with the number of its elements
    for (const Element& element : mesh.elements)
        for (const Facet& side : sides<D>(element))
            ++sides_of_all.emplace(ascending(side.begin(), corner_count<D>(side)), std::pair{side, 0})
                  .first->second.second;
    ElementIndex index = 0;
    for (const RawElement& element : raw.elements) {
        if (element.dimension == D) {
            for (const std::string& name : element.groups) {
                mesh.element_sets[name].push_back(index);
                nodes[name].insert(element.nodes.begin(), element.nodes.end());
            }
            ++index;
        } else if (element.dimension == D - 1) {
            if (element.groups.empty()) continue;
            const std::size_t n = element.nodes.size(), count = D == 2 ? 2 : n == 3 || n == 6 ? 3 : 4;
            const auto found = sides_of_all.find(ascending(element.nodes.begin(), count));
            for (const std::string& name : element.groups) {
                if (found == sides_of_all.end())
                    fail(source, std::string(name_of(element.dimension, n)) + " " + std::to_string(element.tag) +
                                     " of '" + name + "' is not " +
                                     (D == 2 ? "an edge of a quadrilateral" : "a side of an element"));
                const auto& [side, uses] = found->second;
                nodes[name].insert(side.begin(), side.end());
                if (uses == 1) mesh.surfaces[name].push_back(side);
            }
        } else {
            for (const std::string& name : element.groups)
                for (const NodeIndex a : element.nodes)
                    if (a >= 0) nodes[name].insert(a);
        }
    }
    for (const auto& [name, set] : nodes) mesh.node_sets[name].assign(set.begin(), set.end());
    if constexpr (D == 2)
        for (auto& [name, edges] : mesh.surfaces) edges = chain(edges);
}

}  // namespace

template <int D>
Mesh<D> make_mesh(RawMesh raw, MeshOrder order, const std::string& source) {
    bool has_linear = false, has_quadratic = false;
    for (const RawElement& element : raw.elements) {
        if (element.dimension > D)
            fail(source, "element " + std::to_string(element.tag) + " is a " +
                             name_of(element.dimension, element.nodes.size()) + ", and the scene is two-dimensional");
        if (element.dimension == D) (linear(element) ? has_linear : has_quadratic) = true;
        if (element.dimension == D && element.nodes.size() == 4 && D == 3 && order == MeshOrder::linear)
            fail(source, "element " + std::to_string(element.tag) +
                             " is a tetrahedron of four nodes, which would be far too stiff: leave `order = 1` out");
    }
    if (has_linear && has_quadratic)
        fail(source, std::string(D == 2 ? "4-node and 8-node quadrilaterals"
                                        : "elements with and without nodes on "
                                          "their edges") +
                         " are mixed; mesh all with Mesh.ElementOrder=2");
    if (!has_linear && !has_quadratic)
        fail(source, D == 2 ? "there is no quadrilateral; put the surface in a physical group"
                            : "there is no element of three dimensions; put the volume in a physical group");
    if (has_quadratic && order == MeshOrder::linear)
        fail(source, "its elements have nodes on their edges: leave `order = 1` out, or mesh with Mesh.ElementOrder=1");
    if constexpr (D == 2)
        for (std::size_t a = 0; a < raw.nodes.size(); ++a)
            if (raw.nodes[a][2] != raw.nodes[0][2])
                fail(source,
                     "node " + std::to_string(raw.node_tags[a]) + " lies off the plane of the others (z differs)");
    if (has_linear && order == MeshOrder::quadratic) add_mid_side_nodes<D>(raw);
    drop_unused_nodes<D>(raw, source);
    Mesh<D> mesh;
    for (const auto& X : raw.nodes) {
        auto& x = mesh.nodes.emplace_back();
        std::copy_n(X.begin(), D, x.begin());
    }
    std::vector<int> tags;
    for (const RawElement& element : raw.elements)
        if (element.dimension == D) {
            mesh.elements.push_back(element.nodes);
            tags.push_back(element.tag);
        }
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        if (const std::string fault = element_fault(mesh, e); !fault.empty())
            fail(source, "element " + std::to_string(tags[e]) + " " + fault);
    make_sets(raw, source, mesh);
    check(mesh);
    return mesh;
}

template Mesh<2> make_mesh(RawMesh, MeshOrder, const std::string&);
template Mesh<3> make_mesh(RawMesh, MeshOrder, const std::string&);

}  // namespace aquagraph::solid
