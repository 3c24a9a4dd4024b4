// Walls of ghost particles as tasks, refreshed at every substep. What both kinds of walls have: either_walls.hpp.
#pragma once
#include "physics/clock.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/walls/wall_forces.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// Places the ghosts and gives them their parents' state.
template <int D>
Task ghost_state(fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, const std::string& label);
template <int D>
Task ghost_gradients(fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, const std::string& label);

// Adds the power of single walls at this stage to their work; reads Δt from the clock.
template <int D>
Task wall_work(const fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, std::vector<fluid::WallWork<D>>& works,
               const Clock& clock, int stage, const std::string& label);
// δv of periodic images.
template <int D>
Task ghost_shift(fluid::Fluid<D>& fluid, const fluid::GhostWalls<D>& walls, const std::string& label);

}  // namespace aquagraph::tasks
