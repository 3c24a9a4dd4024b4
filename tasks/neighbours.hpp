// The neighbour search as a task: looks whether the lists still hold for the coming step and rebuilds them if not.
#pragma once
#include "physics/clock.hpp"
#include "physics/coupling/interface.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/walls/motion.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// walls: null where the scene has none; moving: where none of them moves by itself; interface: without a solid. A
// rebuild takes out particles that have left an open domain, re-sorts the others, mirrors them anew and renews the
// lists and everything that is indexed like them. Throws SickParticle (tasks/stepping.hpp) if a particle has passed
// through a wall.
template <int D>
Task neighbour_search(fluid::Fluid<D>& fluid, fluid::GhostWalls<D>* walls, const fluid::MovingWalls<D>* moving,
                      coupling::Interface* interface, const Clock& clock, const std::string& label);

// The same with walls of the normal flux method: which particles see which parts of them is decided here as well.
template <int D>
Task neighbour_search(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const fluid::MovingWalls<D>* moving,
                      coupling::Interface* interface, const Clock& clock, const std::string& label);

}  // namespace aquagraph::tasks
