// "aquagraph modes": natural frequencies and shapes of a scene's body.
#pragma once
#include <filesystem>
#include <iosfwd>

#include "engine/run.hpp"
#include "io/scene.hpp"

namespace aquagraph::engine {

struct ModesOptions {
    int count = 6;
    int threads = 0;               // 0: all cores
    std::filesystem::path folder;  // empty: results/<scene name>
};

// About the body as the scene starts it: at rest as drawn; in equilibrium under its own weight and its loads at t = 0
// with static_start; under its loads at the end time where the scene is static. Water has no part in it. Prints a
// table, writes modes.csv and a frame for every mode (modes.hdf.series). Throws io::SceneError for a scene without a
// body and a count that it does not have.
ExitCode modes(const io::Scene& scene, const ModesOptions& options, std::ostream& out, std::ostream& err);

}  // namespace aquagraph::engine
