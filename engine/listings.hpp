// The algorithm: one coupling cycle as a sequential listing of tasks, from which the graph is derived.
#pragma once
#include <vector>

#include "engine/model.hpp"
#include "tasks/task.hpp"

namespace aquagraph::engine {

// Three listings: `steps` is all there is, unless it is iterated between `begin` and `end`.
struct CycleListing {
    std::vector<tasks::Task> begin, steps, end;
    bool iterated = false;
};

// The cycle of the scene's algorithm: p fluid steps and one solid step; without a solid, p is 1 and there is one fluid
// step. Results are added by the caller at the end (engine/results.hpp).
template <int D>
CycleListing coupling_cycle(Model<D>& model, const io::CouplingScene& coupling, int p);
// All in one, with the present p: the scene's, or where it is regulated the one that the last cycle has chosen.
template <int D>
std::vector<tasks::Task> coupling_cycle(Model<D>& model, const io::CouplingScene& coupling);

// The loads of the present state: wet panels and lists must be there.
std::vector<tasks::Task> first_loads(Model<2>& model);

// What an integration that keeps the rates of the step before (Verlet) needs before the first one: lists, then the
// rates of the initial state. Empty for the others.
template <int D>
std::vector<tasks::Task> first_evaluation(Model<D>& model);

}  // namespace aquagraph::engine
