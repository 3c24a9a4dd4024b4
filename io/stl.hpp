// Reads STL files, ASCII and binary.
#pragma once
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "physics/geometry/surface.hpp"

namespace aquagraph::io {

// What is wrong with the file, with the line (ASCII) or the triangle (binary).
struct StlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The triangles as they stand in the file, three vertices each: none is shared yet (geometry::weld joins them). The
// normals in the file are not looked at: the order of the vertices says which way a triangle looks, and where the two
// contradict each other the file is refused. Throws StlError, or std::system_error where it cannot be read.
geometry::Surface<3> read_stl(const std::filesystem::path& file);
geometry::Surface<3> parse_stl(std::string_view content);

}  // namespace aquagraph::io
