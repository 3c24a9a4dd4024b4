// The solid of a scene as resolved, for summary.json.
#pragma once
#include <nlohmann/json.hpp>

#include "io/scene_solid.hpp"

namespace aquagraph::io {

nlohmann::json to_json(const SolidScene& solid, int dimension);

}  // namespace aquagraph::io
