// What a run leaves in its folder: history, frames, summary, report.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/diagnostics.hpp"
#include "engine/model.hpp"
#include "engine/summary.hpp"
#include "io/comparison.hpp"
#include "io/flow_record.hpp"
#include "io/scene.hpp"
#include "io/series.hpp"
#include "tasks/task.hpp"

namespace aquagraph::engine {

// The names of the columns of history.csv, without units. Throws io::SceneError for a comparison with a column that
// will not be there, and for two of one name.
template <int D>
std::vector<std::string> history_columns(const io::Scene& scene, Model<D>& model);

template <int D>
class Results {
  public:
    // Makes the folder. Throws io::SceneError for a comparison with a column that will not be there, std::system_error
    // where the folder cannot be written. `resumed`: what is there stays until resume() is called.
    Results(const io::Scene& scene, Model<D>& model, std::filesystem::path folder, bool resumed = false);

    // For a checkpoint: what has been written, and what columns remember.
    template <class Archive>
    void archive(Archive& fields) {
        fields(row_time_, frame_time_, frames_, flow_);
        for (HistoryPart& part : parts_)
            if (part.memory) fields(*part.memory);
        for (Diagnostic& diagnostic : diagnostics_)
            if (diagnostic.archive) diagnostic.archive(fields);
    }
    // Goes on with the files that are there, without what is later than the state that archive() has read. Throws
    // std::runtime_error, before anything is changed, where the history does not reach that far or has other columns.
    void resume();
    void sync() { history_->sync(); }

    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
    bool row_is_due() const;
    // All diagnostics, as their tasks do where a row is due: for the first and the last row, outside of the graph.
    void measure();
    void measured(std::size_t diagnostic) { measured_at_[diagnostic] = model_.clock.time; }
    void history_if_due();
    void frame_if_due();
    // What has not been measured now (after a failure nothing can be) is written as nan.
    void write_history_row();
    void write_frame();
    // Summary and report; returns the comparisons.
    std::vector<io::Comparison> finish(const RunEnd& end);

    const std::filesystem::path& folder() const { return folder_; }

  private:
    void record_flow();

    const io::Scene& scene_;
    const Model<D>& model_;
    std::vector<HistoryPart> parts_;
    std::vector<Diagnostic> diagnostics_;
    std::vector<double> measured_at_;  // [s], of each
    std::vector<io::HistoryColumn> columns_;
    std::filesystem::path folder_;
    std::unique_ptr<io::HistoryWriter> history_;
    std::vector<double> row_;
    io::FrameSeries fluid_series_, solid_series_;
    io::FlowRecord flow_;
    std::vector<solid::Facet> boundary_;
    double next_frame_ = 0, next_row_ = 0;
    double row_time_ = -1, frame_time_ = -1;  // of the last ones written
    int frames_ = 0;
};

// Tasks for the end of a cycle: diagnostics, a history row and a frame where they are due. `results` may be null where
// the listing is only drawn.
template <int D>
std::vector<tasks::Task> result_tasks(Results<D>* results, const std::vector<Diagnostic>& diagnostics);

}  // namespace aquagraph::engine
