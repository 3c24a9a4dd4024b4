#include "engine/results.hpp"

#include <cmath>
#include <system_error>

#include "engine/version.hpp"
#include "io/scene_json.hpp"
#include "io/scene_reader.hpp"
#include "io/summary.hpp"
#include "io/vtk_hdf.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::engine {

namespace {

// Made before anything is computed or written, so that a comparison with a column that is not there ends at once.
std::vector<io::HistoryColumn> history_columns(const io::Scene& scene, const Model& model) {
    std::vector<io::HistoryColumn> columns{{"time", "s"}, {"step_size", "s"}};
    if (scene.solid)
        for (const io::Track& track : scene.solid->tracks) {
            columns.push_back({track.name + "_x", "m"});
            columns.push_back({track.name + "_y", "m"});
        }
    if (model.interface) {
        columns.push_back({scene.solid->name + "_force_x", "N/m"});
        columns.push_back({scene.solid->name + "_force_y", "N/m"});
    }
    if (model.fluid) {
        columns.push_back({"fluid_kinetic_energy", "J/m"});
        columns.push_back({"fluid_potential_energy", "J/m"});
    }
    if (model.solid) {
        columns.push_back({"solid_kinetic_energy", "J/m"});
        columns.push_back({"solid_strain_energy", "J/m"});
        columns.push_back({"solid_external_work", "J/m"});
    }
    if (model.fluid) {
        columns.push_back({"particles", ""});
        columns.push_back({"fastest_particle", "m/s"});
    }
    std::vector<std::string> names;
    for (const io::HistoryColumn& column : columns) names.push_back(column.name);
    io::check_compared_columns(scene, names);
    return columns;
}

// An earlier run's frames would stand beside this one's, in no series, and be taken for its own.
void remove_old_frames(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool ours = name.starts_with("fluid_") || name.starts_with("solid_");
        if ((ours && name.ends_with(".hdf")) || name == "fluid.hdf.series" || name == "solid.hdf.series")
            std::filesystem::remove(entry.path());
    }
}

// The next multiple of `interval` after t; rounding must not give t itself again.
double next_due(double t, double interval) {
    return (std::floor(t / interval * (1 + 1e-12)) + 1) * interval;
}

}  // namespace

Results::Results(const io::Scene& scene, const Model& model, std::filesystem::path folder)
    : scene_(scene),
      model_(model),
      columns_(history_columns(scene, model)),
      folder_(std::move(folder)),
      fluid_series_((std::filesystem::create_directories(folder_), folder_ / "fluid.hdf.series")),
      solid_series_(folder_ / "solid.hdf.series"),
      flow_(scene.fluid ? scene.fluid->spacing : 1.0) {
    remove_old_frames(folder_);
    history_ = std::make_unique<io::HistoryWriter>(folder_ / "history.csv", columns_);
    if (model.solid) {
        for (const io::Track& track : scene.solid->tracks)
            tracked_.push_back(nearest_node(model.solid->mesh(), track.point));
        boundary_ = solid::chain(solid::boundary_edges(model.solid->mesh()));
    }
}

std::vector<tasks::Task> result_tasks(Results* results) {
    namespace resource = tasks::resource;
    const std::vector<std::string> reads = {resource::clock, resource::fluid, resource::interface_loads,
                                            resource::solid_state};
    return {{.name = "history",
             .reads = reads,
             .writes = {resource::results},
             .body = [results] { results->history_if_due(); },
             .group = "results"},
            {.name = "frames",
             .reads = reads,
             .writes = {resource::results},
             .body = [results] { results->frame_if_due(); },
             .group = "results"}};
}

void Results::history_if_due() {
    if (model_.clock.time < next_row_ && model_.clock.time < model_.clock.end) return;
    write_history_row();
    if (scene_.output.history_interval > 0) next_row_ = next_due(model_.clock.time, scene_.output.history_interval);
}

void Results::frame_if_due() {
    if (model_.clock.time < next_frame_ && model_.clock.time < model_.clock.end) return;
    write_frame();
    next_frame_ = next_due(model_.clock.time, scene_.output.frame_interval);
}

