// The file of a checkpoint: who wrote it and of what as JSON, the state as bytes (io/archive.hpp), and a checksum over
// everything before it. A plain stream and no HDF5: one checksum covers every byte, and nothing of a library's own can
// be half written.
//
//     "aquagraph checkpoint\n", format, length of the JSON, length of the state (64 bits each), JSON, state, checksum
#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace aquagraph::io {

inline constexpr std::uint64_t checkpoint_format = 1;

// The file is no checkpoint, cut off, damaged, or of another format. what() names the file.
class CheckpointError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class OtherFormat : public CheckpointError {
  public:
    using CheckpointError::CheckpointError;
};

struct CheckpointFile {
    nlohmann::json about;
    std::string state;
};

// Complete on the disk when it returns, under its name only then. Throws std::system_error naming the file; what lay
// under the name before is then untouched.
void write_checkpoint(const std::filesystem::path& file, const nlohmann::json& about, std::string_view state);

// Throws CheckpointError, and std::system_error where the file cannot be read.
CheckpointFile read_checkpoint(const std::filesystem::path& file);

// Of 64 bits: any change within eight consecutive bytes, starting at a multiple of eight, changes it for certain.
std::uint64_t checksum(std::string_view bytes, std::uint64_t start = 0);

}  // namespace aquagraph::io
