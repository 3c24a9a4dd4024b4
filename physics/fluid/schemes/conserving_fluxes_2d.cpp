#include "physics/fluid/schemes/flux_pass.hpp"
#include "physics/fluid/schemes/instances.hpp"

namespace aquagraph::fluid {

template <>
void compute_conserving_fluxes<2>(Particles<2>& particles, const NeighbourLists<2>& lists, const Kernel<2>& kernel,
                                  const FluxParameters& parameters, const Tait& tait, LaneRange lanes) {
    visit_pair<2>(kernel, parameters, tait, [&](const auto& pair) {
        pair_loop<2>(lists, lanes, FluxPass<2, std::remove_cvref_t<decltype(pair)>>(particles, pair, parameters, tait));
    });
}

}  // namespace aquagraph::fluid
