// The flux passes of all schemes, compiled once per dimension and family so that the files build side by side.
#pragma once
#include "physics/fluid/fluxes.hpp"

namespace aquagraph::fluid {

// Mass stays with its particle.
template <int D>
void compute_conserving_fluxes(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                               const FluxParameters& parameters, const Tait& tait, LaneRange lanes);
// Mass is exchanged.
template <int D>
void compute_ale_fluxes(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                        const FluxParameters& parameters, const Tait& tait, LaneRange lanes);

}  // namespace aquagraph::fluid
