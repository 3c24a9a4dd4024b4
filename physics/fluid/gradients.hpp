// Renormalised gradients of pressure and velocity (thesis (2.40), (2.41)):
//     B_i = [Σ_j (x_j - x_i) ⊗ ∇W_ij ω_j]^-1,   <∇φ>_i = B_i Σ_j (φ_j - φ_i) ∇W_ij ω_j      exact on linear fields,
// and the fullness λ_i, the smallest eigenvalue of B_i^-1 (Marrone et al. 2010): below 0.2 (splash, thin sheet) B is
// meaningless and the gradients are set to zero, so that the reconstruction falls back to first order there.
#pragma once
#include "physics/fluid/kernel.hpp"
#include "physics/fluid/moment.hpp"
#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

inline constexpr double fullness_to_reconstruct = 0.2;

// Which gradients a scheme reads; the fullness comes with each of them and alone.
struct GradientsOf {
    bool pressure = true, velocity = true;
};

// Writes fullness and the gradients asked for of these fluid particles (of one block). Reads x, v, p, volume of fluid
// and ghosts.
template <int D>
void compute_gradients(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                       LaneRange lanes, GradientsOf fields = {});

extern template void compute_gradients(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, LaneRange,
                                       GradientsOf);
extern template void compute_gradients(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, LaneRange,
                                       GradientsOf);

}  // namespace aquagraph::fluid
