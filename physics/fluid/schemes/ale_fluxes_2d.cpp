#include "physics/fluid/schemes/flux_pass.hpp"
#include "physics/fluid/schemes/instances.hpp"

namespace aquagraph::fluid {

template <>
void compute_ale_fluxes<2>(Particles<2>& particles, const NeighbourLists<2>& lists, const Kernel<2>& kernel,
                           const FluxParameters& parameters, const Tait& tait, LaneRange lanes) {
    visit_ale_pair<2>(kernel, parameters, tait, [&](const auto& pair) {
        using Pair = std::remove_cvref_t<decltype(pair)>;
        pair_loop<2>(lists, lanes, AleFluxPass<2, Pair>(particles, pair, parameters, tait));
    });
}

}  // namespace aquagraph::fluid
