// Runs a scene from start or from a checkpoint to its end, or to Ctrl-C, or to the first thing that cannot be computed.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "io/scene.hpp"

namespace aquagraph::engine {

struct RunOptions {
    std::filesystem::path folder;  // of results; empty: results/<scene name>
    std::filesystem::path trace;   // empty: none
    int threads = 0;               // 0: all cores
    bool quiet = false;            // no progress, no table
    std::string restart{};         // a checkpoint, or "auto": the newest good one in the folder; empty: none
    // Of wall-clock time between checkpoints [min]; 0: only when the run is asked to stop; none: what the scene says.
    std::optional<double> checkpoint_every{};
};

// Exit codes of the program.
// stopped: by SIGUSR1, with a checkpoint, to be continued.
enum ExitCode : int { success = 0, bad_input = 2, run_failed = 3, stopped = 4, interrupted = 130 };

// Writes progress and a table of passes to `out`; errors to `err`. Throws io::SceneError for a bad scene and
// std::system_error for a folder that cannot be written, io::CheckpointError for a checkpoint that cannot be used,
// before anything is computed.
ExitCode run(const io::Scene& scene, const RunOptions& options, std::ostream& out, std::ostream& err);

}  // namespace aquagraph::engine
