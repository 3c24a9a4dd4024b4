// Surfaces and motions of what a scene says in words and numbers.
#pragma once
#include "io/scene.hpp"
#include "physics/fluid/walls/motion.hpp"
#include "physics/geometry/surface.hpp"

namespace aquagraph::io {

// The wall as panels that look at the fluid. Throws geometry::ShapeError, StlError or std::system_error (its file);
// an STL surface with defects is refused with the first few of them. spacing: Δx, for default chord errors.
template <int D>
geometry::Surface<D> wall_surface(const WallScene& wall, double spacing);

// Whether that surface bounds a body or a room all round: then every place is on one side of it.
bool is_closed(const WallScene& wall);

// The closed boundary of a body of water.
template <int D>
geometry::Surface<D> region_surface(const RegionScene& region, double spacing);

// Whether its pressure grows with depth at t = 0.
bool is_hydrostatic(const RegionScene& region, const FluidScene& fluid);
// Height at which the hydrostatic pressure is zero: as stated, or the highest top of such water.
double surface_level(const FluidScene& fluid, int dimension);

// Throws std::invalid_argument, or std::system_error for the table's file. end: of the run [s], which the table must
// reach.
template <int D>
fluid::RigidMotion<D> rigid_motion(const MotionScene& motion, double end);

// A table of motion: a head line with the names time and any of x, y, z, angle, perhaps with units ([s], [m], [rad],
// [deg]), then rows of numbers. Lines that begin with # are skipped. A column that is not there is empty.
struct MotionTable {
    std::vector<double> time;
    std::array<std::vector<double>, 3> place;  // [m]
    std::vector<double> angle;                 // [rad]
};
MotionTable parse_motion_table(std::string_view text);

}  // namespace aquagraph::io
