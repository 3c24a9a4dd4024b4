#include "engine/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "engine/field_columns.hpp"
#include "engine/frames.hpp"
#include "engine/restart_point.hpp"
#include "engine/wall_parts.hpp"
#include "io/atomic_file.hpp"
#include "io/scene_formulas.hpp"
#include "io/scene_reader.hpp"
#include "io/summary.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::engine {

namespace {

// Throws io::SceneError for a comparison with a column that will not be there, and for two of one name.
std::vector<io::HistoryColumn> columns_of(const io::Scene& scene, const std::vector<HistoryPart>& parts,
                                          const std::vector<Diagnostic>& diagnostics) {
    std::vector<io::HistoryColumn> columns;
    const auto append = [&](const HistoryPart& part) {
        columns.insert(columns.end(), part.columns.begin(), part.columns.end());
    };
    for (const HistoryPart& part : parts) append(part);
    for (const Diagnostic& diagnostic : diagnostics) append(diagnostic.part);
    std::vector<std::string> names;
    for (const io::HistoryColumn& column : columns) {
        if (std::find(names.begin(), names.end(), column.name) != names.end())
            throw io::scene_error(scene, FieldColumns(scene).key_of(column.name),
                                  "history.csv has a column \"" + column.name + "\" already", "choose another name");
        names.push_back(column.name);
    }
    io::check_compared_columns(scene, names);
    return columns;
}

// An earlier run's frames would stand beside this one's, in no series, and be taken for its own; its checkpoints would
// be taken for this one's.
void remove_old_results(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool frame = name.starts_with("fluid_") || name.starts_with("solid_");
        if ((frame && name.ends_with(".hdf")) || name == "fluid.hdf.series" || name == "solid.hdf.series")
            std::filesystem::remove(entry.path());
    }
    for (const int slot : {0, 1}) std::filesystem::remove(checkpoint_file(folder, slot));
}

// Frames from this number on.
void remove_later_frames(const std::filesystem::path& folder, int number) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        for (const std::string stem : {"fluid", "solid"})
            if (name.starts_with(stem + "_") && name.ends_with(".hdf") && name >= io::frame_name(stem, number))
                std::filesystem::remove(entry.path());
    }
}

// A moment this part of an interval before its multiple counts as it: sums of equal steps are rounded.
constexpr double early = 1e-6;

// From when on the next row or frame is due: just before the next multiple of `interval` after t.
double next_due(double t, double interval) {
    return (std::floor(t / interval + 2 * early) + 1 - early) * interval;
}

// Where the corners of the body's facets are now; of very many facets only some.
std::vector<std::vector<io::Point>> surface_facets(const solid::Solver<3>& solid,
                                                   const std::vector<solid::Facet>& boundary) {
    constexpr std::size_t most = 1500;
    const auto x = solid.positions();
    std::vector<std::vector<io::Point>> facets;
    for (std::size_t f = 0; f < boundary.size(); f += boundary.size() / most + 1) {
        auto& corners = facets.emplace_back();
        for (std::size_t k = 0; k < solid::corner_count<3>(boundary[f]); ++k) {
            const std::size_t node = 3 * std::size_t(boundary[f][k]);
            corners.emplace_back(x[node], x[node + 1], x[node + 2]);
        }
    }
    return facets;
}

}  // namespace

// The columns are made before anything is computed or written, so that a comparison with one that is not there ends at
// once.
template <int D>
Results<D>::Results(const io::Scene& scene, Model<D>& model, std::filesystem::path folder, bool resumed)
    : scene_(scene),
      model_(model),
      parts_(history_parts(scene, model)),
      diagnostics_(make_diagnostics(scene, model)),
      measured_at_(diagnostics_.size(), -1),
      columns_(columns_of(scene, parts_, diagnostics_)),
      folder_(std::move(folder)),
      fluid_series_((io::make_folder(folder_), folder_ / "fluid.hdf.series")),
      solid_series_(folder_ / "solid.hdf.series"),
      flow_(scene.fluid ? scene.fluid->spacing : 1.0) {
    if (model.solid) boundary_ = solid::boundary_facets(model.solid->mesh());
    if (D == 2 && model.solid) boundary_ = solid::chain(boundary_);
    if (resumed) return;
    remove_old_results(folder_);
    history_ = std::make_unique<io::HistoryWriter>(folder_ / "history.csv", columns_);
}

