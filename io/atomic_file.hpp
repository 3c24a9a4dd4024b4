// Whole files that a reader never sees half written: a temporary file beside the target, then a rename.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace aquagraph::io {

// Throws std::system_error naming the file.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);
// The same of several pieces, one after the other, and it is on the disk when it returns: a power cut leaves the old
// file or the new one. Slower: it waits for the disk.
void write_file_durably(const std::filesystem::path& file, std::span<const std::string_view> pieces);
// With the folders above it, where they are not there. Throws std::system_error naming it.
void make_folder(const std::filesystem::path& folder);
// Whether a later write_file_atomically() will find its folder, which is made, and may write there; throws as that
// does.
void check_writable(const std::filesystem::path& file);
std::string read_file(const std::filesystem::path& file);

// The name under which `file` is written until it is complete; in the same folder.
std::filesystem::path temporary_name(const std::filesystem::path& file);

}  // namespace aquagraph::io
