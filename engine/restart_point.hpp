// From which checkpoint a run goes on.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "io/scene.hpp"

namespace aquagraph::engine {

struct RestartPoint {
    std::filesystem::path file;
    long steps = 0;  // of the fluid
    std::string state;
};

// A run writes these in turn, so that one of them is whole at any moment.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder, int slot);  // slot 0 or 1

// Who writes a checkpoint of what: version, resolved scene, the files it reads, when. Kept beside the state.
nlohmann::json about_run(const io::Scene& scene, double time, long steps);

// `restart`: a file, or "auto" for the newest good one in `folder`; none there: the run starts from the beginning.
// Says on `said` what it takes, and what is wrong with those it passes over. Throws io::CheckpointError for a file
// that cannot be used, for one of another version and for another scene, saying which file, what is wrong and what to
// do. The title, the end time, [output]'s intervals and [[compare]] may change.
std::optional<RestartPoint> find_restart_point(const io::Scene& scene, const std::filesystem::path& folder,
                                               const std::string& restart, std::ostream& said);

}  // namespace aquagraph::engine
