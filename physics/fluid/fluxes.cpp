#include "physics/fluid/fluxes.hpp"

#include "physics/fluid/schemes/instances.hpp"

namespace aquagraph::fluid {

template <int D>
void compute_fluxes(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                    const FluxParameters& parameters, const Tait& tait, LaneRange lanes) {
    if (parameters.scheme == Scheme::riemann_ale)
        compute_ale_fluxes(particles, lists, kernel, parameters, tait, lanes);
    else
        compute_conserving_fluxes(particles, lists, kernel, parameters, tait, lanes);
}

template void compute_fluxes(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const FluxParameters&,
                             const Tait&, LaneRange);
template void compute_fluxes(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const FluxParameters&,
                             const Tait&, LaneRange);

}  // namespace aquagraph::fluid
