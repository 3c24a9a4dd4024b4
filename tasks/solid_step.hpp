// The finite element side and the exchange with the fluid as tasks.
#pragma once
#include "physics/clock.hpp"
#include "physics/coupling/interface.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "physics/solid/structure.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// Which loads the solve reads: the one difference between the two algorithms. With `last_exchange` (CPS) it depends on
// nothing that the fluid does in this cycle and runs beside it; with `this_cycle` (CSS) it waits for the fluid's loads.
enum class LoadsOf { last_exchange, this_cycle };

// Advances the solid over the cycle, clock.cycle: one step, or as many as an explicit scheme needs.
Task newton_solve(solid::Structure<2>& solid, coupling::Interface& interface, const Clock& clock, LoadsOf loads);

// Gradients of the particles that the load reads, at the end of the fluid's steps.
Task interface_gradients(fluid::Fluid<2>& fluid, const coupling::Interface& interface);
// The fluid's load on every wet node: force conservative, times 1 + ε.
Task interface_loads(fluid::Fluid<2>& fluid, const fluid::GhostWalls<2>& walls, coupling::Interface& interface);
// The same with walls of normal fluxes, after an evaluation of the rates at the end of the fluid's steps: the reaction
// to what the wall has done to every particle (NormalFluxWalls::add_reactions).
Task interface_loads(fluid::Fluid<2>& fluid, const fluid::NormalFluxWalls<2>& walls, coupling::Interface& interface);
// Or from averaged pressures.
Task averaged_loads(const fluid::Fluid<2>& fluid, const fluid::Panels<2>& panels, coupling::Interface& interface);
// Books what the cycle has moved across the interface, after the solve and before the exchange: work_on_fluid is what
// the body has given to the fluid since the start [J/m]. Corrects ε.
Task interface_energy(const solid::Structure<2>& solid, coupling::Interface& interface, const double& work_on_fluid);
// Hands loads to the solid and wet nodes to the fluid, and starts a new cycle.
Task exchange(const solid::Structure<2>& solid, coupling::Interface& interface, Clock& clock);
// Chooses p of the next cycle.
Task regulate_ratio(coupling::Interface& interface);

}  // namespace aquagraph::tasks
