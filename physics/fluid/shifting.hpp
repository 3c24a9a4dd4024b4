// The shifting velocity of ALE-SPH (Oger et al. 2016; thesis (2.94), (2.95)): particles move with v + δv towards where
// they are sparse,
//     δv_i = -U_i R k_i,  k_i = Σ_j ∇W_ij ω_j,  U_i = |v_i|,   |δv_i| <= 0.25 |v_i|.
// (U_i = Ma_i c0 in the thesis, which differs from |v_i| by the compression alone.)
// Splash is left alone, and within R of a free surface δv keeps only its part along the surface. The fluxes that go
// with it are those of schemes/ale_pair.hpp.
#pragma once
#include "physics/fluid/free_surface.hpp"

namespace aquagraph::fluid {

// Writes shift of these fluid particles (of one block), after detect_free_surface of all of them.
template <int D>
void compute_shift(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                   const FreeSurface<D>& surface, LaneRange lanes);

extern template void compute_shift(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const FreeSurface<2>&,
                                   LaneRange);
extern template void compute_shift(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const FreeSurface<3>&,
                                   LaneRange);

}  // namespace aquagraph::fluid
