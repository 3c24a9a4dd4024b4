// Walls of the normal flux method as tasks: no ghosts, hence no passes over them; instead γ, and what walls add to
// gradients and fluxes. What both kinds of walls have: either_walls.hpp.
#pragma once
#include "physics/clock.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "physics/fluid/walls/wall_forces.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

template <int D>
Task wall_gamma(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// After the gradients.
template <int D>
Task wall_gradients(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// Between free_surface and shifting.
template <int D>
Task wall_crowding(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// Between fluxes (and viscosity) and wall_fluxes, which divide all of them by γ.
template <int D>
Task wall_friction(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// After the fluxes, before body forces.
template <int D>
Task wall_fluxes(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// Adds the energy rates of this stage to the fluid's ledger and to the works of single walls; reads Δt from the clock.
template <int D>
Task energy_ledger(fluid::Fluid<D>& fluid, const fluid::NormalFluxWalls<D>& walls,
                   std::vector<fluid::WallWork<D>>& works, const Clock& clock, int stage, const std::string& label);

}  // namespace aquagraph::tasks
