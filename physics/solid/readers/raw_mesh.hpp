// What a mesh file holds, before it is a mesh: nodes with the file's numbers, elements of all dimensions with the names
// of their groups. Both readers of Gmsh's formats fill it.
#pragma once
#include <array>
#include <map>
#include <string>
#include <vector>

#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

// Of a mesh whose elements have no nodes on their edges: 2 puts them there, in the middle, 1 leaves it so.
enum class MeshOrder { linear = 1, quadratic = 2 };

struct RawElement {
    int tag = 0, dimension = 0;
    Element nodes;                    // in the order of mesh.hpp
    std::vector<std::string> groups;  // names
};

struct RawMesh {
    std::vector<std::array<double, 3>> nodes;
    std::vector<int> node_tags;
    std::vector<bool> may_be_unused;  // a point that the geometry needs and the mesh does not
    std::map<int, NodeIndex> index;   // tag -> index
    std::vector<RawElement> elements;
};

// Elements of dimension D become those of the mesh, their groups element sets and node sets; those of dimension D - 1
// surfaces and node sets, inside the body node sets only; the rest node sets. Nodes that no element of dimension D has
// are dropped where they may be, refused where not. source: what messages call the file. Throws MeshError.
template <int D>
Mesh<D> make_mesh(RawMesh raw, MeshOrder order, const std::string& source);

}  // namespace aquagraph::solid
