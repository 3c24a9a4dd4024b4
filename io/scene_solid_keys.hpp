// The sections and keys of a scene's solid: a part of scene_table().
#pragma once
#include "io/scene_keys.hpp"

namespace aquagraph::io {

std::span<const SceneSection> solid_sections();
std::span<const SceneKey> solid_keys();

}  // namespace aquagraph::io
