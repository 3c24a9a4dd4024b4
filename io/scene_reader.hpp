// Reads a scene file (TOML) into plain data, or says everything that is wrong with it, each with its place in the file.
#pragma once
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene.hpp"

namespace aquagraph::io {

// One thing that is wrong in a scene file.
struct SceneComplaint {
    std::string key;            // dotted, "fluid.box[1].min"; empty for a syntax error
    SourcePosition position{};  // 1-based
    std::string message;        // what is wrong
    std::string help;           // what would be right
};

// what(): for every complaint, separated by a blank line,
//   gate.toml:12:11: error: the spacing must be positive, but it is -0.002
//       spacing = -0.002
//                 ^
//   help: …
class SceneError : public std::runtime_error {
  public:
    SceneError(const std::filesystem::path& file, std::string_view text, std::vector<SceneComplaint> complaints);
    const std::vector<SceneComplaint>& complaints() const { return complaints_; }

  private:
    std::vector<SceneComplaint> complaints_;
};

// overrides: "fluid.spacing=0.01", keys that are given on the command line and stand above the file's; checked like it.
// Throws SceneError on a bad or unreadable file.
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

// Begins the lines of Scene::text that are overrides.
inline constexpr std::string_view override_mark = "# --set ";

// For what only turns out later (a set that the mesh does not have): an error that points at `key` of a scene already
// read. An unknown key points at the nearest enclosing table that stands in the file.
SceneError scene_error(const Scene& scene, std::string_view key, std::string message, std::string help);

// Throws SceneError where a [[compare]] names a column that the run will not write: to be asked before the run, not
// after it. columns: the names of history.csv without units.
void check_compared_columns(const Scene& scene, std::span<const std::string> columns);

}  // namespace aquagraph::io
