// The algorithm: one coupling cycle as a sequential listing of tasks, from which the graph is derived.
#pragma once
#include <vector>

#include "engine/model.hpp"
#include "tasks/task.hpp"

namespace aquagraph::engine {

// The cycle of the scene's algorithm: p fluid steps and one solid step; without a solid, one fluid step.
// Results are added by the caller at the end (engine/results.hpp).
template <int D>
std::vector<tasks::Task> coupling_cycle(Model<D>& model, const io::CouplingScene& coupling);

// What an integration that keeps the rates of the step before (Verlet) needs before the first one: lists, then the
// rates of the initial state. Empty for the others.
template <int D>
std::vector<tasks::Task> first_evaluation(Model<D>& model);

}  // namespace aquagraph::engine
