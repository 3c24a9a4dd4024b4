// What a finished run says about itself: summary.json and the numbers at the head of the report.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/model.hpp"
#include "io/report.hpp"

namespace aquagraph::engine {

// Time spent in the tasks of one family, over all its stages and steps.
struct PassTime {
    std::string name;
    std::string family;  // "fluid", "solid", "coupling", "output"
    std::size_t calls = 0;
    double wall_seconds = 0;  // start to end of the tasks
    double busy_seconds = 0;  // of all threads
    double pairs = 0;         // treated; 0: the pass has none

    template <class Archive>
    void archive(Archive& fields) {
        fields(name, family, calls, wall_seconds, busy_seconds, pairs);
    }
    double pairs_per_second() const { return busy_seconds > 0 ? pairs / busy_seconds : 0; }  // of one core
};

struct RunFigures {
    double wall_seconds = 0;
    int threads = 0;
    std::vector<PassTime> passes;
    int restarts = 0;  // from checkpoints; time and passes are those of all its parts together

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(wall_seconds, passes, restarts);
    }
};

struct RunEnd {
    io::RunOutcome outcome = io::RunOutcome::finished;
    std::string message;  // why it was interrupted or failed
    RunFigures figures;
};

template <int D>
nlohmann::json summary_of(const io::Scene& scene, const Model<D>& model, const RunEnd& end);

// Without the summary, which is added by the caller.
template <int D>
io::Report report_of(const Model<D>& model, const RunEnd& end);

}  // namespace aquagraph::engine
