#include "engine/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "engine/dry_start.hpp"
#include "engine/forecast.hpp"
#include "engine/results.hpp"
#include "engine/sharp_corners.hpp"
#include "engine/staggering.hpp"
#include "io/scheme_text.hpp"
#include "io/wording.hpp"
#include "physics/fluid/rebuild.hpp"
#include "tasks/executor.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

namespace {

std::string duration(double seconds) {
    constexpr double day = 86400, year = 365.25 * day;
    if (seconds < 90) return fmt::format("about {:.0f} s", std::max(1.0, seconds));
    if (seconds < 5400) return fmt::format("about {:.0f} min", seconds / 60);
    if (seconds < 2 * day) return fmt::format("about {:.1f} h", seconds / 3600);
    if (seconds < 2 * year) return fmt::format("about {:.1f} days", seconds / day);
    return seconds < 1000 * year ? fmt::format("about {:.0f} years", seconds / year) : "more than a thousand years";
}

// Up to a million all digits; beyond that they say nothing.
std::string steps_text(double steps) {
    return steps < 1e6 ? fmt::format("{:.0f}", steps) : fmt::format("{:.3g}", steps);
}

const char* load_text(coupling::LoadMethod load) {
    switch (load) {
        case coupling::LoadMethod::averaged_pressure:
            return "averaged-pressure";
        case coupling::LoadMethod::energy_conservative:
            return "energy-conservative";
        default:
            return "force-conservative";
    }
}

void print_filling(std::ostream& out, const FilledBody& body) {
    if (body.key.starts_with("fluid.box")) return;  // whole cells
    out << fmt::format("water      {}: {} particles, {:.4g} of {:.4g}, {:+.2f} %", body.key, body.particles,
                       body.filled, body.volume, 100 * (body.filled / body.volume - 1));
    if (body.relaxed)
        out << fmt::format("; kernel sum scatters by {:.2g}, before relaxation {:.2g} ({} steps{})",
                           body.relaxation.after, body.relaxation.before, body.relaxation.steps,
                           body.relaxation.reached ? "" : ", tolerance not reached");
    out << "\n";
}

template <int D>
void print_solid(std::ostream& out, const io::Scene& scene, const solid::Mesh<D>& mesh) {
    const std::size_t nodes = mesh.elements.front().size();
    out << fmt::format("solid      {} {} of {} nodes, {} nodes, ", mesh.elements.size(),
                       D == 2        ? "quadrilaterals"
                       : nodes == 10 ? "tetrahedra"
                                     : "hexahedra",
                       nodes, mesh.nodes.size());
    if (scene.solid->is_static)
        out << "static\n";
    else
        out << (scene.solid->scheme == solid::Scheme::central_difference
                    ? std::string("central differences\n")
                    : fmt::format("{} with αs = {:g}\n", scene.solid->scheme == solid::Scheme::hht ? "HHT" : "Newmark",
                                  scene.solid->alpha));
}

void print_run_time(std::ostream& out, const Forecast& made, int threads, const std::string& remark) {
    if (made.no_solid_step.empty())
        out << fmt::format("run time   {} on {} of this machine{}\n", duration(made.seconds),
                           io::counted(threads, "thread"), remark);
    else
        out << "run time   unknown: " << made.no_solid_step << "\n";
}

template <int D>
void check_structure(const io::Scene& scene, Model<D>& model, tasks::Executor& executor, std::ostream& out) {
    print_solid(out, scene, model.solid->mesh());
    const Forecast made = forecast(scene, model, executor);
    out << fmt::format("loads      {} besides gravity\ntime       {:g} s in {} steps of {:.3g} s\n",
                       model.structure->loads.size(), scene.end_time, steps_text(made.steps), made.step);
    print_run_time(out, made, executor.threads(), ", without what is written");
}

template <int D>
void check_fluid(const io::Scene& scene, Model<D>& model, tasks::Executor& executor, std::ostream& out) {
    fluid::Fluid<D>& fluid = *model.fluid;
    executor.execute([&] {
        if (model.flux_walls)
            rebuild_lists(fluid, *model.flux_walls, tasks::parallel_loop);
        else
            rebuild_lists(fluid, model.walls ? &*model.walls : nullptr, tasks::parallel_loop);
    });
    const double n = double(std::max<std::size_t>(1, fluid.particles.count));
    std::optional<Staggering> staggering;
    if constexpr (D == 2)
        if (model.interface) staggering = forecast_staggering(scene, model);
    const Forecast made = forecast(scene, model, executor);
    out << fmt::format("fluid      {}; {} particles of {:.4g} m, R/Δx {:g}, {:.0f} neighbours\n",
                       io::scheme_text(*scene.fluid), fluid.particles.count, fluid.spacing, scene.fluid->support_ratio,
                       double(made.pairs) / n);
    for (const FilledBody& body : model.water) print_filling(out, body);
    if (model.flux_walls)
        out << fmt::format("walls      normal fluxes: {} panels, {} points, {} particles near them\n",
                           model.flux_walls->panels.size() - model.flux_walls->panels.copies,
                           model.flux_walls->points.size(), model.flux_walls->near_wall_count());
    if (model.walls)
        out << fmt::format("walls      ghost particles: {} panels, {} ghosts\n", model.walls->panels.panels.size(),
                           model.walls->ghosts.size());
    if constexpr (D == 2)
        if (model.walls)
            for (const std::string& corner : sharp_corners(model.walls->panels)) out << "warning    " << corner << "\n";
    for (const DryStart<D>& dry : dry_starts(scene, model)) out << "warning    " << text_of(dry, model) << "\n";
    if (model.solid) print_solid(out, scene, model.solid->mesh());
    using Algorithm = io::CouplingAlgorithm;
    const Algorithm algorithm = scene.coupling.algorithm;
    if (model.interface)
        out << fmt::format("coupling   {}, p {} {}, {} load on {} nodes\n",
                           algorithm == Algorithm::cps   ? "CPS (fluid and solid side by side)"
                           : algorithm == Algorithm::css ? "CSS (solid after fluid)"
                                                         : "iterated until both agree",
                           scene.coupling.ratio_control ? "up to" : "=", scene.coupling.ratio,
                           load_text(scene.coupling.load), model.interface->surface.vertices());
    if (staggering) out << "stability  " << text_of(*staggering) << "\n";
    out << fmt::format("time       {:g} s in about {} steps of {:.3g} s ({})\n", scene.end_time, steps_text(made.steps),
                       made.step, made.limiter);
    out << fmt::format("memory     {:.1f} MB, {:.0f} bytes per particle\n", bytes_per_particle(fluid) * n / 1e6,
                       bytes_per_particle(fluid));
    print_run_time(out, made, executor.threads(),
                   model.interface && algorithm == Algorithm::iterated ? " for each iteration of its cycles" : "");
}

template <int D>
void check_in(const io::Scene& scene, int threads, std::ostream& out) {
    tasks::Executor executor(threads);
    const std::unique_ptr<Model<D>> model = make_model<D>(scene);
    history_columns(scene, *model);  // for what it refuses
    out << scene.title << "\n";
    if (!scene.overrides.empty()) out << fmt::format("changed    {}\n", fmt::join(scene.overrides, ", "));
    if (model->structure) check_structure(scene, *model, executor, out);
    if (model->fluid) check_fluid(scene, *model, executor, out);
}

}  // namespace

void check(const io::Scene& scene, int threads, std::ostream& out) {
    scene.dimension == 3 ? check_in<3>(scene, threads, out) : check_in<2>(scene, threads, out);
}

}  // namespace aquagraph::engine
