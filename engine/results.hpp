// What a run leaves in its folder: history, frames, summary, report.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/model.hpp"
#include "io/comparison.hpp"
#include "io/flow_record.hpp"
#include "io/history.hpp"
#include "io/report.hpp"
#include "io/scene.hpp"
#include "io/series.hpp"
#include "tasks/task.hpp"

namespace aquagraph::engine {

// Time spent in the tasks of one family, over all its stages and steps.
struct PassTime {
    std::string name;
    std::string family;  // "fluid", "solid", "coupling", "output"
    std::size_t calls = 0;
    double wall_seconds = 0;  // start to end of the tasks
    double busy_seconds = 0;  // of all threads
    double pairs = 0;         // treated; 0: the pass has none
    double pairs_per_second() const { return busy_seconds > 0 ? pairs / busy_seconds : 0; }  // of one core
};

struct RunFigures {
    double wall_seconds = 0;
    int threads = 0;
    std::vector<PassTime> passes;
};

class Results {
  public:
    // Makes the folder. Throws io::SceneError for a comparison with a column that will not be there, std::system_error
    // where the folder cannot be written.
    Results(const io::Scene& scene, const Model& model, std::filesystem::path folder);

    void history_if_due();
    void frame_if_due();
    void write_history_row();
    void write_frame();
    // Summary and report; returns the comparisons.
    std::vector<io::Comparison> finish(io::RunOutcome outcome, const std::string& message, const RunFigures& figures);

    const std::filesystem::path& folder() const { return folder_; }

  private:
    void write_fluid_frame(int number);
    void write_solid_frame(int number);

    const io::Scene& scene_;
    const Model& model_;
    std::vector<io::HistoryColumn> columns_;
    std::filesystem::path folder_;
    std::unique_ptr<io::HistoryWriter> history_;
    io::FrameSeries fluid_series_, solid_series_;
    io::FlowRecord flow_;
    std::vector<std::size_t> tracked_;  // nodes
    std::vector<solid::SurfaceEdge> boundary_;
    double next_frame_ = 0, next_row_ = 0;
    double row_time_ = -1, frame_time_ = -1;  // of the last ones written
    int frames_ = 0;
};

// Tasks for the end of a cycle: a history row and a frame where they are due. `results` may be null where the listing
// is only drawn.
std::vector<tasks::Task> result_tasks(Results* results);

}  // namespace aquagraph::engine
