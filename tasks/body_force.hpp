// Body forces beyond constant gravity as tasks: they add to the rates that the fluxes have set.
#pragma once
#include <array>
#include <string>

#include "physics/fluid/body_forces.hpp"
#include "physics/fluid/fluid.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// References must outlive the task. `label` tells tasks of a family apart: "stage 2".
template <int D>
Task central_force(fluid::Fluid<D>& fluid, const fluid::CentralForce<D>& force, const std::string& label);

// a [m/s²]
template <int D>
Task driving_force(fluid::Fluid<D>& fluid, const std::array<double, D>& a, const std::string& label);

}  // namespace aquagraph::tasks
