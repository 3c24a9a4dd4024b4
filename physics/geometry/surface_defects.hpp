// What may be wrong with a surface that somebody drew: looked for before anything is computed with it.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "physics/geometry/surface.hpp"

namespace aquagraph::geometry {

enum class DefectKind {
    not_finite,  // a coordinate is not a number
    degenerate,  // a facet without length or area: two of its vertices are the same, or all lie on a line
    duplicate,   // two facets between the same vertices
    open_side,   // a side (2D: a vertex, 3D: an edge) that belongs to one facet only: not watertight
    branching,   // a side of more than two facets
    opposed,     // two facets that share a side and look at opposite sides of the surface
    crossing     // two facets that cut through each other
};

template <int D>
struct Defect {
    DefectKind kind;
    std::size_t facet;      // counted from 0
    std::size_t other = 0;  // the second one, of duplicate, opposed, crossing
    Vec<D> place;           // [m]
};

// Everything that is wrong, in order of kind and facet; the surface must be welded. closed: whether it has to be
// watertight; crossings are looked for in O(n log n).
template <int D>
std::vector<Defect<D>> find_defects(const Surface<D>& surface, bool closed);

// "triangle 12 has no area, at (0.1, 0, 2) m": facets are counted from 1 here, as mesh programs do.
template <int D>
std::string describe(const Defect<D>& defect);

extern template std::vector<Defect<2>> find_defects(const Surface<2>&, bool);
extern template std::vector<Defect<3>> find_defects(const Surface<3>&, bool);
extern template std::string describe(const Defect<2>&);
extern template std::string describe(const Defect<3>&);

}  // namespace aquagraph::geometry
