// X-SPH (Monaghan 1989; thesis (2.91), (2.92)): particles move with v + δv,
//     δv_i = ε Σ_j m_j/ρ_ij (v_j - v_i) W_ij,     ε about 0.5,
// m_j/ρ_ij taken as ω_j, which differs by the relative difference of two densities. Smooths motion, not velocity; in a
// scheme without mass exchange it is a displacement without a flux.
#pragma once
#include "physics/fluid/kernel.hpp"
#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

// Writes shift of these fluid particles (of one block).
template <int D>
void compute_x_sph(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel, double epsilon,
                   LaneRange lanes);

extern template void compute_x_sph(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, double, LaneRange);
extern template void compute_x_sph(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, double, LaneRange);

}  // namespace aquagraph::fluid
