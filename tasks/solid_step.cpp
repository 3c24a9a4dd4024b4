#include "tasks/solid_step.hpp"

#include "physics/fluid/gradients.hpp"
#include "physics/solid/stable_steps.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/statistics.hpp"

namespace aquagraph::tasks {

Task newton_solve(solid::Structure<2>& solid, coupling::Interface& interface, const Clock& clock, LoadsOf loads) {
    const bool parallel = loads == LoadsOf::last_exchange;
    const std::vector<double>& nodal = parallel ? interface.solid_loads : interface.fluid_loads;
    return {.name = "FE Newton solve",
            .reads = {resource::clock_cycle, parallel ? resource::solid_loads : resource::interface_loads},
            .writes = {resource::solid_state},
            .body = [&solid, &interface, &nodal, &clock] {
                advance_stably(solid, clock.cycle, nodal, interface.borne_loads, interface.between, parallel_loop);
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

namespace {
// To the solid's nodes, with the correction of the energy-conservative load (1 for the others), and their sum.
void hand_to_nodes(coupling::Interface& interface) {
    interface.surface.to_nodes(interface.vertex_forces, interface.fluid_loads);
    const double factor = interface.correction.factor();
    interface.force = {};
    for (std::size_t k = 0; k < interface.fluid_loads.size(); ++k) {
        interface.fluid_loads[k] *= factor;
        interface.force[k % 2] += interface.fluid_loads[k];
    }
}
}  // namespace

Task interface_loads(fluid::Fluid<2>& fluid, const fluid::GhostWalls<2>& walls, coupling::Interface& interface) {
    return {.name = "interface loads",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts,
                      resource::fluid_gradients, resource::ghost_gradients, resource::interface_energy},
            .writes = {resource::interface_loads},
            .body = [&fluid, &walls, &interface] {
                for_each_block(interface.load.blocks(),
                               [&](std::size_t block) { interface.load.compute(fluid, block); });
                interface.load.spread(fluid.particles, walls, interface.vertex_forces);
                hand_to_nodes(interface);
                report_work(interface.load.pairs());
            }};
}

Task interface_loads(fluid::Fluid<2>& fluid, const fluid::NormalFluxWalls<2>& walls, coupling::Interface& interface) {
    return {.name = "interface loads",
            .reads = {resource::walls, resource::wall_gamma, resource::fluid_lists, resource::fluid_state,
                      resource::fluid_gradients, resource::fluid_rates},
            .writes = {resource::interface_loads},
            .body = [&fluid, &walls, &interface] {
                interface.vertex_forces.assign(walls.panels.position.size(), fluid::Vec2::Zero());
                walls.add_reactions(fluid.particles, fluid.kernel, fluid.flux, interface.vertex_forces);
                hand_to_nodes(interface);
            }};
}

Task averaged_loads(const fluid::Fluid<2>& fluid, const fluid::Panels<2>& panels, coupling::Interface& interface) {
    return {.name = "interface loads",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state},
            .writes = {resource::interface_loads},
            .body = [&fluid, &panels, &interface] {
                for_each_block(interface.average.blocks(), [&](std::size_t block) {
                    interface.average.compute(fluid.particles, panels, fluid.kernel.radius(), 0.5 * fluid.spacing,
                                              block);
                });
                interface.average.spread(panels, interface.vertex_forces);
                hand_to_nodes(interface);
                report_work(interface.average.candidates());
            }};
}

Task interface_energy(const solid::Structure<2>& solid, coupling::Interface& interface, const double& work_on_fluid) {
    return {.name = "interface energy",
            .reads = {resource::solid_state, resource::fluid_ledger},
            .writes = {resource::interface_energy},
            .body = [&solid, &interface, &work_on_fluid] {
                coupling::InterfaceEnergy& energy = interface.energy;
                const double gained = work_on_fluid - energy.to_fluid;
                const double given = energy.book(solid.work_of_loads());
                energy.to_fluid = work_on_fluid;
                if (interface.method == coupling::LoadMethod::energy_conservative)
                    interface.correction.update(gained, given, energy.of_interface());
            }};
}

Task exchange(const solid::Structure<2>& solid, coupling::Interface& interface, Clock& clock) {
    return {.name = "exchange",
            .reads = {resource::solid_state, resource::interface_loads, resource::interface_energy},
            .writes = {resource::interface_motion, resource::solid_loads, resource::clock_step},
            .body = [&solid, &interface, &clock] {
                interface.surface.take(solid.positions(), solid.velocities(), clock.cycle);
                std::copy(interface.fluid_loads.begin(), interface.fluid_loads.end(), interface.solid_loads.begin());
                clock.elapsed = 0;
                ++clock.cycles;
            }};
}

Task regulate_ratio(coupling::Interface& interface) {
    return {.name = "ratio control",
            .reads = {resource::interface_loads},
            .writes = {resource::interface_ratio},
            .body = [&interface] { interface.ratio.update(interface.force); }};
}

}  // namespace aquagraph::tasks
