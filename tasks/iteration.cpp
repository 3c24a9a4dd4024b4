#include "tasks/iteration.hpp"

#include <utility>

#include "physics/fluid/rebuild.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::tasks {

Task begin_iterations(const IteratedParts& parts, CycleStart& start) {
    return {.name = "start of iterations",
            .reads = {resource::clock, resource::fluid, resource::solid_state, resource::interface_motion},
            .writes = {resource::interface_guess},
            .body = [parts, &start] {
                start.left = false;
                start.fluid.take(parts.fluid, parts.clock);
                start.works.resize(parts.works.size());
                start.last_works.resize(parts.works.size());
                for (std::size_t k = 0; k < parts.works.size(); ++k) {
                    start.works[k] = parts.works[k].ledger.sum;
                    start.last_works[k] = parts.works[k].ledger.last;
                }
                parts.solid.save(start.solid);
                start.borne_loads = parts.interface.borne_loads;
                if (parts.flux_walls) start.floor_count = parts.flux_walls->floor_count;
                coupling::WetSurface& surface = parts.interface.surface;
                surface.state(start.y, parts.clock.cycle);
                surface.extrapolated(start.guess, parts.clock.cycle);
                parts.interface.fixed_point.begin(start.y, start.guess);
                surface.head_for(start.guess, parts.clock.cycle);
            }};
}

Task back_to_start(const IteratedParts& parts, CycleStart& start) {
    return {.name = "back to the start",
            .reads = {resource::interface_guess},
            .writes = {resource::clock, resource::fluid, resource::walls, resource::solid_state},
            .body = [parts, &start] {
                if (!std::exchange(start.left, true)) return;  // there already
                const bool renewed = start.fluid.give_back(parts.fluid, parts.clock);
                for (std::size_t k = 0; k < parts.works.size(); ++k) {
                    parts.works[k].ledger.sum = start.works[k];
                    parts.works[k].ledger.last = start.last_works[k];
                }
                parts.solid.restore(start.solid);
                parts.interface.borne_loads = start.borne_loads;
                fluid::Panels<2>& panels = parts.panels();
                if (parts.moving) parts.moving->place(panels, parts.clock.time);
                parts.interface.surface.place(panels, parts.clock.elapsed);
                if (parts.flux_walls) {
                    parts.flux_walls->floor_count = start.floor_count;
                    parts.flux_walls->update_geometry();
                }
                if (!renewed) return;
                if (parts.flux_walls) {
                    rebuild_lists(parts.fluid, *parts.flux_walls, parallel_loop);
                    parts.interface.rebuild(parts.fluid, *parts.flux_walls, parallel_loop);
                } else {
                    rebuild_lists(parts.fluid, parts.walls, parallel_loop);
                    parts.interface.rebuild(parts.fluid, *parts.walls, parallel_loop);
                }
                parts.fluid.record.walls = panels.position;
                start.fluid.take(parts.fluid, parts.clock);  // in the new order
            }};
}

Task relaxation(const IteratedParts& parts, CycleStart& start) {
    return {.name = "relaxation",
            .reads = {resource::solid_state, resource::clock_cycle},
            .writes = {resource::interface_guess, resource::interface_motion},
            .body = [parts, &start] {
                coupling::Interface& interface = parts.interface;
                interface.surface.state_of(parts.solid.positions(), parts.solid.velocities(), start.y,
                                           parts.clock.cycle);
                interface.fixed_point.update(start.y);
                if (interface.fixed_point.finished())
                    interface.fixed_point.end();
                else
                    interface.surface.head_for(interface.fixed_point.guess(), parts.clock.cycle);
            }};
}

}  // namespace aquagraph::tasks
