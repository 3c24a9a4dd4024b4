// What a scene models and what it will cost, without running it.
#pragma once
#include <iosfwd>

#include "io/scene.hpp"

namespace aquagraph::engine {

// Prints particles, elements, time step, steps, memory and an estimate of the run time on `threads` threads (0: all
// cores): one evaluation of the fluid is timed on the initial particles, and a step of the body. Throws as make_model.
void check(const io::Scene& scene, int threads, std::ostream& out);

}  // namespace aquagraph::engine