void Results::write_history_row() {
    if (row_time_ == model_.clock.time) return;
    row_time_ = model_.clock.time;
    std::vector<double> row{model_.clock.time, model_.clock.step};
    for (const std::size_t node : tracked_)
        for (std::size_t d = 0; d < 2; ++d) row.push_back(model_.solid->displacements()[2 * node + d]);
    if (model_.interface) row.insert(row.end(), {model_.interface->force[0], model_.interface->force[1]});
    double fastest = 0;
    if (model_.fluid) {
        fluid::FluidEnergies sum;
        const auto& particles = model_.fluid->particles;
        for (std::size_t block = 0; block < model_.fluid->blocks(); ++block) {
            const auto part = fluid::energies(particles, model_.fluid->flux.gravity, model_.fluid->lanes(block));
            sum.kinetic += part.kinetic;
            sum.potential += part.potential;
        }
        for (std::size_t i = 0; i < particles.count; ++i)
            fastest = std::max(fastest, std::hypot(particles.v[0][i], particles.v[1][i]));
        row.insert(row.end(), {sum.kinetic, sum.potential});
    }
    if (model_.solid) {
        const solid::Energies energies = model_.solid->energies();
        row.insert(row.end(), {energies.kinetic, energies.strain, energies.external_work});
    }
    if (model_.fluid) row.insert(row.end(), {double(model_.fluid->particles.count), fastest});
    history_->row(row);
}

void Results::write_frame() {
    if (frame_time_ == model_.clock.time) return;
    frame_time_ = model_.clock.time;
    if (model_.fluid) write_fluid_frame(frames_);
    if (model_.solid) write_solid_frame(frames_);
    ++frames_;
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
        frame.pressure = std::span(s.p.data(), s.count);
        speed.resize(s.count);
        for (std::size_t i = 0; i < s.count; ++i) speed[i] = std::hypot(s.v[0][i], s.v[1][i]);
        frame.speed = speed;
    }
    if (model_.solid) {
        const auto x = model_.solid->positions();
        std::vector<io::Point> outline;
        for (const auto& [begin, end, middle] : boundary_)
            for (const int node : {begin, middle})
                outline.push_back({x[2 * std::size_t(node)], x[2 * std::size_t(node) + 1]});
        frame.outlines.push_back(std::move(outline));
    }
    flow_.add(frame);
}

void Results::write_fluid_frame(int number) {
    const auto& s = model_.fluid->particles;
    const auto part = [&](const fluid::Scalars& values) { return std::span<const double>(values.data(), s.count); };
    std::vector<double> density(s.count);
    for (std::size_t i = 0; i < s.count; ++i) density[i] = model_.fluid->tait.reference_density + s.deviation[i];
    io::VtkFrame frame;
    frame.x = part(s.x[0]);
    frame.y = part(s.x[1]);
    frame.time = model_.clock.time;
    frame.precision = io::Precision::float32;
    frame.point_arrays = {{"pressure", {part(s.p)}},
                          {"velocity", {part(s.v[0]), part(s.v[1])}},
                          {"density", {std::span<const double>(density)}},
                          {"volume", {part(s.volume)}},
                          {"fullness", {part(s.fullness)}},
                          {"id", {std::span<const std::int64_t>(s.id.data(), s.count)}}};
    const std::string name = io::frame_name("fluid", number);
    io::write_vtk_hdf(folder_ / name, frame);
    fluid_series_.add(name, frame.time);
}

void Results::write_solid_frame(int number) {
    const solid::Solver& solver = *model_.solid;
    const std::size_t nodes = solver.mesh().nodes.size();
    const auto component = [&](std::span<const double> values, std::size_t d) {
        std::vector<double> one(nodes);
        for (std::size_t n = 0; n < nodes; ++n) one[n] = values[2 * n + d];
        return one;
    };
    const auto x = component(solver.positions(), 0), y = component(solver.positions(), 1),
               ux = component(solver.displacements(), 0), uy = component(solver.displacements(), 1),
               vx = component(solver.velocities(), 0), vy = component(solver.velocities(), 1);
    std::vector<double> stress(solver.mesh().elements.size());
    solver.element_stress(stress);
    std::vector<std::int32_t> connectivity;
    for (const auto& element : solver.mesh().elements)
        connectivity.insert(connectivity.end(), element.begin(), element.end());
    const auto array = [](const std::vector<double>& v) { return io::VtkValues(std::span<const double>(v)); };
    io::VtkFrame frame;
    frame.x = x;
    frame.y = y;
    frame.time = model_.clock.time;
    frame.cell_type = io::CellType::quadratic_quad;
    frame.connectivity = connectivity;
    frame.point_arrays = {{"displacement", {array(ux), array(uy)}}, {"velocity", {array(vx), array(vy)}}};
    frame.cell_arrays = {{"von_mises_stress", {array(stress)}}};
    const std::string name = io::frame_name("solid", number);
    io::write_vtk_hdf(folder_ / name, frame);
    solid_series_.add(name, frame.time);
}

