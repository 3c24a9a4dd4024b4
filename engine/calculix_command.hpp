// "aquagraph export-ccx": a scene's body as an input deck of CalculiX.
#pragma once
#include <filesystem>
#include <iosfwd>

#include "io/scene.hpp"

namespace aquagraph::engine {

// The deck prints the displacements of the tracked nodes at every step, of all nodes where none are tracked. Throws
// io::SceneError for a scene with water, without a body, or with what CalculiX has no equal for; std::system_error
// where the file cannot be written.
void export_calculix(const io::Scene& scene, const std::filesystem::path& file, std::ostream& out);

}  // namespace aquagraph::engine
