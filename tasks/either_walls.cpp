#include "tasks/either_walls.hpp"

#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::tasks {

template <int D, template <int> class Walls>
Task wall_motion(Walls<D>& walls, const fluid::MovingWalls<D>* moving, const coupling::Interface* interface,
                 const Clock& clock, double fraction, const std::string& label) {
    return {.name = "wall motion (" + label + ")",
            .reads = {resource::clock_step, resource::interface_motion, resource::fluid_lists},
            .writes = {resource::walls},
            .body = [&walls, moving, interface, &clock, fraction] {
                if (moving) moving->place(walls.panels, clock.time + fraction * clock.step);
                if constexpr (D == 2)
                    if (interface) interface->surface.place(walls.panels, clock.elapsed + fraction * clock.step);
                walls.update_geometry();
            }};
}

template <int D, template <int> class Walls>
Task wall_contact(fluid::Fluid<D>& fluid, const Walls<D>& walls, const std::string& label) {
    return {.name = "wall contact (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists},
            .writes = {resource::fluid_state},
            .body = [&fluid, &walls] {
                book_loss(fluid, [&] { fluid.held_back += walls.hold_back(fluid.particles, fluid.spacing); });
            }};
}

template Task wall_motion(fluid::GhostWalls<2>&, const fluid::MovingWalls<2>*, const coupling::Interface*, const Clock&,
                          double, const std::string&);
template Task wall_motion(fluid::GhostWalls<3>&, const fluid::MovingWalls<3>*, const coupling::Interface*, const Clock&,
                          double, const std::string&);
template Task wall_motion(fluid::NormalFluxWalls<2>&, const fluid::MovingWalls<2>*, const coupling::Interface*,
                          const Clock&, double, const std::string&);
template Task wall_motion(fluid::NormalFluxWalls<3>&, const fluid::MovingWalls<3>*, const coupling::Interface*,
                          const Clock&, double, const std::string&);
template Task wall_contact(fluid::Fluid<2>&, const fluid::GhostWalls<2>&, const std::string&);
template Task wall_contact(fluid::Fluid<3>&, const fluid::GhostWalls<3>&, const std::string&);
template Task wall_contact(fluid::Fluid<2>&, const fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_contact(fluid::Fluid<3>&, const fluid::NormalFluxWalls<3>&, const std::string&);

}  // namespace aquagraph::tasks
