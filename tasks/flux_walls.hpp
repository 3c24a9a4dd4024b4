// Walls of the normal flux method as tasks: no ghosts, hence no passes over them; instead γ, and what walls add to
// gradients and fluxes.
#pragma once
#include "physics/clock.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// As tasks/neighbours.hpp; which particles see which parts of the walls is decided here as well.
template <int D>
Task neighbour_search(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const Clock& clock,
                      const std::string& label);
template <int D>
Task wall_gamma(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// After the gradients.
template <int D>
Task wall_gradients(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// After the fluxes.
template <int D>
Task wall_fluxes(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label);
// After the last stage: NormalFluxWalls::hold_back.
template <int D>
Task wall_contact(fluid::Fluid<D>& fluid, const fluid::NormalFluxWalls<D>& walls, const std::string& label);

}  // namespace aquagraph::tasks
