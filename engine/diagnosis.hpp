// What to tell a user about a particle that cannot be computed further.
#pragma once
#include <string>

#include "engine/model.hpp"
#include "tasks/stepping.hpp"

namespace aquagraph::engine {

// Time, ids, positions, neighbours and the likely cause, as a few lines of text.
template <int D>
std::string describe(const Model<D>& model, const tasks::SickParticle& sick);

}  // namespace aquagraph::engine
