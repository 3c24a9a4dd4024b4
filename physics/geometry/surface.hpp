// A surface made of flat facets between shared vertices: segments in 2D, triangles in 3D. Every facet has a front: the
// left of first -> second vertex in 2D, the side from which its vertices run counter-clockwise in 3D. The fluid lies
// in front of a wall; a closed body has its fronts outside ("outward").
#pragma once
#include <Eigen/Core>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

namespace aquagraph::geometry {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

// A shape that cannot be made from what was given: a radius of 0, a polygon that crosses itself.
struct ShapeError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

template <int D>
struct Surface {
    static_assert(D == 2 || D == 3);
    using Facet = std::array<int, D>;
    std::vector<Vec<D>> vertices;  // [m]
    std::vector<Facet> facets;     // indices of vertices

    const Vec<D>& vertex(std::size_t facet, std::size_t k) const { return vertices[std::size_t(facets[facet][k])]; }
    Vec<D> centroid(std::size_t facet) const;
    // Normal to the front, as long as the segment or twice as long as the triangle's area.
    Vec<D> front(std::size_t facet) const;
    double measure(std::size_t facet) const;  // length or area

    // Appends another surface; its vertices stay apart (weld() joins them).
    void append(const Surface& other);
    // Fronts become backs.
    void flip();
    // Takes out vertices that no facet uses.
    void drop_unused_vertices();
};

// Total length or area.
template <int D>
double measure(const Surface<D>& surface);

// Volume (2D: area) that a closed surface encloses, by the divergence theorem: V = 1/D ∮ x·n dS. Positive where fronts
// look outwards, negative where they look inwards.
template <int D>
double enclosed_volume(const Surface<D>& surface);

// The part of that volume whose last coordinate is below `level`.
template <int D>
double enclosed_volume_below(const Surface<D>& surface, double level);

// Smallest axis-parallel box around all vertices: {min, max}. Undefined for a surface without vertices.
template <int D>
std::pair<Vec<D>, Vec<D>> bounds(const Surface<D>& surface);

// Vertices closer than `tolerance` become one, in the place of the one listed first. Facets keep their number; one that
// collapses has a vertex twice, which find_defects (surface_defects.hpp) reports.
template <int D>
void weld(Surface<D>& surface, double tolerance);

extern template struct Surface<2>;
extern template struct Surface<3>;

}  // namespace aquagraph::geometry
