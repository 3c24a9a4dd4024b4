// The mesh of a plane solid: eight-node (serendipity) quadrilaterals, and named sets of nodes and of boundary edges.
#pragma once
#include <array>
#include <cstddef>
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

// One edge of an element on the boundary: first corner, second corner, mid-side node, in the order in which one walks
// counter-clockwise around the body. The solid is on the left; the normal that points out of it is on the right.
using SurfaceEdge = std::array<NodeIndex, 3>;

// Four corners counter-clockwise, then the mid-side nodes of the edges 0-1, 1-2, 2-3, 3-0.
using Quad8Nodes = std::array<NodeIndex, 8>;

struct Mesh {
    std::vector<std::array<double, 2>> nodes;  // reference coordinates X [m]
    std::vector<Quad8Nodes> elements;
    std::map<std::string, std::vector<NodeIndex>> node_sets;   // ascending, without repetition
    std::map<std::string, std::vector<SurfaceEdge>> surfaces;  // along the boundary where the edges join

    // The set of this name. Throws std::invalid_argument, naming the sets that exist.
    const std::vector<NodeIndex>& node_set(const std::string& name) const;
    const std::vector<SurfaceEdge>& surface(const std::string& name) const;
};

// The rectangle from min to max [m], columns × rows elements, straight edges, mid-side nodes in the middle. Node sets
// and surfaces: left, right, bottom, top. Throws std::invalid_argument for an empty box or fewer than one element.
Mesh box_mesh(std::array<double, 2> min, std::array<double, 2> max, int columns, int rows);

// Throws MeshError, with the index of the culprit (from 0), unless there is at least one element, every element is
// counter-clockwise with a positive Jacobian at its Gauss points and corners, every node is used by an element and
// is a finite point, and every edge of a surface is a boundary edge of exactly one element, solid on the left.
void check(const Mesh& mesh);

// What is wrong with one element's nodes or shape, as the end of a sentence that begins with its name; empty if
// nothing.
std::string element_fault(const Mesh& mesh, std::size_t element);

// The edges of elements that belong to one element only: the whole boundary, solid on the left, by element and side.
std::vector<SurfaceEdge> boundary_edges(const Mesh& mesh);

// Reorders edges so that each begins where the one before it ended, as far as they join; open chains start at the
// edge that nothing precedes, closed ones at the first given. Throws MeshError if two edges start at one node.
std::vector<SurfaceEdge> chain(const std::vector<SurfaceEdge>& edges);

}  // namespace aquagraph::solid
