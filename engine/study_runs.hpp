// The runs of a study: which there are, how one is made in a child process, and how finished ones are kept.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/study_curves.hpp"
#include "io/study_file.hpp"

namespace aquagraph::engine {

// One scene at one resolution in one variant.
struct StudyRun {
    std::size_t study_case = 0, variant = 0, level = 0;  // places in the study
    double resolution = 0;
    std::vector<std::string> overrides;
    std::string content;  // hash of the resolved scene, the files it refers to and the program
    // Where runs are compared with each other, of the resolved scene.
    bool parallel = false;
    int ratio = 1;
    double step_fraction = 1;
};

struct RunError {
    std::string label, column;
    double normalised = 0;  // NRMS, as summary.json gives it
};

// What is kept of a run.
struct RunRecord {
    std::string failure;  // why there are no numbers; empty: it went well
    double wall_seconds = 0, cpu_seconds = 0;
    long particles = 0, steps = 0, evaluations = 0;  // of the right-hand side
    long nodes = 0, newton_iterations = 0;           // of a solid
    std::vector<RunError> errors;
    // Where runs are compared with each other: the curve, and of coupled runs the solid's part.
    Curve curve;
    long solves = 0;
    double solve_seconds = 0, other_seconds = 0;  // wall time in solves; time of all threads in everything else
};

// In the order of the study, coarse to fine. `only`: parts of "case/variant", any of which must occur in it; empty:
// all. Reads every scene; throws io::SceneError for one that is wrong, and for what study_checks.hpp says.
std::vector<StudyRun> runs_of(const io::Study& study, bool coarse, const std::vector<std::string>& only,
                              const std::filesystem::path& program, int threads);

// Results go to `folder`. Never throws for what goes wrong in the run itself. Nothing where `stop` has ended it.
std::optional<RunRecord> make_run(const io::Study& study, const StudyRun& run, const std::filesystem::path& program,
                                  int threads, const std::filesystem::path& folder, const std::function<bool()>& stop);

// Kept as JSON, one file per run and repeat.
std::optional<RunRecord> kept_run(const std::filesystem::path& folder, const StudyRun& run, int repeat);
void keep_run(const std::filesystem::path& folder, const StudyRun& run, int repeat, const RunRecord& record);

}  // namespace aquagraph::engine
