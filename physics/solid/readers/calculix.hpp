// Reads the mesh of an Abaqus or CalculiX input deck (.inp): G. Dhondt, CalculiX CrunchiX User's Manual, "Input deck
// format".
#pragma once
#include <istream>
#include <string>

#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

// *NODE, *ELEMENT (D = 2: CPE4 CPE4R CPS4 CPS4R CPE8 CPE8R CPS8 CPS8R in a plane z = constant; D = 3: C3D8 C3D8R C3D8I
// C3D20 C3D20R C3D10, all of one type; elements of fewer dimensions, as mesh generators write them for the sides of a
// body, make their element sets surfaces), *NSET and *ELSET (lists, names of sets, GENERATE), *SURFACE of TYPE=ELEMENT
// (S1, S2, …; it becomes a node set too) or NODE (a node set). Elements are taken as they are: integration is this
// code's. Names of sets keep the letters of their first appearance and are told apart without regard to case.
// Materials, sections, supports, loads, steps and output of the deck are left out: those are the scene's. Everything
// that would change the mesh (*INCLUDE, *INSTANCE, *NGEN, *MPC, *EQUATION, *TIE …) and every unknown keyword is
// refused. source: what messages call the file. Throws MeshError with the line, or the element's or node's number.
template <int D>
Mesh<D> read_calculix(std::istream& input, const std::string& source);

}  // namespace aquagraph::solid
