#include "tasks/fluid_pass.hpp"

#include "physics/fluid/gradients.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/statistics.hpp"

namespace aquagraph::tasks {

template <int D>
Task gradients(fluid::Fluid<D>& fluid, const std::string& label) {
    return {.name = "gradients (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts},
            .writes = {resource::fluid_gradients},
            .body = [&fluid] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    compute_gradients(fluid.particles, fluid.lists, fluid.kernel, fluid.lanes(block));
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task fluxes(fluid::Fluid<D>& fluid, const std::string& label) {
    return {.name = "fluxes (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts, resource::fluid_gradients,
                      resource::ghost_gradients},
            .writes = {resource::fluid_rates},
            .body = [&fluid] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    compute_fluxes(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, fluid.tait.reference_density,
                                   fluid.lanes(block));
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task runge_kutta_stage(fluid::Fluid<D>& fluid, const Clock& clock, int stage) {
    return {.name = "Runge-Kutta (stage " + std::to_string(stage + 1) + ")",
            .reads = {resource::clock_step, resource::fluid_lists, resource::fluid_rates},
            .writes = {resource::fluid_state},
            .body = [&fluid, &clock, stage] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    advance_stage(fluid.particles, fluid.runge_kutta, fluid.tait, stage, clock.step,
                                  fluid.lanes(block));
                });
            }};
}

template Task gradients(fluid::Fluid<2>&, const std::string&);
template Task gradients(fluid::Fluid<3>&, const std::string&);
template Task fluxes(fluid::Fluid<2>&, const std::string&);
template Task fluxes(fluid::Fluid<3>&, const std::string&);
template Task runge_kutta_stage(fluid::Fluid<2>&, const Clock&, int);
template Task runge_kutta_stage(fluid::Fluid<3>&, const Clock&, int);

}  // namespace aquagraph::tasks
