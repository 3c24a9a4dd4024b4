// What is wrong with the shapes of walls, their motions and the bodies of water of a scene.
#pragma once
#include "io/complaints.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

void validate_wall_shapes(const Scene& scene, Complaints& complaints);
void validate_motions(const Scene& scene, Complaints& complaints);
void validate_regions(const Scene& scene, Complaints& complaints);

}  // namespace aquagraph::io
