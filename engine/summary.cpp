#include "engine/summary.hpp"

#include <fmt/format.h>

#include "engine/version.hpp"
#include "io/scene_json.hpp"
#include "io/wording.hpp"

namespace aquagraph::engine {

namespace {

const char* name_of(io::RunOutcome outcome) {
    switch (outcome) {
        case io::RunOutcome::finished:
            return "finished";
        case io::RunOutcome::interrupted:
            return "interrupted";
        case io::RunOutcome::failed:
            break;
    }
    return "failed";
}

}  // namespace

template <int D>
nlohmann::json summary_of(const io::Scene& scene, const Model<D>& model, const RunEnd& end) {
    nlohmann::json summary;
    summary["version"] = version;
    summary["scene"] = io::to_json(scene);  // as resolved
    summary["scene_file"] = {{"name", scene.file.filename().string()}, {"text", scene.text}, {"set", scene.overrides}};
    summary["outcome"] = name_of(end.outcome);
    if (!end.message.empty()) summary["message"] = end.message;
    summary["time_s"] = model.clock.time;
    summary["steps"] = model.clock.steps;
    summary["coupling_cycles"] = model.clock.cycles;
    summary["wall_seconds"] = end.figures.wall_seconds;
    summary["threads"] = end.figures.threads;
    summary["restarts"] = end.figures.restarts;
    if (model.fluid) {
        summary["particles"] = model.fluid->particles.count;
        summary["particles_removed"] = model.fluid->removed;
        summary["particles_held_back_at_walls"] = model.fluid->held_back;
        if (model.flux_walls) summary["gamma_at_its_floor"] = model.flux_walls->floor_count;
        summary["neighbour_list_rebuilds"] = model.fluid->rebuilds;
        summary["steps_that_outran_their_lists"] = model.fluid->outrun;
        if (model.clock.use.allowed > 0)
            summary["mean_step_over_largest"] = model.clock.use.taken / model.clock.use.allowed;
        summary["cycles_with_overlong_steps"] = model.clock.use.overlong;
        summary["bytes_per_particle"] = bytes_per_particle(*model.fluid);
    }
    for (const FilledBody& body : model.water) {
        nlohmann::json entry = {{"shape", body.key},
                                {"particles", body.particles},
                                {"volume", body.volume},
                                {"filled_volume", body.filled}};
        if (body.relaxed)
            entry["relaxation"] = {{"kernel_sum_deviation_before", body.relaxation.before},
                                   {"kernel_sum_deviation_after", body.relaxation.after},
                                   {"steps", body.relaxation.steps},
                                   {"tolerance_reached", body.relaxation.reached}};
        summary["water"].push_back(entry);
    }
    if (model.solid) {
        const solid::Statistics statistics = model.solid->statistics();
        summary["elements"] = model.solid->mesh().elements.size();
        summary["nodes"] = model.solid->mesh().nodes.size();
        summary["solid"] = {{"steps", statistics.steps},
                            {"newton_iterations", statistics.newton_iterations},
                            {"factorisations", statistics.factorisations}};
    }
    if (model.interface && model.interface->fixed_point.total_iterations > 0)
        summary["iterations"] = {{"total", model.interface->fixed_point.total_iterations},
                                 {"cycles", model.interface->fixed_point.cycles},
                                 {"unconverged_cycles", model.interface->fixed_point.unconverged},
                                 {"failed_trials", model.interface->fixed_point.failed_trials}};
    for (const PassTime& pass : end.figures.passes) {
        nlohmann::json entry = {
            {"calls", pass.calls}, {"wall_seconds", pass.wall_seconds}, {"thread_seconds", pass.busy_seconds}};
        if (pass.pairs > 0) entry["pairs_per_second_per_core"] = pass.pairs_per_second();
        summary["tasks"][pass.name] = entry;
    }
    return summary;
}

template <int D>
io::Report report_of(const Model<D>& model, const RunEnd& end) {
    io::Report report;
    report.outcome = end.outcome;
    report.message = end.message;
    report.reached_time = model.clock.time;
    report.wall_seconds = end.figures.wall_seconds;
    report.key_numbers = {{"Wall-clock time", fmt::format("{:.4g}", end.figures.wall_seconds), "s",
                           "on " + io::counted(end.figures.threads, "thread")},
                          {model.fluid ? "Fluid steps" : "Steps", std::to_string(model.clock.steps), "", ""}};
    if (model.fluid)
        report.key_numbers.push_back(
            {"Particles", std::to_string(model.fluid->particles.count), "",
             model.fluid->removed == 0 ? "" : fmt::format("{} have left the domain", model.fluid->removed)});
    if (model.solid)
        report.key_numbers.push_back(
            {"Elements", std::to_string(model.solid->mesh().elements.size()), "",
             fmt::format("{} Newton iterations", model.solid->statistics().newton_iterations)});
    for (const PassTime& pass : end.figures.passes)
        report.tasks.push_back({pass.name, pass.family, pass.wall_seconds, pass.calls, pass.pairs});
    return report;
}

template nlohmann::json summary_of(const io::Scene&, const Model<2>&, const RunEnd&);
template nlohmann::json summary_of(const io::Scene&, const Model<3>&, const RunEnd&);
template io::Report report_of(const Model<2>&, const RunEnd&);
template io::Report report_of(const Model<3>&, const RunEnd&);

}  // namespace aquagraph::engine
