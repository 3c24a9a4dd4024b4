// The trials of a cycle that is iterated until fluid and solid agree.
#pragma once
#include <functional>

#include "physics/clock.hpp"
#include "physics/coupling/interface.hpp"

namespace aquagraph::engine {

// Runs `trial`, which goes back to the start of the cycle first and ends by comparing what came out with the guess,
// until there have been enough. What fails because of the guess (the water cannot follow the wall, or the solid's
// Newton does not converge) is tried again with a smaller one; throws its tasks::TaskError when that has not helped,
// and any other at once.
void run_trials(coupling::Interface& interface, const Clock& clock, const std::function<void()>& trial);

}  // namespace aquagraph::engine
