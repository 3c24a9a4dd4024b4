#include "physics/fluid/schemes/flux_pass.hpp"
#include "physics/fluid/schemes/instances.hpp"

namespace aquagraph::fluid {

template <>
void compute_ale_fluxes<3>(Particles<3>& particles, const NeighbourLists<3>& lists, const Kernel<3>& kernel,
                           const FluxParameters& parameters, const Tait& tait, LaneRange lanes) {
    visit_ale_pair<3>(kernel, parameters, tait, [&](const auto& pair) {
        using Pair = std::remove_cvref_t<decltype(pair)>;
        pair_loop<3>(lists, lanes, AleFluxPass<3, Pair>(particles, pair, parameters, tait));
    });
}

}  // namespace aquagraph::fluid
