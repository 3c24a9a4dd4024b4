// Viscous forces of a fluid of constant dynamic viscosity µ, added to the accelerations of the flux pass:
//     dv_i/dt += µ/ρ_i <Δv>_i
//     monaghan_gingold  K Σ_j (x_ij·v_ij)/|x_ij|² ∇W_ij ω_j, K = 8 in 2D, 10 in 3D (1983; thesis (2.89)): keeps linear
//                       and angular momentum, consistent at a free surface
//     morris            2 Σ_j (x_ij·∇W_ij)/|x_ij|² v_ij ω_j (1997; thesis (2.88)): keeps linear momentum; for confined
//                       flow and for normal-flux walls
// with x_ij = x_j - x_i, v_ij = v_j - v_i. Friction on walls comes from the velocities of no-slip mirror images.
// They damp velocities by up to viscous_decay µ/(ρ R²), which limits the time step (time_step.hpp).
#pragma once
#include "physics/fluid/choices.hpp"
#include "physics/fluid/kernel.hpp"
#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

struct Viscosity {
    double dynamic = 0;  // µ [Pa s]
    ViscousOperator form = ViscousOperator::monaghan_gingold;
};

// Fastest decay of a velocity [µ/(ρ R²)]: the largest eigenvalue of the operator on square and cubic lattices with 2.6
// to 4 spacings in R, both kernels, is 22.7 to 27.8 for Morris and 54.8 to 72.2 for Monaghan and Gingold. A neighbour
// at rest takes out the more the nearer it is along the line of sight, hence the difference. The step 0.125 R² ρ/µ of
// thesis (2.64) would make that decay 3.4 and 9 per step, which no Runge–Kutta method bears (2.79 for the classical
// one).
inline double viscous_decay(ViscousOperator form) {
    return form == ViscousOperator::morris ? 28 : 74;
}

template <int D>
void add_viscosity(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                   const Viscosity& viscosity, LaneRange lanes);

extern template void add_viscosity(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const Viscosity&,
                                   LaneRange);
extern template void add_viscosity(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const Viscosity&,
                                   LaneRange);

}  // namespace aquagraph::fluid
