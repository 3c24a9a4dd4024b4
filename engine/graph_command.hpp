// Draws the job graph of a scene.
#pragma once
#include <filesystem>
#include <iosfwd>

#include "io/scene.hpp"

namespace aquagraph::engine {

// Writes the graph of one coupling cycle as text for Graphviz to `file`, and beside it as SVG if `dot` is installed.
// Throws std::system_error where the file cannot be written.
void draw_graph(const io::Scene& scene, const std::filesystem::path& file, std::ostream& out);

}  // namespace aquagraph::engine