std::vector<io::Comparison> Results::finish(io::RunOutcome outcome, const std::string& message,
                                            const RunFigures& figures) {
    history_->flush();
    const io::History history = io::read_history(history_->file());
    std::vector<io::Comparison> comparisons;
    nlohmann::json errors = nlohmann::json::array();
    for (const io::Compare& compare : scene_.comparisons) {
        comparisons.push_back(io::compare_with(compare, history));
        if (compare.error) errors.push_back(io::to_json(comparisons.back()));
    }

    nlohmann::json summary;
    summary["version"] = version;
    summary["scene"] = io::to_json(scene_);  // as resolved
    summary["scene_file"] = {{"name", scene_.file.filename().string()}, {"text", scene_.text}};
    summary["outcome"] = outcome == io::RunOutcome::finished      ? "finished"
                         : outcome == io::RunOutcome::interrupted ? "interrupted"
                                                                  : "failed";
    if (!message.empty()) summary["message"] = message;
    summary["time_s"] = model_.clock.time;
    summary["steps"] = model_.clock.steps;
    summary["coupling_cycles"] = model_.clock.cycles;
    summary["wall_seconds"] = figures.wall_seconds;
    summary["threads"] = figures.threads;
    if (model_.fluid) {
        summary["particles"] = model_.fluid->particles.count;
        summary["particles_removed"] = model_.fluid->removed;
        summary["particles_held_back_at_walls"] = model_.fluid->held_back;
        summary["neighbour_list_rebuilds"] = model_.fluid->rebuilds;
        summary["bytes_per_particle"] = bytes_per_particle(*model_.fluid);
    }
    if (model_.solid) {
        const solid::Statistics statistics = model_.solid->statistics();
        summary["elements"] = model_.solid->mesh().elements.size();
        summary["nodes"] = model_.solid->mesh().nodes.size();
        summary["solid"] = {{"steps", statistics.steps},
                            {"newton_iterations", statistics.newton_iterations},
                            {"factorisations", statistics.factorisations}};
    }
    io::Report report;
    for (const PassTime& pass : figures.passes) {
        nlohmann::json entry = {
            {"calls", pass.calls}, {"wall_seconds", pass.wall_seconds}, {"thread_seconds", pass.busy_seconds}};
        if (pass.pairs > 0) entry["pairs_per_second_per_core"] = pass.pairs_per_second();
        summary["tasks"][pass.name] = entry;
        report.tasks.push_back({pass.name, pass.family, pass.wall_seconds, pass.calls, pass.pairs});
    }
    summary["comparisons"] = errors;
    io::write_summary(folder_ / "summary.json", summary);

    const auto text = [](double value, int digits) {
        char buffer[40];
        std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
        return std::string(buffer);
    };
    report.outcome = outcome;
    report.message = message;
    report.reached_time = model_.clock.time;
    report.wall_seconds = figures.wall_seconds;
    report.key_numbers = {
        {"Wall-clock time", text(figures.wall_seconds, 4), "s", "on " + std::to_string(figures.threads) + " threads"},
        {"Fluid steps", std::to_string(model_.clock.steps), "", ""}};
    if (model_.fluid)
        report.key_numbers.push_back(
            {"Particles", std::to_string(model_.fluid->particles.count), "",
             model_.fluid->removed == 0 ? "" : std::to_string(model_.fluid->removed) + " have left the domain"});
    if (model_.solid)
        report.key_numbers.push_back(
            {"Elements", std::to_string(model_.solid->mesh().elements.size()), "",
             std::to_string(model_.solid->statistics().newton_iterations) + " Newton iterations"});
    report.summary = summary;
    io::write_report(folder_ / "report.html", scene_, report, history, comparisons, flow_);
    return comparisons;
}

}  // namespace aquagraph::engine
