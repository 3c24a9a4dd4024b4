// A step of a body on its own, without water: time step, loads, finite element solve, clock.
#pragma once
#include "physics/clock.hpp"
#include "physics/solid/dead_loads.hpp"
#include "physics/solid/structure.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// The next step: the rest of the run in equal parts, none longer than `longest` [s], which may still change: the task
// keeps the reference.
Task structural_time_step(Clock& clock, const double& longest);

// forces = the loads at the end of the step.
Task dead_loads(const std::vector<solid::DeadLoad>& loads, const Clock& clock, std::vector<double>& forces);

// One step of clock.step under these forces, D × nodes …
template <int D>
Task structural_step(solid::Structure<D>& solid, const std::vector<double>& forces, const Clock& clock);
// … or the equilibrium under them, and under what is prescribed for the end of the step.
template <int D>
Task structural_equilibrium(solid::Structure<D>& solid, const std::vector<double>& forces, const Clock& clock);

}  // namespace aquagraph::tasks
