// Which particles lie at a free surface, and its normal (Marrone et al. 2010). The fullness λ (gradients.hpp) sorts
// most of them: below 0.2 splash, above 0.75 inside. Between, a particle is at the surface unless somebody stands in
// the umbrella ahead of it along the normal
//     n_i = -<∇λ>_i/|<∇λ>_i|,   with h = R/2 and T = x_i + h n_i:
//     |x_ij| >= √2 h and |x_j - T| < h,   or   |x_ij| < √2 h and the angle between n_i and x_ij below 45°.
#pragma once
#include "physics/fluid/kernel.hpp"
#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

inline constexpr double fullness_of_splash = 0.2;

template <int D>
struct FreeSurface {
    Vectors<D> normal;    // out of the water; 0 where λ does not change
    Vectors<D> crowding;  // k_i = Σ ∇W_ij ω_j [1/m], towards where particles are dense
    Scalars at_surface;   // 1 at the surface and in splash, else 0: fluid and ghosts (0)

    void resize(const Particles<D>& particles);
};

// Writes the three fields for these fluid particles (of one block). Reads positions, volumes and the fullness of fluid
// and ghosts.
template <int D>
void detect_free_surface(const Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                         FreeSurface<D>& surface, LaneRange lanes);

extern template struct FreeSurface<2>;
extern template struct FreeSurface<3>;
extern template void detect_free_surface(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&,
                                         FreeSurface<2>&, LaneRange);
extern template void detect_free_surface(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&,
                                         FreeSurface<3>&, LaneRange);

}  // namespace aquagraph::fluid
