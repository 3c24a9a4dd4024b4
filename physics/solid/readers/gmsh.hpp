// Reads a mesh in Gmsh's MSH formats 4.1 and 2.2, ASCII (Gmsh reference manual, "MSH file format").
#pragma once
#include <istream>
#include <string>

#include "physics/solid/mesh.hpp"
#include "physics/solid/readers/raw_mesh.hpp"

namespace aquagraph::solid {

// Elements: D = 2 quadrilaterals of 4 or 8 nodes (types 3, 16) in a plane z = constant; D = 3 hexahedra of 8 or 20 (5,
// 17) and tetrahedra of 4 or 10 (4, 11), all of one type. Without nodes on their edges they get them, straight and
// shared by neighbours, unless `order` is linear. Physical groups become named sets: of elements of dimension D element
// sets and node sets; of their sides (curves in the plane, surfaces in space) node sets and surfaces, facing out of the
// body whatever their direction in the file, or node sets alone inside the body; all others node sets. Nodes that no
// element has are refused, but for geometry points without physical name.
// source: what messages call the file. Throws MeshError with the line, or the element's tag: wrong version or binary,
// truncated file, unknown element type (those with nodes in their middle with the remedy), no elements or physical
// groups without a name, elements numbered the wrong way round or inverted, dangling nodes.
template <int D>
Mesh<D> read_gmsh(std::istream& input, const std::string& source, MeshOrder order = MeshOrder::quadratic);

}  // namespace aquagraph::solid
