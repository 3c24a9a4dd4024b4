// "aquagraph export-ccx": a scene's body as an input deck of CalculiX.
#pragma once
#include <filesystem>
#include <iosfwd>

#include "io/scene.hpp"

namespace aquagraph::engine {

// `loads`: the history of a run of a scene with water, in which [output] interface_loads was set; the body is given
// these loads again. ccx then takes steps of one size, the mean of the run's, and loads go straight from one to the
// next. Empty: the body is alone.
//
// The deck prints the displacements of the tracked nodes at every step, of all nodes where none are tracked. Throws
// io::SceneError for a scene with water and no loads, without a body, or with what CalculiX has no equal for;
// std::runtime_error for a history without loads; std::system_error where a file cannot be written or read.
void export_calculix(const io::Scene& scene, const std::filesystem::path& file, const std::filesystem::path& loads,
                     std::ostream& out);

}  // namespace aquagraph::engine
