// Makers of surfaces: what a wall or a body of water may be bounded by. Fronts look at the fluid.
// All throw ShapeError for what has no area or volume.
#pragma once
#include <span>
#include <vector>

#include "physics/geometry/surface.hpp"

namespace aquagraph::geometry {

enum class FluidSide { inside, outside };

// Sides of a box that are left out: open[d][0] the side at the smaller coordinate d, open[d][1] that at the larger.
template <int D>
using OpenSides = std::array<std::array<bool, 2>, D>;

// A chain of segments with the fluid on the left; closed joins the last point to the first.
Surface<2> polyline(std::span<const Vec<2>> points, bool closed);

template <int D>
Surface<D> box(const Vec<D>& min, const Vec<D>& max, FluidSide fluid, const OpenSides<D>& open = {});

// A flat parallelogram, a rectangle where the sides are perpendicular. The fluid lies where a × b points.
Surface<3> rectangle(const Vec<3>& corner, const Vec<3>& a, const Vec<3>& b);

// A flat polygon, counter-clockwise as seen from the fluid; need not be convex. Corners farther from the plane than
// 1e-6 of the polygon's size are refused.
Surface<3> plane_polygon(std::span<const Vec<3>> corners);

// The wall that a polyline leaves when it is drawn along an axis (0 x, 1 y, 2 z) from one coordinate to a larger one.
// Points hold the two other coordinates in ascending order: (y, z), (x, z) or (x, y); the fluid is on the left as drawn
// with the first to the right and the second upwards. A closed polyline that does not cross itself can have caps.
Surface<3> extrude(std::span<const Vec<2>> points, bool closed, int axis, double from, double to, bool caps);

// Round shapes: vertices lie on the circle or sphere, and no facet's middle is farther inside it than chord_error [m].
Surface<2> circle(const Vec<2>& centre, double radius, double chord_error, FluidSide fluid);
// open: without the disc at `from` or at `to`.
Surface<3> cylinder(const Vec<3>& from, const Vec<3>& to, double radius, double chord_error, FluidSide fluid,
                    std::array<bool, 2> open = {});
// An icosahedron whose faces are divided evenly.
Surface<3> sphere(const Vec<3>& centre, double radius, double chord_error, FluidSide fluid);

// Segments of a circle for this chord error: the smallest n ≥ 8 with r (1 - cos(π/n)) <= chord_error.
int segments_of_circle(double radius, double chord_error);

// Corners of a simple polygon as triangles that turn the way the polygon does. Throws ShapeError where it crosses
// itself.
std::vector<std::array<int, 3>> triangles_of_polygon(std::span<const Vec<2>> corners);

// x -> R (scale x) + translation, R by `angle` [rad] about `axis` through the origin; any axis where the angle is 0.
void transform(Surface<3>& surface, double scale, const Vec<3>& axis, double angle, const Vec<3>& translation);

}  // namespace aquagraph::geometry
