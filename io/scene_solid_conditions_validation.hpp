// What is wrong with what moves, presses and reinforces the solid of a scene.
#pragma once
#include "io/complaints.hpp"
#include "io/scene.hpp"

namespace aquagraph::io {

// Motions, pressures, rigid bodies, contacts, cords. The scene has a solid.
void validate_solid_conditions(const Scene& scene, Complaints& complaints);

}  // namespace aquagraph::io
