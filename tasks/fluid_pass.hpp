// The passes over fluid particles as tasks: gradients, fluxes, viscosity, transport, the stages of the integration.
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
// Adds to the rates of the fluxes.
template <int D>
Task viscosity(fluid::Fluid<D>& fluid, const std::string& label);

// How particles move otherwise than with the water: once a step, from the state at its first evaluation.
template <int D>
Task x_sph(fluid::Fluid<D>& fluid, const std::string& label);
template <int D>
Task free_surface(fluid::Fluid<D>& fluid, const std::string& label);
template <int D>
Task shifting(fluid::Fluid<D>& fluid, const std::string& label);

// Adds the energy rates of this stage to the fluid's ledger; reads Δt from the clock.
template <int D>
Task energy_ledger(fluid::Fluid<D>& fluid, const Clock& clock, int stage, const std::string& label);

// The first half of a step of an integration that predicts; reads Δt from the clock.
template <int D>
Task prediction(fluid::Fluid<D>& fluid, const Clock& clock);
// stage: 0 … fluid.integration.stages() - 1; reads Δt from the clock.
template <int D>
Task integration_stage(fluid::Fluid<D>& fluid, const Clock& clock, int stage);

}  // namespace aquagraph::tasks
