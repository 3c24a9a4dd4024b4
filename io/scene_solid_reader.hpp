// The elastic body of a scene, its parts, supports and loads out of a checked document.
#pragma once
#include "io/complaints.hpp"
#include "io/scene.hpp"
#include "io/toml_document.hpp"

namespace aquagraph::io {

// Makes scene.solid. Knows already: scene.file, scene.dimension, scene.end_time.
void read_solid(const CheckedDocument& document, Complaints& complaints, Scene& scene);

}  // namespace aquagraph::io
