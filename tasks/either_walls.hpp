// Tasks that walls of ghosts and walls of normal fluxes have in common.
#pragma once
#include "physics/clock.hpp"
#include "physics/coupling/interface.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/motion.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// Walls: fluid::GhostWalls or fluid::NormalFluxWalls.

// Moves the walls to `fraction` of the present step (0 … 1): those with a prescribed motion exactly, wet panels
// extrapolated from the last exchange. moving and interface: null where the scene has none.
template <int D, template <int> class Walls>
Task wall_motion(Walls<D>& walls, const fluid::MovingWalls<D>* moving, const coupling::Interface* interface,
                 const Clock& clock, double fraction, const std::string& label);
// After the last stage: stops lone particles at the walls (hold_back of the walls).
template <int D, template <int> class Walls>
Task wall_contact(fluid::Fluid<D>& fluid, const Walls<D>& walls, const std::string& label);

}  // namespace aquagraph::tasks
