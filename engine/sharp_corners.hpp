// Corners that ghost particles do not fill: the images in two walls and through their corner cover four times the angle
// that the water has, which is 240° at 60°. What is missing lies opposite to the tip and weighs little until the angle
// is small: within 2 Δx of the tip the partition of unity lacks 2 to 6 % at 60 to 50°, 5 to 12 % at 45°, 14 to 17 % at
// 30° (means over shifted lattices, R = 4 Δx; at 75° nothing). Walls of normal fluxes have no such
// limit.
#pragma once
#include <string>
#include <vector>

#include "engine/model.hpp"

namespace aquagraph::engine {

inline constexpr double sharpest_of_ghosts = 60;  // [°]

// What is to be said of every corner of ghost walls in the plane that water fills to less than 60°, with wall and
// place.
std::vector<std::string> sharp_corners(const fluid::Panels<2>& panels);

}  // namespace aquagraph::engine
