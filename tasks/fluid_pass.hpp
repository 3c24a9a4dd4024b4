// The passes over fluid particles as tasks: gradients, fluxes, a Runge–Kutta stage.
#pragma once
#include "physics/clock.hpp"
#include "physics/fluid/fluid.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// References given to these functions must outlive the tasks. `label` tells tasks of a family apart: "stage 2".

template <int D>
Task gradients(fluid::Fluid<D>& fluid, const std::string& label);
template <int D>
Task fluxes(fluid::Fluid<D>& fluid, const std::string& label);
// stage: 0 … 3; reads Δt from the clock.
template <int D>
Task runge_kutta_stage(fluid::Fluid<D>& fluid, const Clock& clock, int stage);

}  // namespace aquagraph::tasks