template <int D>
void Results<D>::resume() {
    try {
        const std::filesystem::path file = folder_ / "history.csv";
        const io::History history = std::filesystem::exists(file) ? io::read_history(file) : io::History{};
        const auto time = history.time();
        if (std::find(time.begin(), time.end(), row_time_) == time.end())
            throw std::runtime_error(
                fmt::format("{} has no row of t = {} s, with which the checkpoint goes on", file.string(), row_time_));
        history_ = std::make_unique<io::HistoryWriter>(io::HistoryWriter::resume(file, columns_, row_time_));
        fluid_series_ = io::FrameSeries::resume(folder_ / "fluid.hdf.series", frame_time_);
        solid_series_ = io::FrameSeries::resume(folder_ / "solid.hdf.series", frame_time_);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(
            fmt::format("{}: restart in the folder of the run (--out) with its files as they "
                        "were, or start from the beginning, without --restart",
                        error.what()));
    }
    remove_later_frames(folder_, frames_);
    next_frame_ = next_due(frame_time_, scene_.output.frame_interval);
    if (scene_.output.history_interval > 0) next_row_ = next_due(row_time_, scene_.output.history_interval);
}

template <int D>
std::vector<tasks::Task> result_tasks(Results<D>* results, const std::vector<Diagnostic>& diagnostics) {
    namespace resource = tasks::resource;
    const std::vector<std::string> reads = {
        resource::clock,           resource::fluid,           resource::interface_loads, resource::interface_energy,
        resource::interface_ratio, resource::interface_guess, resource::solid_state};
    std::vector<tasks::Task> tasks;
    for (std::size_t k = 0; k < diagnostics.size(); ++k) {
        tasks::Task& task = tasks.emplace_back(diagnostics[k].task);
        task.reads.push_back(resource::clock);  // whether a row is due
        task.writes.push_back(resource::results);
        task.group = "results";
        task.body = [results, k, measure = diagnostics[k].task.body] {
            if (!results->row_is_due()) return;
            measure();
            results->measured(k);
        };
    }
    tasks.push_back({.name = "history",
                     .reads = reads,
                     .writes = {resource::results},
                     .body = [results] { results->history_if_due(); },
                     .group = "results"});
    tasks.push_back({.name = "frames",
                     .reads = reads,
                     .writes = {resource::results},
                     .body = [results] { results->frame_if_due(); },
                     .group = "results"});
    return tasks;
}

template <int D>
bool Results<D>::row_is_due() const {
    return model_.clock.time >= next_row_ || model_.clock.time >= model_.clock.end;
}

template <int D>
void Results<D>::measure() {
    for (std::size_t k = 0; k < diagnostics_.size(); ++k) {
        diagnostics_[k].task.body();
        measured(k);
    }
}

template <int D>
void Results<D>::history_if_due() {
    if (!row_is_due()) return;
    write_history_row();
    if (scene_.output.history_interval > 0) next_row_ = next_due(model_.clock.time, scene_.output.history_interval);
}

template <int D>
void Results<D>::frame_if_due() {
    if (model_.clock.time < next_frame_ && model_.clock.time < model_.clock.end) return;
    write_frame();
    next_frame_ = next_due(model_.clock.time, scene_.output.frame_interval);
}

template <int D>
void Results<D>::write_history_row() {
    if (row_time_ == model_.clock.time) return;
    row_time_ = model_.clock.time;
    row_.clear();
    for (const HistoryPart& part : parts_) part.append(row_);
    for (std::size_t k = 0; k < diagnostics_.size(); ++k) {
        if (measured_at_[k] == model_.clock.time)
            diagnostics_[k].part.append(row_);
        else
            row_.resize(row_.size() + diagnostics_[k].part.columns.size(), std::numeric_limits<double>::quiet_NaN());
    }
    history_->row(row_);
}

