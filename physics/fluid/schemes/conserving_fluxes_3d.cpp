#include "physics/fluid/schemes/flux_pass.hpp"
#include "physics/fluid/schemes/instances.hpp"

namespace aquagraph::fluid {

template <>
void compute_conserving_fluxes<3>(Particles<3>& particles, const NeighbourLists<3>& lists, const Kernel<3>& kernel,
                                  const FluxParameters& parameters, const Tait& tait, LaneRange lanes) {
    visit_pair<3>(kernel, parameters, tait, [&](const auto& pair) {
        pair_loop<3>(lists, lanes, FluxPass<3, std::remove_cvref_t<decltype(pair)>>(particles, pair, parameters, tait));
    });
}

}  // namespace aquagraph::fluid
