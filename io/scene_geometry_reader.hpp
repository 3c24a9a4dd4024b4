// Shapes, motions and bodies of water out of a checked document.
#pragma once
#include "io/scene.hpp"
#include "io/toml_document.hpp"

namespace aquagraph::io {

// at: "wall[2]". Leaves alone what is not given. Paths are seen from `folder`.
void read_wall_geometry(const CheckedDocument& document, const std::string& at, const std::filesystem::path& folder,
                        WallScene& wall);
// Polygons, discs, spheres and volumes, and the velocities of boxes. dimension: of the scene.
void read_water(const CheckedDocument& document, const std::filesystem::path& folder, int dimension, FluidScene& fluid);

}  // namespace aquagraph::io
