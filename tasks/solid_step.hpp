// The finite element side and the exchange with the fluid as tasks.
#pragma once
#include "physics/clock.hpp"
#include "physics/coupling/interface.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/solid/solver.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// Which loads the solve reads: the one difference between the two algorithms. With `last_exchange` (CPS) it depends on
// nothing that the fluid does in this cycle and runs beside it; with `this_cycle` (CSS) it waits for the fluid's loads.
enum class LoadsOf { last_exchange, this_cycle };

// Advances the solid over the cycle: one step of clock.cycle.
Task newton_solve(solid::Solver<2>& solid, const coupling::Interface& interface, const Clock& clock, LoadsOf loads);

// Gradients of the particles that the load reads, at the end of the fluid's steps.
Task interface_gradients(fluid::Fluid<2>& fluid, const coupling::Interface& interface);
// The fluid's load on every wet node.
Task interface_loads(fluid::Fluid<2>& fluid, const fluid::GhostWalls<2>& walls, coupling::Interface& interface);
// Hands loads to the solid and wet nodes to the fluid, and starts a new cycle.
Task exchange(const solid::Solver<2>& solid, coupling::Interface& interface, Clock& clock);

}  // namespace aquagraph::tasks
