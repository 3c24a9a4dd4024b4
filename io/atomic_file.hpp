// Whole files that a reader never sees half written: a temporary file beside the target, then a rename.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace aquagraph::io {

// Throws std::system_error naming the file.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);
std::string read_file(const std::filesystem::path& file);

// The name under which `file` is written until it is complete; in the same folder.
std::filesystem::path temporary_name(const std::filesystem::path& file);

}  // namespace aquagraph::io
