#include "tasks/walls.hpp"

#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::tasks {

namespace {
template <int D>
fluid::Vec<D> gravity_of(const fluid::Fluid<D>& fluid) {
    return fluid::Vec<D>(fluid.flux.gravity);
}
}  // namespace

template <int D>
Task ghost_state(fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, const std::string& label) {
    return {.name = "ghosts (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state},
            .writes = {resource::fluid_ghosts},
            .body = [&fluid, &walls] {
                for_each_block(walls.blocks(), [&](std::size_t block) {
                    walls.update_state(fluid.particles, gravity_of(fluid), block);
                });
            }};
}

template <int D>
Task ghost_gradients(fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, const std::string& label) {
    return {.name = "ghost gradients (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state, resource::fluid_gradients},
            .writes = {resource::ghost_gradients},
            .body = [&fluid, &walls] {
                for_each_block(walls.blocks(), [&](std::size_t block) {
                    walls.update_gradients(fluid.particles, gravity_of(fluid), block);
                });
            }};
}

template <int D>
Task wall_work(const fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, std::vector<fluid::WallWork<D>>& works,
               const Clock& clock, int stage, const std::string& label) {
    return {
        .name = "wall work (" + label + ")",
        .reads = {resource::clock_step, resource::fluid_lists, resource::fluid_state, resource::fluid_ghosts,
                  resource::fluid_gradients, resource::ghost_gradients, resource::fluid_rates, resource::fluid_shift},
        .writes = {resource::fluid_ledger},
        .body = [&fluid, &walls, &works, &clock, stage] {
            for (fluid::WallWork<D>& work : works) {
                work.pairs.rebuild(fluid, walls);
                work.ledger.part.resize(work.pairs.blocks());
                for_each_block(work.pairs.blocks(),
                               [&](std::size_t block) { work.ledger.part[block] = work.pairs.power(fluid, block); });
                work.ledger.accumulate(fluid.integration.scheme, stage, clock.step);
            }
        }};
}

template Task wall_work(const fluid::Fluid<2>&, const fluid::GhostWalls<2>&, std::vector<fluid::WallWork<2>>&,
                        const Clock&, int, const std::string&);
template Task wall_work(const fluid::Fluid<3>&, const fluid::GhostWalls<3>&, std::vector<fluid::WallWork<3>>&,
                        const Clock&, int, const std::string&);

template <int D>
Task ghost_shift(fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, const std::string& label) {
    return {.name = "ghost shift (" + label + ")",
            .reads = {resource::fluid_lists},
            .writes = {resource::fluid_shift},
            .body = [&fluid, &walls] {
                for_each_block(walls.blocks(), [&](std::size_t block) { walls.update_shift(fluid.particles, block); });
            }};
}

template Task ghost_shift(fluid::Fluid<2>&, const fluid::GhostWalls<2>&, const std::string&);
template Task ghost_shift(fluid::Fluid<3>&, const fluid::GhostWalls<3>&, const std::string&);
template Task ghost_state(fluid::Fluid<2>&, const fluid::GhostWalls<2>&, const std::string&);
template Task ghost_state(fluid::Fluid<3>&, const fluid::GhostWalls<3>&, const std::string&);
template Task ghost_gradients(fluid::Fluid<2>&, const fluid::GhostWalls<2>&, const std::string&);
template Task ghost_gradients(fluid::Fluid<3>&, const fluid::GhostWalls<3>&, const std::string&);

}  // namespace aquagraph::tasks
