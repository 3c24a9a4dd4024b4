// Initial particles: the centres of Δx cells of boxes, at rest, with the hydrostatic pressure if wanted.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "physics/fluid/equation_of_state.hpp"
#include "physics/fluid/particles.hpp"

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

// Fills the boxes one after the other. surface_level: height along the last direction at which p = 0, or none for p = 0
// everywhere; gravity [m/s²] is the acceleration along minus the last direction. Mass is ρ Δx^D.
template <int D>
void fill(Particles<D>& particles, const std::vector<FillBox<D>>& boxes, double spacing, const Tait& tait,
          double gravity, std::optional<double> surface_level);

extern template std::size_t particles_in(const FillBox<2>&, double);
extern template std::size_t particles_in(const FillBox<3>&, double);
extern template void fill(Particles<2>&, const std::vector<FillBox<2>>&, double, const Tait&, double,
                          std::optional<double>);
extern template void fill(Particles<3>&, const std::vector<FillBox<3>>&, double, const Tait&, double,
                          std::optional<double>);

}  // namespace aquagraph::fluid
