// Particles inside curved walls, moved from the lattice to a regular distribution that follows the walls, before t = 0.
//
// Every particle is pushed out of crowded places, as in particle shifting (Lind, Xu, Stansby and Rogers, J. Comput.
// Phys. 231, 2012):
//     δx_i = -c Δx² ∇C_i,     ∇C_i = Σ_j ω ∇W_ij + ∮ W(x_i - y) n(y) dS,
// where the second part is the gradient that water outside the boundary would have (divergence theorem; n outwards). It
// goes until the kernel sum
//     S_i = Σ_j ω W_ij + ∮ H(r) (n·r̂)/r^(D-1) dS,     H(r) = ∫_r^R W s^(D-1) ds,
// the second part being the kernel's share outside, is 1 everywhere to a tolerance: a regular distribution fills the
// kernel as water does. Integrals over the boundary are sums over pieces of 0.3 Δx.
#pragma once
#include "physics/block_loop.hpp"
#include "physics/fluid/filling.hpp"

namespace aquagraph::fluid {

struct RelaxationResult {
    double before = 0, after = 0;  // standard deviation of S over all particles
    double mean = 0;               // of S, afterwards
    int steps = 0;
    bool reached = false;  // the tolerance
};

// Moves `places` inside the region; their number and volumes stay. support: R of the kernel W [m]; tolerance: of the
// standard deviation of S. Ends when that is reached, when 50 steps have won less than 2 %, or after 2000.
template <int D>
RelaxationResult relax(Places<D>& places, const Region<D>& region, double spacing, double support, double tolerance,
                       BlockLoop loop);

extern template RelaxationResult relax(Places<2>&, const Region<2>&, double, double, double, BlockLoop);
extern template RelaxationResult relax(Places<3>&, const Region<3>&, double, double, double, BlockLoop);

}  // namespace aquagraph::fluid