template <int D>
void Results<D>::write_frame() {
    const double time = model_.clock.time;
    if (frame_time_ == time) return;
    frame_time_ = time;
    if (model_.fluid) {
        const std::string name = io::frame_name("fluid", frames_);
        write_fluid_frame(folder_ / name, *model_.fluid, time);
        fluid_series_.add(name, time);
    }
    if (model_.solid) {
        const std::string name = io::frame_name("solid", frames_);
        write_solid_frame(folder_ / name, *model_.solid, time);
        solid_series_.add(name, time);
    }
    ++frames_;
    record_flow();
}

template <int D>
void Results<D>::record_flow() {
    if (!flow_.wanted()) {
        flow_.add({});
        return;
    }
    io::ReportFrame frame;
    frame.time = model_.clock.time;
    std::vector<double> speed;
    if (model_.fluid) {
        const auto& s = model_.fluid->particles;
        frame.x = std::span(s.x[0].data(), s.count);
        frame.y = std::span(s.x[1].data(), s.count);
        if constexpr (D == 3) frame.z = std::span(s.x[2].data(), s.count);
        frame.pressure = std::span(s.p.data(), s.count);
        speed.resize(s.count);
        for (std::size_t i = 0; i < s.count; ++i) {
            double v2 = 0;
            for (std::size_t d = 0; d < D; ++d) v2 += s.v[d][i] * s.v[d][i];
            speed[i] = std::sqrt(v2);
        }
        frame.speed = speed;
    }
    if constexpr (D == 3)
        if (model_.solid) frame.walls = surface_facets(*model_.solid, boundary_);
    if (D == 2 && model_.solid) {
        const auto x = model_.solid->positions();
        for (std::size_t e = 0; e < boundary_.size(); ++e) {
            const solid::Facet& edge = boundary_[e];
            if (e == 0 || boundary_[e - 1][1] != edge[0])
                frame.outlines.emplace_back();  // the next closed line: a hole
            for (std::size_t k = 0; k < edge.size(); ++k)
                if (k != 1)
                    frame.outlines.back().push_back({x[2 * std::size_t(edge[k])], x[2 * std::size_t(edge[k]) + 1]});
        }
    }
    if (model_.walls || model_.flux_walls) frame.walls = moving_panels(scene_, panels_of(model_));
    flow_.add(frame);
}

template <int D>
std::vector<io::Comparison> Results<D>::finish(const RunEnd& end) {
    history_->flush();
    const io::History history = io::read_history(history_->file());
    std::vector<io::Comparison> comparisons;
    nlohmann::json errors = nlohmann::json::array();
    for (const io::Compare& compare : scene_.comparisons) {
        comparisons.push_back(io::compare_with(compare, history, io::all_constants(scene_)));
        if (compare.error) errors.push_back(io::to_json(comparisons.back()));
    }
    nlohmann::json summary = summary_of(scene_, model_, end);
    summary["comparisons"] = errors;
    io::write_summary(folder_ / "summary.json", summary);
    io::Report report = report_of(model_, end);
    report.summary = std::move(summary);
    io::write_report(folder_ / "report.html", scene_, report, history, comparisons, flow_);
    return comparisons;
}

template <int D>
std::vector<std::string> history_columns(const io::Scene& scene, Model<D>& model) {
    std::vector<std::string> names;
    for (const io::HistoryColumn& column :
         columns_of(scene, history_parts(scene, model), make_diagnostics(scene, model)))
        names.push_back(column.name);
    return names;
}

template std::vector<std::string> history_columns(const io::Scene&, Model<2>&);
template std::vector<std::string> history_columns(const io::Scene&, Model<3>&);
template class Results<2>;
template class Results<3>;
template std::vector<tasks::Task> result_tasks(Results<2>*, const std::vector<Diagnostic>&);
template std::vector<tasks::Task> result_tasks(Results<3>*, const std::vector<Diagnostic>&);

}  // namespace aquagraph::engine
