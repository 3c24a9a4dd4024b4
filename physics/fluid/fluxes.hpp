// Rates of the fluid particles from the fluxes of their pairs, for the scheme of the scene:
//     riemann               Riemann-SPH, locally mass conserving (thesis (2.55))      schemes/riemann_pair.hpp
//     riemann_ale           Riemann-SPH with mass exchange (2.53), (2.93)             schemes/ale_pair.hpp
//     delta_sph             δ-SPH (2.46)-(2.48)                                       schemes/delta_sph.hpp
//     artificial_viscosity  (2.44)-(2.45)                                             schemes/artificial_viscosity.hpp
#pragma once
#include "physics/fluid/choices.hpp"
#include "physics/fluid/equation_of_state.hpp"
#include "physics/fluid/kernel.hpp"
#include "physics/fluid/neighbour_lists.hpp"
#include "physics/fluid/schemes/riemann_pair.hpp"

namespace aquagraph::fluid {

struct FluxParameters {
    bool muscl = true;  // Riemann schemes: linear reconstruction with minmod, or none
    Scheme scheme = Scheme::riemann;
    RiemannSolver solver = RiemannSolver::acoustic;
    double delta = 0.1;             // δ of δ-SPH
    double alpha = 0.01;            // α of δ-SPH and of artificial viscosity
    double gravity[3] = {0, 0, 0};  // [m/s²]

    bool is_riemann() const { return scheme == Scheme::riemann || scheme == Scheme::riemann_ale; }
    // What the scheme reads of the gradient pass, beside the fullness.
    bool reads_pressure_gradient() const {
        return scheme == Scheme::delta_sph || (muscl && scheme != Scheme::artificial_viscosity);
    }
    bool reads_velocity_gradient() const { return muscl && is_riemann(); }
};

// Writes acceleration and deviation_rate of these fluid particles (of one block); with mass exchange also mass_rate,
// and acceleration is then the rate of momentum over the mass, (d(m v)/dt)/m.
template <int D>
void compute_fluxes(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                    const FluxParameters& parameters, const Tait& tait, LaneRange lanes);

extern template void compute_fluxes(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const FluxParameters&,
                                    const Tait&, LaneRange);
extern template void compute_fluxes(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const FluxParameters&,
                                    const Tait&, LaneRange);

}  // namespace aquagraph::fluid
