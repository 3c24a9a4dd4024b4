// A study file (TOML): which scenes are run at which resolutions and in which variants, to see what an error costs.
// Its keys are documented in benchmarks/STUDIES.md.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/scene.hpp"
#include "io/scene_keys.hpp"

namespace aquagraph::io {

// A named set of overrides: a scheme, a wall, an integrator.
struct StudyVariant {
    std::string name, label;
    std::vector<std::string> set;  // "fluid.scheme.reconstruction=none"
};

struct StudyCase {
    std::string name, title;
    std::filesystem::path scene;        // absolute
    std::vector<std::string> set;       // for all runs of the case
    std::vector<std::string> variants;  // names, in the order of the tables
    std::string resolution_key;         // "fluid.spacing"
    std::vector<double> resolutions;    // values of that key, coarse to fine
    int coarse = 1;                     // how many of them belong to the coarse version
    std::string error;                  // label of the comparison that is drawn against time; empty: the first
};

struct Study {
    std::filesystem::path file;  // absolute
    std::string name, title;
    int repeats = 1;
    double time_limit = 0;  // [s] of a run
    std::vector<StudyVariant> variants;
    std::vector<StudyCase> cases;
};

// Throws SceneError, with file, line, column and remedy, for whatever is wrong in the file itself. The scenes are not
// read: that is for who runs them.
Study read_study(const std::filesystem::path& file);

// What stands in benchmarks/STUDIES.md.
const KeyTable& study_table();

}  // namespace aquagraph::io
