// Writes the input deck with which CalculiX (G. Dhondt's ccx) computes the same body on the same mesh.
//
// What is the same and what is not (measured in benchmarks/solid/calculix): with *STEP, NLGEOM the law *ELASTIC is
// linear between Green–Lagrange strain and second Piola–Kirchhoff stress, hence Saint Venant–Kirchhoff; rubber has the
// same energies, D1 = 2/κ. Elements of 20 and of 8 plane nodes are integrated with 2^D points as here (C3D20R, CPE8R,
// CPS8R), or with 3^D (C3D20); linear ones have incompatible modes where enhanced strains are asked for (C3D8I), which
// are not the same. *DYNAMIC, ALPHA is the scheme of Hilber, Hughes and Taylor.
#pragma once
#include <ostream>
#include <string>

#include "physics/solid/dead_loads.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::solid {

// How the body is taken through time and what is printed.
struct CalculixRun {
    std::string title;
    bool is_static = false;     // *STATIC, otherwise *DYNAMIC from rest …
    bool static_start = false;  // … after an equilibrium under gravity and the loads at t = 0
    double step = 0, end = 0;   // [s]
    std::vector<DeadLoad> loads;
    std::vector<NodeIndex> printed;  // nodes whose displacements go into the .dat file; none: all
    int print_every = 1;             // steps
};

// Node and element numbers count from 1. Throws std::invalid_argument for what ccx has no equal for: a measured curve,
// cords, linear quadrilaterals, and Newmark's scheme with α ≠ 0; and for what is not exported: central differences,
// prescribed motions, rigid bodies, pressures, contacts, damping.
template <int D>
void write_calculix(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options, const CalculixRun& run);

}  // namespace aquagraph::solid
