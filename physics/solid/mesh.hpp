// The mesh of a solid in D dimensions: elements, and named sets of nodes, elements and boundary facets.
//
// An element is its list of nodes; their number says its type:
//   D = 2: 4 or 8 nodes, quadrilaterals;   D = 3: 8 or 20 nodes, hexahedra; 10 nodes, tetrahedra.
// Corners come first, then the nodes in the middle of the edges, in the order of Abaqus, CalculiX and VTK:
//   quadrilateral  corners counter-clockwise; edges 01 12 23 30
//   hexahedron     corners of the bottom counter-clockwise as seen from the top, those of the top above them; edges
//                  01 12 23 30, 45 56 67 74, 04 15 26 37
//   tetrahedron    corners 0 1 2 counter-clockwise as seen from 3; edges 01 12 20 03 13 23
// A facet is one side of an element on the boundary. D = 2: first corner, second corner and, if the element is
// quadratic, the node between them, with the solid on the left. D = 3: corners counter-clockwise as seen from outside,
// then mid-side nodes: 4, 8, or 6 nodes.
#pragma once
#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace aquagraph::solid {

// A mesh that cannot be used. The message says which element, node or line of the file, and how to mend it.
class MeshError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

using NodeIndex = int;
using ElementIndex = int;

// A few nodes, without a heap.
template <std::size_t Most>
class NodeList {
  public:
    NodeList() = default;
    NodeList(std::initializer_list<NodeIndex> nodes) {
        for (const NodeIndex node : nodes) push_back(node);
    }
    void push_back(NodeIndex node) { nodes_[count_++] = node; }

    std::size_t size() const { return count_; }
    NodeIndex& operator[](std::size_t k) { return nodes_[k]; }
    NodeIndex operator[](std::size_t k) const { return nodes_[k]; }
    NodeIndex* begin() { return nodes_.data(); }
    NodeIndex* end() { return nodes_.data() + count_; }
    const NodeIndex* begin() const { return nodes_.data(); }
    const NodeIndex* end() const { return nodes_.data() + count_; }

    friend bool operator==(const NodeList& a, const NodeList& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }
    friend bool operator<(const NodeList& a, const NodeList& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }

  private:
    std::array<NodeIndex, Most> nodes_{};
    std::size_t count_ = 0;
};

using Element = NodeList<20>;
using Facet = NodeList<8>;

template <int D>
struct Mesh {
    std::vector<std::array<double, D>> nodes;  // reference coordinates X [m]
    std::vector<Element> elements;
    std::map<std::string, std::vector<NodeIndex>> node_sets;        // ascending, without repetition
    std::map<std::string, std::vector<ElementIndex>> element_sets;  // ascending, without repetition
    std::map<std::string, std::vector<Facet>> surfaces;             // D = 2: along the boundary where the edges join

    // The set of this name. Throws std::invalid_argument, naming the sets that exist.
    const std::vector<NodeIndex>& node_set(const std::string& name) const;
    const std::vector<ElementIndex>& element_set(const std::string& name) const;
    const std::vector<Facet>& surface(const std::string& name) const;
};

// The rectangle from min to max [m] in eight-node quadrilaterals, columns × rows, mid-side nodes in the middle. Node
// sets and surfaces: left, right, bottom, top. Throws std::invalid_argument for an empty box or fewer than one element.
Mesh<2> box_mesh(std::array<double, 2> min, std::array<double, 2> max, int columns, int rows);

// The same in three dimensions in hexahedra of 20 nodes; sets also front (least y) and back, left and right along x,
// bottom and top along z.
Mesh<3> box_mesh(std::array<double, 3> min, std::array<double, 3> max, std::array<int, 3> elements);

// The mesh without its mid-side nodes: elements of 4 or 8 nodes. Throws std::invalid_argument for tetrahedra.
template <int D>
Mesh<D> without_mid_side_nodes(const Mesh<D>& quadratic);

// Throws MeshError, with the index of the culprit (from 0), unless there is at least one element, all elements are of
// types that there are, right-handed with a positive Jacobian at their corners and Gauss points, every node is used by
// an element and is a finite point, and every facet of a surface is a side of exactly one element, facing out.
template <int D>
void check(const Mesh<D>& mesh);

// What is wrong with one element's nodes or shape, as the end of a sentence that begins with its name; empty if
// nothing.
template <int D>
std::string element_fault(const Mesh<D>& mesh, std::size_t element);

// The sides of an element, in the order of its type.
template <int D>
std::vector<Facet> sides(const Element& element);

// The sides that belong to one element only: the whole boundary, by element and side. `owner`, if given, becomes the
// element of each.
template <int D>
std::vector<Facet> boundary_facets(const Mesh<D>& mesh, std::vector<ElementIndex>* owner = nullptr);

// Corners of a facet: 2 in the plane; 4 or 3.
template <int D>
std::size_t corner_count(const Facet& facet);

// Reorders edges so that each begins where the one before it ended, as far as they join; open chains start at the
// edge that nothing precedes, closed ones at the first given. Throws MeshError if two edges start at one node.
std::vector<Facet> chain(const std::vector<Facet>& edges);

}  // namespace aquagraph::solid
