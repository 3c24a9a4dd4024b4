#include "tasks/fluid_pass.hpp"

#include "physics/fluid/gradients.hpp"
#include "physics/fluid/shifting.hpp"
#include "physics/fluid/x_sph.hpp"
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
                    compute_gradients(fluid.particles, fluid.lists, fluid.kernel, fluid.lanes(block),
                                      fluid.gradients());
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task fluxes(fluid::Fluid<D>& fluid, const std::string& label) {
    return {.name = "fluxes (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts, resource::fluid_gradients,
                      resource::ghost_gradients, resource::fluid_shift},
            .writes = {resource::fluid_rates},
            .body = [&fluid] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    compute_fluxes(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, fluid.tait,
                                   fluid.lanes(block));
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task viscosity(fluid::Fluid<D>& fluid, const std::string& label) {
    return {.name = "viscosity (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts},
            .writes = {resource::fluid_rates},
            .body = [&fluid] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    add_viscosity(fluid.particles, fluid.lists, fluid.kernel, fluid.viscosity, fluid.lanes(block));
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task x_sph(fluid::Fluid<D>& fluid, const std::string& label) {
    return {.name = "X-SPH (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts},
            .writes = {resource::fluid_shift},
            .body = [&fluid] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    compute_x_sph(fluid.particles, fluid.lists, fluid.kernel, fluid.x_sph, fluid.lanes(block));
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task free_surface(fluid::Fluid<D>& fluid, const std::string& label) {
    return {.name = "free surface (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts, resource::fluid_gradients,
                      resource::ghost_gradients},
            .writes = {resource::fluid_surface},
            .body = [&fluid] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    detect_free_surface(fluid.particles, fluid.lists, fluid.kernel, fluid.surface, fluid.lanes(block));
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task shifting(fluid::Fluid<D>& fluid, const std::string& label) {
    return {.name = "shifting (" + label + ")",
            .reads = {resource::fluid_lists, resource::fluid_state, resource::fluid_surface},
            .writes = {resource::fluid_shift},
            .body = [&fluid] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    compute_shift(fluid.particles, fluid.lists, fluid.kernel, fluid.surface, fluid.lanes(block));
                    report_work(fluid.lists.blocks[block].pairs);
                });
            }};
}

template <int D>
Task energy_ledger(fluid::Fluid<D>& fluid, const Clock& clock, int stage, const std::string& label) {
    return {
        .name = "energy ledger (" + label + ")",
        .reads = {resource::clock_step, resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts,
                  resource::fluid_gradients, resource::ghost_gradients, resource::fluid_rates, resource::fluid_shift},
        .writes = {resource::fluid_ledger},
        .body = [&fluid, &clock, stage] {
            fluid.ledger.part.resize(fluid.blocks());
            for_each_block(fluid.blocks(), [&](std::size_t block) {
                fluid.ledger.part[block] = energy_rates(fluid.particles, fluid.lists, fluid.kernel, fluid.flux,
                                                        fluid.tait, fluid.viscosity, fluid.lanes(block));
                report_work(fluid.lists.blocks[block].pairs);
            });
            fluid.ledger.accumulate(fluid.integration.scheme, stage, clock.step);
        }};
}

template <int D>
Task prediction(fluid::Fluid<D>& fluid, const Clock& clock) {
    return {.name = "prediction",
            .reads = {resource::clock_step, resource::fluid_lists, resource::fluid_rates, resource::fluid_shift},
            .writes = {resource::fluid_state},
            .body = [&fluid, &clock] {
                for_each_block(fluid.blocks(), blocks_without_pairs, [&](std::size_t block) {
                    predict(fluid.particles, fluid.integration, fluid.tait, clock.step, fluid.lanes(block));
                });
            }};
}

template <int D>
Task integration_stage(fluid::Fluid<D>& fluid, const Clock& clock, int stage) {
    const bool verlet = fluid.integration.scheme == fluid::IntegrationScheme::verlet;
    return {.name = verlet ? "correction" : "Runge-Kutta (stage " + std::to_string(stage + 1) + ")",
            .reads = {resource::clock_step, resource::fluid_lists, resource::fluid_rates, resource::fluid_shift},
            .writes = {resource::fluid_state},
            .body = [&fluid, &clock, stage] {
                for_each_block(fluid.blocks(), blocks_without_pairs, [&](std::size_t block) {
                    advance_stage(fluid.particles, fluid.integration, fluid.tait, stage, clock.step,
                                  fluid.lanes(block));
                });
            }};
}

template Task gradients(fluid::Fluid<2>&, const std::string&);
template Task gradients(fluid::Fluid<3>&, const std::string&);
template Task fluxes(fluid::Fluid<2>&, const std::string&);
template Task fluxes(fluid::Fluid<3>&, const std::string&);
template Task viscosity(fluid::Fluid<2>&, const std::string&);
template Task viscosity(fluid::Fluid<3>&, const std::string&);
template Task x_sph(fluid::Fluid<2>&, const std::string&);
template Task x_sph(fluid::Fluid<3>&, const std::string&);
template Task free_surface(fluid::Fluid<2>&, const std::string&);
template Task free_surface(fluid::Fluid<3>&, const std::string&);
template Task shifting(fluid::Fluid<2>&, const std::string&);
template Task shifting(fluid::Fluid<3>&, const std::string&);
template Task energy_ledger(fluid::Fluid<2>&, const Clock&, int, const std::string&);
template Task energy_ledger(fluid::Fluid<3>&, const Clock&, int, const std::string&);
template Task prediction(fluid::Fluid<2>&, const Clock&);
template Task prediction(fluid::Fluid<3>&, const Clock&);
template Task integration_stage(fluid::Fluid<2>&, const Clock&, int);
template Task integration_stage(fluid::Fluid<3>&, const Clock&, int);

}  // namespace aquagraph::tasks
