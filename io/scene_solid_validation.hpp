// What must hold of a scene's solid beyond the range of each key.
#pragma once
#include "io/complaints.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

void validate_solid(const Scene& scene, Complaints& complaints);

}  // namespace aquagraph::io
