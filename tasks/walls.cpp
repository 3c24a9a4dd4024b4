#include "tasks/walls.hpp"

#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::tasks {

namespace {
fluid::Vec2 gravity_of(const fluid::Fluid<2>& fluid) {
    return {fluid.flux.gravity[0], fluid.flux.gravity[1]};
}
}  // namespace

Task wall_motion(fluid::GhostWalls& walls, const coupling::Interface& interface, const Clock& clock, double fraction,
                 const std::string& label) {
    return {.name = "wall motion (" + label + ")",
            .reads = {resource::clock_step, resource::interface_motion, resource::fluid_lists},
            .writes = {resource::walls},
            .body = [&walls, &interface, &clock, fraction] {
                interface.surface.place(walls.panels, clock.elapsed + fraction * clock.step);
                walls.update_geometry();
            }};
}

Task ghost_state(fluid::Fluid<2>& fluid, const fluid::GhostWalls& walls, const std::string& label) {
    return {.name = "ghosts (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state},
            .writes = {resource::fluid_ghosts},
            .body = [&fluid, &walls] {
                for_each_block(walls.blocks(), [&](std::size_t block) {
                    walls.update_state(fluid.particles, gravity_of(fluid), block);
                });
            }};
}

Task wall_contact(fluid::Fluid<2>& fluid, const fluid::GhostWalls& walls, const std::string& label) {
    return {.name = "wall contact (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists},
            .writes = {resource::fluid_state},
            .body = [&fluid, &walls] { fluid.held_back += walls.hold_back(fluid.particles, fluid.spacing); }};
}

Task ghost_gradients(fluid::Fluid<2>& fluid, const fluid::GhostWalls& walls, const std::string& label) {
    return {.name = "ghost gradients (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state, resource::fluid_gradients},
            .writes = {resource::ghost_gradients},
            .body = [&fluid, &walls] {
                for_each_block(walls.blocks(), [&](std::size_t block) {
                    walls.update_gradients(fluid.particles, gravity_of(fluid), block);
                });
            }};
}

}  // namespace aquagraph::tasks
