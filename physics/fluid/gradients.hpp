// Renormalised gradients of pressure and velocity (thesis (2.40), (2.41)):
//     B_i = [Σ_j (x_j - x_i) ⊗ ∇W_ij ω_j]^-1,   <∇φ>_i = B_i Σ_j (φ_j - φ_i) ∇W_ij ω_j      exact on linear fields,
// and the fullness λ_i, the smallest eigenvalue of B_i^-1 (Marrone et al. 2010): below 0.2 (splash, thin sheet) B is
// meaningless and the gradients are set to zero, so that the reconstruction falls back to first order there.
#pragma once
#include <cmath>

#include "physics/fluid/kernel.hpp"
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

// B^-1 = m, symmetric: returns its smallest eigenvalue and replaces m by its inverse where that eigenvalue exceeds
// `threshold`. m holds the upper triangle row by row: xx xy yy, or xx xy xz yy yz zz.
template <int D>
double invert_moment(double (&m)[D * (D + 1) / 2], double threshold);
template <>
double invert_moment<3>(double (&m)[6], double threshold);

// Without branches, for lanes side by side.
template <>
[[gnu::always_inline]] inline double invert_moment<2>(double (&m)[3], double threshold) {
    const double xx = m[0], xy = m[1], yy = m[2];
    const double mean = 0.5 * (xx + yy);
    const double smallest = mean - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    const bool full = smallest > threshold;
    const double inverse = 1 / (xx * yy - xy * xy);
    m[0] = full ? yy * inverse : xx;
    m[1] = full ? -xy * inverse : xy;
    m[2] = full ? xx * inverse : yy;
    return smallest;
}

extern template void compute_gradients(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, LaneRange,
                                       GradientsOf);
extern template void compute_gradients(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, LaneRange,
                                       GradientsOf);

}  // namespace aquagraph::fluid
