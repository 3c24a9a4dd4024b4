// The sections and keys of a scene's fluid: a part of scene_table().
#pragma once
#include "io/scene_keys.hpp"

namespace aquagraph::io {

std::span<const SceneSection> fluid_sections();
std::span<const SceneKey> fluid_keys();

}  // namespace aquagraph::io
