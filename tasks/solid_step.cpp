#include "tasks/solid_step.hpp"

#include "physics/fluid/gradients.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/statistics.hpp"

namespace aquagraph::tasks {

Task newton_solve(solid::Solver<2>& solid, const coupling::Interface& interface, const Clock& clock, LoadsOf loads) {
    const bool parallel = loads == LoadsOf::last_exchange;
    const std::vector<double>& nodal = parallel ? interface.solid_loads : interface.fluid_loads;
    return {.name = "FE Newton solve",
            .reads = {resource::clock_cycle, parallel ? resource::solid_loads : resource::interface_loads},
            .writes = {resource::solid_state},
            .body = [&solid, &nodal, &clock] {
                solid.advance(clock.cycle, nodal, parallel_loop);
                report_work(solid.mesh().elements.size());
            }};
}

Task interface_gradients(fluid::Fluid<2>& fluid, const coupling::Interface& interface) {
    constexpr std::size_t per_block = 8;
    return {.name = "gradients (interface)",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts},
            .writes = {resource::fluid_gradients},
            .body = [&fluid, &interface] {
                const auto& clusters = interface.load.clusters();
                for_each_block((clusters.size() + per_block - 1) / per_block, [&](std::size_t block) {
                    for (std::size_t k = block * per_block; k < std::min(clusters.size(), (block + 1) * per_block); ++k)
                        compute_gradients(fluid.particles, fluid.lists, fluid.kernel,
                                          lanes_of_cluster(fluid.particles, clusters[k]), fluid.gradients());
                });
            }};
}

Task interface_loads(fluid::Fluid<2>& fluid, const fluid::GhostWalls<2>& walls, coupling::Interface& interface) {
    return {.name = "interface loads",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts,
                      resource::fluid_gradients, resource::ghost_gradients},
            .writes = {resource::interface_loads},
            .body = [&fluid, &walls, &interface] {
                for_each_block(interface.load.blocks(),
                               [&](std::size_t block) { interface.load.compute(fluid, block); });
                interface.load.spread(fluid.particles, walls, interface.vertex_forces);
                interface.surface.to_nodes(interface.vertex_forces, interface.fluid_loads);
                interface.force[0] = interface.force[1] = 0;
                for (std::size_t k = 0; k < interface.fluid_loads.size(); ++k)
                    interface.force[k % 2] += interface.fluid_loads[k];
                report_work(interface.load.pairs());
            }};
}

Task exchange(const solid::Solver<2>& solid, coupling::Interface& interface, Clock& clock) {
    return {.name = "exchange",
            .reads = {resource::solid_state, resource::interface_loads},
            .writes = {resource::interface_motion, resource::solid_loads, resource::clock_step},
            .body = [&solid, &interface, &clock] {
                interface.surface.take(solid.positions(), solid.velocities());
                std::copy(interface.fluid_loads.begin(), interface.fluid_loads.end(), interface.solid_loads.begin());
                clock.elapsed = 0;
                ++clock.cycles;
            }};
}

}  // namespace aquagraph::tasks
