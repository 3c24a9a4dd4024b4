#include "tasks/flux_walls.hpp"

#include <memory>

#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/statistics.hpp"

namespace aquagraph::tasks {

template <int D>
Task wall_gamma(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall gamma (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state},
            .writes = {resource::wall_gamma},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(),
                               [&](std::size_t block) { walls.compute_gamma(fluid.particles, fluid.kernel, block); });
                walls.floor_count += walls.floored();
            }};
}

template <int D>
Task wall_gradients(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall gradients (" + label + ")",
            .reads = {resource::walls, resource::wall_gamma, resource::fluid_lists, resource::fluid_state,
                      resource::fluid_ghosts},
            .writes = {resource::fluid_gradients, resource::wall_moments},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    walls.complete_gradients(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, block);
                    report_work(walls.pairs(block));
                });
            }};
}

template <int D>
Task wall_crowding(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall crowding (" + label + ")",
            .reads = {resource::fluid_lists, resource::wall_gamma, resource::wall_moments},
            .writes = {resource::fluid_surface},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(),
                               [&](std::size_t block) { walls.complete_crowding(fluid.surface, block); });
            }};
}

template <int D>
Task wall_friction(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall friction (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state},
            .writes = {resource::fluid_rates},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    walls.add_shear(fluid.particles, fluid.kernel, fluid.viscosity, fluid.spacing, block);
                    report_work(walls.pairs(block));
                });
            }};
}

template <int D>
Task wall_fluxes(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall fluxes (" + label + ")",
            .reads = {resource::walls, resource::wall_gamma, resource::wall_moments, resource::fluid_lists,
                      resource::fluid_state, resource::fluid_gradients, resource::fluid_shift},
            .writes = {resource::fluid_rates},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    walls.add_fluxes(fluid.particles, fluid.kernel, fluid.flux, fluid.tait.reference_density, block);
                    report_work(walls.pairs(block));
                });
            }};
}

template <int D>
Task energy_ledger(fluid::Fluid<D>& fluid, const fluid::NormalFluxWalls<D>& walls,
                   std::vector<fluid::WallWork<D>>& works, const Clock& clock, int stage, const std::string& label) {
    auto power = std::make_shared<std::vector<double>>();  // of each wall, block by block
    return {.name = "energy ledger (" + label + ")",
            .reads = {resource::clock_step, resource::walls, resource::wall_gamma, resource::fluid_lists,
                      resource::fluid_state, resource::fluid_ghosts, resource::fluid_gradients,
                      resource::ghost_gradients, resource::fluid_rates, resource::fluid_shift},
            .writes = {resource::fluid_ledger},
            .body = [&fluid, &walls, &works, &clock, stage, power] {
                const std::size_t n = walls.panels.names.size();
                power->assign(n * fluid.blocks(), 0.0);
                fluid.ledger.part.resize(fluid.blocks());
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    fluid.ledger.part[block] = walls.energy_rates(
                        fluid.particles, fluid.lists, fluid.kernel, fluid.flux, fluid.tait, fluid.viscosity,
                        fluid.spacing, block, std::span(*power).subspan(n * block, n));
                    report_work(fluid.lists.blocks[block].pairs);
                });
                if (fluid.ledger.kept) fluid.ledger.accumulate(fluid.integration.scheme, stage, clock.step);
                for (fluid::WallWork<D>& work : works) {
                    work.ledger.part.assign(fluid.blocks(), {});
                    for (std::size_t block = 0; block < fluid.blocks(); ++block)
                        work.ledger.part[block].walls = (*power)[n * block + std::size_t(work.pairs.wall())];
                    work.ledger.accumulate(fluid.integration.scheme, stage, clock.step);
                }
            }};
}

template Task wall_crowding(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_crowding(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);
template Task wall_friction(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_friction(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);
template Task energy_ledger(fluid::Fluid<2>&, const fluid::NormalFluxWalls<2>&, std::vector<fluid::WallWork<2>>&,
                            const Clock&, int, const std::string&);
template Task energy_ledger(fluid::Fluid<3>&, const fluid::NormalFluxWalls<3>&, std::vector<fluid::WallWork<3>>&,
                            const Clock&, int, const std::string&);
template Task wall_gamma(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_gamma(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);
template Task wall_gradients(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_gradients(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);
template Task wall_fluxes(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_fluxes(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);

}  // namespace aquagraph::tasks
