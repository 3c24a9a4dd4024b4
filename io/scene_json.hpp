// A scene as it was understood, every default filled in: for summary.json.
#pragma once
#include <nlohmann/json.hpp>

#include "io/scene.hpp"

namespace aquagraph::io {

// Keys and sections are those of the scene file; what a scene does not have is not there. SI units.
nlohmann::json to_json(const Scene& scene);

}  // namespace aquagraph::io
