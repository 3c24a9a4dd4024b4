// Writes the input deck with which CalculiX (G. Dhondt's ccx) computes the same body on the same mesh.
//
// What is the same and what is not (measured in benchmarks/solid/README.md): with *STEP, NLGEOM the law *ELASTIC is
// linear between Green–Lagrange strain and second Piola–Kirchhoff stress, hence Saint Venant–Kirchhoff; rubber has the
// same energies, D1 = 2/κ. Elements of 20 and of 8 plane nodes are integrated with 2^D points as here (C3D20R, CPE8R,
// CPS8R), or with 3^D (C3D20); linear ones have incompatible modes where enhanced strains are asked for (C3D8I), which
// are not the same. *DYNAMIC, ALPHA is the scheme of Hilber, Hughes and Taylor.
#pragma once
#include <ostream>
#include <span>
#include <string>

#include "physics/solid/dead_loads.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::solid {

// How the body is taken through time and what is printed.
struct CalculixRun {
    std::string title;
    bool is_static = false;       // *STATIC, otherwise *DYNAMIC from rest …
    bool static_start = false;    // … after an equilibrium under gravity and the loads at t = 0 …
    bool unloaded_start = false;  // … or gravity alone
    double step = 0, end = 0;     // [s]
    std::vector<DeadLoad> loads;
    std::vector<NodeIndex> printed;  // nodes whose displacements go into the .dat file; none: all
    int print_every = 1;             // steps
};

// One step of a body that ccx takes from one restart file to the next. At its start ccx finds the accelerations anew,
//     (M + β (Δt/10)² (1 + α) K) a_n = F_ext,n - F_int(u_n),
// since its restart files do not have them. With α = 0 these are, but for the small stiffness, those that the step
// before has ended with; with α < 0 they are not, and the scheme is another one of the same order.
struct CalculixStep {
    double size = 0;                                // [s]
    bool first = false;                             // the loads were the same at its start
    std::span<const double> forces, forces_before;  // at its end and at its start, D × nodes; before: may be empty
};

// Node and element numbers count from 1. Throws std::invalid_argument for what ccx has no equal for: a measured curve,
// cords, linear quadrilaterals, and Newmark's scheme with α ≠ 0; and for what is not exported: central differences,
// prescribed motions, rigid bodies, pressures, contacts, damping.
template <int D>
void write_calculix(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options, const CalculixRun& run);

// The body, in two dimensions as a slab (its nodes at z = 0 have the numbers of the plane's), and its equilibrium under
// these forces (D × nodes; may be empty) and its weight, if that counts. std::invalid_argument also for plane stress.
template <int D>
void write_calculix_start(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options,
                          std::span<const double> forces, bool under_gravity);
// What follows on a start or another step.
template <int D>
void write_calculix_step(std::ostream& deck, const Mesh<D>& mesh, const Options<D>& options, const CalculixStep& step);

}  // namespace aquagraph::solid
