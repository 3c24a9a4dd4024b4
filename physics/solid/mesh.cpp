#include "physics/solid/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "physics/solid/elements/quad8.hpp"

namespace aquagraph::solid {

namespace {

// Corners of side s of an element and its mid-side node, solid on the left.
SurfaceEdge side(const Quad8Nodes& element, std::size_t s) {
    return {element[s], element[(s + 1) % 4], element[4 + s]};
}

template <class Sets>
const typename Sets::mapped_type& find_set(const Sets& sets, const std::string& name, const std::string& kind) {
    const auto found = sets.find(name);
    if (found != sets.end()) return found->second;
    std::string known;
    for (const auto& [other, content] : sets) known += (known.empty() ? "" : ", ") + other;
    throw std::invalid_argument("the mesh has no " + kind + " '" + name +
                                "'; it has: " + (known.empty() ? "none" : known));
}

}  // namespace

const std::vector<NodeIndex>& Mesh::node_set(const std::string& name) const {
    return find_set(node_sets, name, "node set");
}

const std::vector<SurfaceEdge>& Mesh::surface(const std::string& name) const {
    return find_set(surfaces, name, "surface");
}

Mesh box_mesh(std::array<double, 2> min, std::array<double, 2> max, int columns, int rows) {
    if (!(max[0] > min[0] && max[1] > min[1])) throw std::invalid_argument("the box of the solid is empty");
    if (columns < 1 || rows < 1)
        throw std::invalid_argument("the box of the solid needs at least one element each way");
    Mesh mesh;
    const int width = 2 * columns + 1,
              height = 2 * rows + 1;  // points of the half-spaced grid; cell centres carry no node
    std::vector<NodeIndex> number(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -1);
    const auto at = [&](int i, int j) -> NodeIndex& {
        return number[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
    };
    // Column by column: neighbours in a long horizontal beam stay close in memory.
    for (int i = 0; i < width; ++i)
        for (int j = 0; j < height; ++j) {
            if (i % 2 == 1 && j % 2 == 1) continue;
            at(i, j) = static_cast<NodeIndex>(mesh.nodes.size());
            const double s = static_cast<double>(i) / (width - 1), t = static_cast<double>(j) / (height - 1);
            mesh.nodes.push_back({min[0] + s * (max[0] - min[0]), min[1] + t * (max[1] - min[1])});
            if (i == 0) mesh.node_sets["left"].push_back(at(i, j));
            if (i == width - 1) mesh.node_sets["right"].push_back(at(i, j));
            if (j == 0) mesh.node_sets["bottom"].push_back(at(i, j));
            if (j == height - 1) mesh.node_sets["top"].push_back(at(i, j));
        }
    for (int i = 0; i < 2 * columns; i += 2)
        for (int j = 0; j < 2 * rows; j += 2)
            mesh.elements.push_back({at(i, j), at(i + 2, j), at(i + 2, j + 2), at(i, j + 2), at(i + 1, j),
                                     at(i + 2, j + 1), at(i + 1, j + 2), at(i, j + 1)});
    for (int i = 0; i < 2 * columns; i += 2) mesh.surfaces["bottom"].push_back({at(i, 0), at(i + 2, 0), at(i + 1, 0)});
    for (int j = 0; j < 2 * rows; j += 2)
        mesh.surfaces["right"].push_back({at(width - 1, j), at(width - 1, j + 2), at(width - 1, j + 1)});
    for (int i = 2 * columns; i > 0; i -= 2)
        mesh.surfaces["top"].push_back({at(i, height - 1), at(i - 2, height - 1), at(i - 1, height - 1)});
    for (int j = 2 * rows; j > 0; j -= 2) mesh.surfaces["left"].push_back({at(0, j), at(0, j - 2), at(0, j - 1)});
    return mesh;
}

std::vector<SurfaceEdge> boundary_edges(const Mesh& mesh) {
    std::map<std::pair<NodeIndex, NodeIndex>, int> uses;
    for (const Quad8Nodes& element : mesh.elements)
        for (std::size_t s = 0; s < 4; ++s) {
            const SurfaceEdge edge = side(element, s);
            ++uses[std::minmax(edge[0], edge[1])];
        }
    std::vector<SurfaceEdge> boundary;
    for (const Quad8Nodes& element : mesh.elements)
        for (std::size_t s = 0; s < 4; ++s) {
            const SurfaceEdge edge = side(element, s);
            if (uses.at(std::minmax(edge[0], edge[1])) == 1) boundary.push_back(edge);
        }
    return boundary;
}

std::vector<SurfaceEdge> chain(const std::vector<SurfaceEdge>& edges) {
    std::map<NodeIndex, std::size_t> starting_at;
    std::set<NodeIndex> ends;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        if (!starting_at.emplace(edges[k][0], k).second)
            throw MeshError("two edges of a surface start at node " + std::to_string(edges[k][0]) +
                            "; split the surface where it branches");
        ends.insert(edges[k][1]);
    }
    std::vector<SurfaceEdge> ordered;
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

std::string element_fault(const Mesh& mesh, std::size_t e) {
    const Quad8Nodes& element = mesh.elements[e];
    for (const NodeIndex a : element)
        if (a < 0 || static_cast<std::size_t>(a) >= mesh.nodes.size())
            return "has node " + std::to_string(a) + ", but there are " + std::to_string(mesh.nodes.size()) + " nodes";
    if (std::set<NodeIndex>(element.begin(), element.end()).size() != element.size()) return "has a node twice";
    const auto X = quad8::coordinates(mesh, element);
    double smallest = INFINITY, largest = -INFINITY;
    const auto look = [&](double xi, double eta) {
        const double J = quad8::reference_gradients(quad8::shape(xi, eta), X).jacobian;
        smallest = std::min(smallest, J);
        largest = std::max(largest, J);
    };
    for (std::size_t a = 0; a < 4; ++a) look(quad8::parent_nodes[a][0], quad8::parent_nodes[a][1]);
    for (const auto& point : quad8::full_rule) look(point.xi, point.eta);
    if (largest < 0) return "is numbered clockwise; number its corners counter-clockwise";
    if (!(smallest > 0))
        return "is inverted or has no area: its Jacobian falls to " + std::to_string(smallest) +
               "; move its nodes so that all its angles stay below 180 degrees";
    return {};
}

void check(const Mesh& mesh) {
    if (mesh.elements.empty()) throw MeshError("the mesh of the solid has no element");
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        if (const std::string fault = element_fault(mesh, e); !fault.empty())
            throw MeshError("element " + std::to_string(e) + " " + fault);
    std::vector<bool> used(mesh.nodes.size(), false);
    for (const Quad8Nodes& element : mesh.elements)
        for (const NodeIndex a : element) used[static_cast<std::size_t>(a)] = true;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
        const std::string who = "node " + std::to_string(a);
        if (!used[a]) throw MeshError(who + " is dangling: it belongs to no element");
        if (!std::isfinite(mesh.nodes[a][0]) || !std::isfinite(mesh.nodes[a][1]))
            throw MeshError(who + " has no finite coordinates");
    }
    for (const auto& [name, set] : mesh.node_sets)
        for (const NodeIndex a : set)
            if (a < 0 || static_cast<std::size_t>(a) >= mesh.nodes.size())
                throw MeshError("node set '" + name + "' has node " + std::to_string(a) + ", which does not exist");
    const std::vector<SurfaceEdge> boundary = boundary_edges(mesh);
    const std::set<SurfaceEdge> known(boundary.begin(), boundary.end());
    for (const auto& [name, edges] : mesh.surfaces)
        for (const SurfaceEdge& edge : edges)
            if (!known.contains(edge))
                throw MeshError("surface '" + name + "': the edge from node " + std::to_string(edge[0]) + " to " +
                                std::to_string(edge[1]) + " is not on the boundary with the solid on its left");
}

}  // namespace aquagraph::solid
