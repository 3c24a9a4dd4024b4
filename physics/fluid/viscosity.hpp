// Viscous forces of a fluid of constant dynamic viscosity µ, added to the accelerations of the flux pass:
//     dv_i/dt += µ/ρ_i <Δv>_i
//     monaghan_gingold  K Σ_j (x_ij·v_ij)/|x_ij|² ∇W_ij ω_j, K = 8 in 2D, 10 in 3D (1983; thesis (2.89)): keeps linear
//                       and angular momentum, consistent at a free surface
//     morris            2 Σ_j (x_ij·∇W_ij)/|x_ij|² v_ij ω_j (1997; thesis (2.88)): keeps linear momentum; for confined
//                       flow and for normal-flux walls
// with x_ij = x_j - x_i, v_ij = v_j - v_i. Friction on walls comes from the velocities of no-slip mirror images.
// It limits the time step to 0.125 R² ρ0/µ (2.64).
#pragma once
#include "physics/fluid/choices.hpp"
#include "physics/fluid/kernel.hpp"
#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

struct Viscosity {
    double dynamic = 0;  // µ [Pa s]
    ViscousOperator form = ViscousOperator::monaghan_gingold;
};

template <int D>
void add_viscosity(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                   const Viscosity& viscosity, LaneRange lanes);

extern template void add_viscosity(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const Viscosity&,
                                   LaneRange);
extern template void add_viscosity(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const Viscosity&,
                                   LaneRange);

}  // namespace aquagraph::fluid
