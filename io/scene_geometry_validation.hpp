// What is wrong with the shapes of walls, their motions and the bodies of water of a scene.
#pragma once
#include "io/complaints.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

// Neighbour lists know particles by numbers of 32 bits.
inline constexpr double most_particles = 2e9;
// Nodes have numbers of 31 bits, and there are up to four of them per element.
inline constexpr double most_elements = 2e8;

void validate_wall_shapes(const Scene& scene, Complaints& complaints);
void validate_motions(const Scene& scene, Complaints& complaints);
void validate_regions(const Scene& scene, Complaints& complaints);

}  // namespace aquagraph::io
