// The files beside the scene that its solid depends on.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "io/scene_solid.hpp"

namespace aquagraph::io {

// Key of the scene -> file: mesh, measured curves, tables of loads and motions.
std::map<std::string, std::filesystem::path> files_of(const SolidScene& solid);

}  // namespace aquagraph::io
