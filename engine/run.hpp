// Runs a scene from start to end, or to Ctrl-C, or to the first thing that cannot be computed.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>

#include "io/scene.hpp"

namespace aquagraph::engine {

struct RunOptions {
    std::filesystem::path folder;  // of results; empty: results/<scene name>
    std::filesystem::path trace;   // empty: none
    int threads = 0;               // 0: all cores
    bool quiet = false;            // no progress, no table
};

// Exit codes of the program.
enum ExitCode : int { success = 0, bad_input = 2, run_failed = 3, interrupted = 130 };

// Writes progress and a table of passes to `out`; errors to `err`. Throws io::SceneError for a bad scene and
// std::system_error for a folder that cannot be written, before anything is computed.
ExitCode run(const io::Scene& scene, const RunOptions& options, std::ostream& out, std::ostream& err);

}  // namespace aquagraph::engine
