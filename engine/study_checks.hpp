// What of a study is wrong can only be told with its scenes at hand. All of it points into the study's file.
#pragma once
#include "engine/study_runs.hpp"

namespace aquagraph::engine {

// The scene of a run, with `run.overrides`, whose places in the study are `keys`, one for each. Throws io::SceneError:
// for an override that the scene refuses, with its place in the study; for a scene that is wrong itself, with that
// one's.
io::Scene scene_of_run(const io::Study& study, const StudyRun& run, const std::vector<std::string>& keys);

// Throws io::SceneError where no comparison of the scene has the label that the case draws.
void check_drawn_error(const io::Study& study, const StudyRun& run, const io::Scene& scene);

// Throws io::SceneError where history.csv will have no column for the case's `curve`. Makes the model of the scene.
void check_curve(const io::Study& study, const StudyRun& run);

}  // namespace aquagraph::engine
