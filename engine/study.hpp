// "aquagraph study": runs a matrix of cases, resolutions and variants and writes what an error costs in which variant.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/run.hpp"
#include "io/study_file.hpp"

namespace aquagraph::engine {

struct StudyOptions {
    std::filesystem::path out;      // file that the section goes into; empty: RESULTS.md beside the study, or standard
                                    // output where `only` or `coarse` make a part of it
    std::filesystem::path folder;   // of the runs and of what is kept of them; empty: results/study_<name>
    std::filesystem::path program;  // that computes; empty: this one
    std::vector<std::string> only;  // parts of "case/variant"; empty: everything
    int threads = 0;                // of a run; 0: all cores
    int repeats = 0;                // 0: as the study says
    bool coarse = false, list = false, fresh = false;
};

// The whole study goes into RESULTS.md beside it, and the table of each case into the README beside its scene, between
// the markers <!-- begin study NAME/CASE --> and <!-- end study NAME/CASE -->, where it has them.
// A run that fails is a row that says so. Runs alternate: all of them once, then all of them again. Interrupted, it
// keeps what is finished and goes on from there when started again. Throws io::SceneError and std::invalid_argument for
// a bad study, scene or option, std::system_error for files that cannot be written, std::runtime_error for one that
// has only one marker of two.
ExitCode study(const io::Study& study, const StudyOptions& options, std::ostream& out, std::ostream& err);

}  // namespace aquagraph::engine
