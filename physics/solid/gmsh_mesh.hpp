// Reads a plane mesh in Gmsh's MSH format 4.1, ASCII (Gmsh reference manual, "MSH file format").
#pragma once
#include <istream>
#include <string>

#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

// Elements: 8-node quadrilaterals (type 16) as they are; 4-node ones (type 3) get straight mid-side nodes, shared by
// neighbours. Physical curves become node sets and surfaces of that name, oriented with the solid on the left whatever
// their direction in the file (2-node lines, type 1, with 4-node quadrilaterals; 3-node ones, type 8, with 8-node);
// a curve inside the solid becomes a node set only. Physical points and surfaces become node sets. The z coordinate
// must be the same for all nodes. Nodes of no quadrilateral are refused, but for geometry points without physical name.
// source: what messages call the file. Throws MeshError with the line, or the element's tag: wrong version or binary,
// truncated file, unknown element type (9-node quadrilaterals with the remedy), quadrilaterals or physical entities
// without a name, clockwise or inverted elements, dangling nodes.
Mesh<2> read_gmsh(std::istream& input, const std::string& source);

}  // namespace aquagraph::solid
