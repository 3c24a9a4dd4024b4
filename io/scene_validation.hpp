// What no single key shows: geometry, names and parts of a scene that do not fit together.
#pragma once
#include "io/complaints.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

// Looks at a scene already filled; leaves out what builds on a key that `complaints` holds something against.
void validate(const Scene& scene, Complaints& complaints);

}  // namespace aquagraph::io
