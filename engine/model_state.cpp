#include "engine/model_state.hpp"

#include "physics/fluid/rebuild.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

template <int D>
void remake(Model<D>& model) {
    if (!model.fluid) return;
    fluid::Fluid<D>& fluid = *model.fluid;
    // As the neighbour search does (tasks/neighbours.cpp).
    const auto loads = [&] {
        if constexpr (D == 2)
            if (model.interface) {
                if (model.flux_walls)
                    model.interface->rebuild(fluid, *model.flux_walls);
                else
                    model.interface->rebuild(fluid, *model.walls);
            }
    };
    if (model.flux_walls)
        remake_lists(fluid, *model.flux_walls, tasks::parallel_loop, loads);
    else
        remake_lists(fluid, model.walls ? &*model.walls : nullptr, tasks::parallel_loop, loads);
}

template void remake(Model<2>&);
template void remake(Model<3>&);

}  // namespace aquagraph::engine
