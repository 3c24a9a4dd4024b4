// Initial particles: the centres of Δx cells of boxes and of closed surfaces, with the hydrostatic pressure if wanted.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "physics/fluid/equation_of_state.hpp"
#include "physics/fluid/particles.hpp"
#include "physics/geometry/surface.hpp"

namespace aquagraph::fluid {

template <int D>
struct FillBox {
    std::array<double, D> min, max;  // [m]
};

// Density deviation of water at rest at a depth below the surface where p = 0. With Tait's equation dp/dz = ρ g has the
// closed form (ρ/ρ0)^(γ-1) = 1 + (γ-1) g z / c0². Above the surface: 0.
double hydrostatic_deviation(const Tait& tait, double gravity, double depth);

// How many particles a box gives: whole cells of Δx only.
template <int D>
std::size_t particles_in(const FillBox<D>& box, double spacing);

// Water that a closed surface bounds, perhaps only up to a level.
template <int D>
struct Region {
    geometry::Surface<D> boundary;  // closed and welded
    double clearance = 0;           // particles keep this distance from the boundary [m]; half a spacing fits a wall
    std::optional<double> level;    // nothing above this height [m]

    double volume() const;  // exact [m^D]
    double top() const;     // of the water [m]
};

// Particles of one body of water before they have a state.
template <int D>
struct Places {
    std::vector<geometry::Vec<D>> x;  // [m]
    double volume = 0;                // of each [m^D]
};

template <int D>
Places<D> places_in(const FillBox<D>& box, double spacing);

// The points of the lattice that lie inside, at the clearance at least from the boundary. The lattice begins at the
// lower left corner of the boundary's bounding box, so that polygons with sides along the axes are filled like boxes;
// with a level, a row of cells ends there. Each particle has Δx^D: along walls that do not run along the lattice a
// layer of half a cell on average is missing, so that a body of surface A holds about A Δx/2 too little water.
template <int D>
Places<D> places_in(const Region<D>& region, double spacing);

// As many points of the lattice as the volume asks for, round(V/Δx^D), the deepest first, each with its share of the
// exact volume: what relax() (relaxation.hpp) starts from. Some of them may lie up to a cell outside.
template <int D>
Places<D> full_places_in(const Region<D>& region, double spacing);

// One body of water, all of it at one velocity.
template <int D>
struct Water {
    Places<D> places;
    geometry::Vec<D> velocity = geometry::Vec<D>::Zero();  // [m/s]
    std::optional<double> surface_level;                   // where its pressure is zero [m]; none: p = 0 everywhere
};

// Makes the particles of all bodies, one body after the other. gravity [m/s²] is the acceleration along minus the last
// direction. Mass is ρ times the volume of the place.
template <int D>
void fill(Particles<D>& particles, std::span<const Water<D>> bodies, const Tait& tait, double gravity);

// Fills the boxes one after the other. surface_level: height along the last direction at which p = 0, or none for p = 0
// everywhere; gravity [m/s²] is the acceleration along minus the last direction. Mass is ρ Δx^D.
template <int D>
void fill(Particles<D>& particles, const std::vector<FillBox<D>>& boxes, double spacing, const Tait& tait,
          double gravity, std::optional<double> surface_level);

extern template struct Region<2>;
extern template struct Region<3>;
extern template Places<2> places_in(const FillBox<2>&, double);
extern template Places<3> places_in(const FillBox<3>&, double);
extern template Places<2> places_in(const Region<2>&, double);
extern template Places<3> places_in(const Region<3>&, double);
extern template Places<2> full_places_in(const Region<2>&, double);
extern template Places<3> full_places_in(const Region<3>&, double);
extern template void fill(Particles<2>&, std::span<const Water<2>>, const Tait&, double);
extern template void fill(Particles<3>&, std::span<const Water<3>>, const Tait&, double);
extern template std::size_t particles_in(const FillBox<2>&, double);
extern template std::size_t particles_in(const FillBox<3>&, double);
extern template void fill(Particles<2>&, const std::vector<FillBox<2>>&, double, const Tait&, double,
                          std::optional<double>);
extern template void fill(Particles<3>&, const std::vector<FillBox<3>>&, double, const Tait&, double,
                          std::optional<double>);

}  // namespace aquagraph::fluid
