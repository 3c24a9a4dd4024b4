// A study file (TOML): which scenes are run at which resolutions and in which variants, to see what an error costs.
// Its keys are documented in benchmarks/STUDIES.md.
#pragma once
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/scene.hpp"
#include "io/scene_keys.hpp"
#include "io/scene_reader.hpp"

namespace aquagraph::io {

// A named set of overrides: a scheme, a wall, an integrator.
struct StudyVariant {
    std::string name, label;
    std::vector<std::string> set;         // "fluid.scheme.reconstruction=none"
    std::string base;                     // its name before it was multiplied with the axes
    std::vector<int> place;               // which value of each axis; empty without axes
    bool coarse = true;                   // whether the coarse version has it
    std::vector<std::string> set_keys{};  // where each of `set` stands in the file: "variant[0].set[1]"
};

// A key and the values that it takes: axes are multiplied with each other and with the variants.
struct StudyAxis {
    std::string name, key;
    std::vector<std::string> values;
    int coarse = 0;  // how many of the values belong to the coarse version
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
    // Where runs are compared with each other instead:
    std::string curve;      // column of the history
    std::string reference;  // variant whose curve is taken for right
    std::string speedup;    // axis along whose first value a run's time is measured; empty: none
    double growth = 0;      // a curve that swings by more at its end than this times before is unstable; 0: not asked
    double roughness = 2;   // a curve that goes up and down more often than this times the reference's is unstable
};

struct Study {
    std::filesystem::path file;  // absolute
    std::string name, title;
    int repeats = 1;
    double time_limit = 0;  // [s] of a run
    std::vector<StudyAxis> axes;
    std::vector<StudyVariant> variants;  // already multiplied with the axes
    std::vector<std::string> readme;     // names of those whose rows go into READMEs too
    std::vector<StudyCase> cases;
    std::string text;                                 // of the file
    std::map<std::string, SourcePosition> positions;  // dotted key ("case[0].scene", counted from 0) -> place
};

// Throws SceneError, with file, line, column and remedy, for whatever is wrong in the file itself. The scenes are not
// read: that is for who runs them.
Study read_study(const std::filesystem::path& file);

// For what only turns out with the scenes: an error that points at `key` of a study already read.
SceneError study_error(const Study& study, std::string_view key, std::string message, std::string help);

// What stands in benchmarks/STUDIES.md.
const KeyTable& study_table();

}  // namespace aquagraph::io
