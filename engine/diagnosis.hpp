// What to tell a user about a run that cannot go on.
#pragma once
#include <string>

#include "engine/model.hpp"
#include "tasks/task_error.hpp"

namespace aquagraph::engine {

// What has failed in which task, at what time and step, and the likely cause. Of a particle that cannot be computed
// further also ids, positions and neighbours, as a few lines of text.
template <int D>
std::string describe(const Model<D>& model, const tasks::TaskError& error);

}  // namespace aquagraph::engine
