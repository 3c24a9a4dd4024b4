#include "engine/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>

#include "engine/body_parts.hpp"
#include "engine/listings.hpp"
#include "io/scheme_text.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/rebuild.hpp"
#include "physics/fluid/time_step.hpp"
#include "tasks/executor.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

namespace {

// Share of a run that gradients and fluxes take; the rest is searches, stages, ghosts, output. Measured: 0.82 (gate),
// 0.87 (dam break), 0.90 (still tank), 0.85 (dam break in 3D).
constexpr double pass_share = 0.85;
// The lists of a step reach as much further than R as particles of this Mach number may move in it.
constexpr double usual_mach = 0.05;

std::string duration(double seconds) {
    if (seconds < 90) return fmt::format("{:.0f} s", std::max(1.0, seconds));
    if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
    if (seconds < 2 * 86400) return fmt::format("{:.1f} h", seconds / 3600);
    return fmt::format("{:.1f} days", seconds / 86400);
}

// Wall-clock time of one evaluation of all rates, normal flux walls included: the median of a few.
template <int D>
double time_evaluation(Model<D>& model, double step, tasks::Executor& executor) {
    fluid::Fluid<D>& fluid = *model.fluid;
    auto* const walls = model.flux_walls ? &*model.flux_walls : nullptr;
    executor.execute([&] {
        prune(fluid.particles, fluid.lists, 2 * usual_mach * fluid.tait.sound_speed * step, tasks::parallel_loop);
    });
    std::array<double, 5> times{};
    for (double& time : times) {
        const auto begin = std::chrono::steady_clock::now();
        executor.execute([&] {
            tasks::for_each_block(fluid.blocks(), [&](std::size_t block) {
                compute_gradients(fluid.particles, fluid.lists, fluid.kernel, fluid.lanes(block), fluid.gradients());
                if (!walls) return;
                walls->compute_gamma(fluid.particles, fluid.kernel, block);
                walls->complete_gradients(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, block);
            });
            tasks::for_each_block(fluid.blocks(), [&](std::size_t block) {
                compute_fluxes(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, fluid.tait, fluid.lanes(block));
                if (walls)
                    walls->add_fluxes(fluid.particles, fluid.kernel, fluid.flux, fluid.tait.reference_density, block);
            });
        });
        time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
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

// Of a body alone: one step is made to see how long it takes.
template <int D>
void check_structure(const io::Scene& scene, Model<D>& model, tasks::Executor& executor, std::ostream& out) {
    print_solid(out, scene, model.solid->mesh());
    if (scene.solid->scheme == solid::Scheme::central_difference) executor.execute([&] { static_start(scene, model); });
    const double steps = std::ceil(scene.end_time / model.structure->step * (1 - 1e-9));
    out << fmt::format("loads      {} besides gravity\ntime       {:g} s in {:.0f} steps of {:.3g} s\n",
                       model.structure->loads.size(), scene.end_time, steps, scene.end_time / steps);
    double seconds = 0;
    try {
        executor.execute([&] {
            const auto step = structural_step(model);
            for (int k = 0; k < 2; ++k) {  // the first one also finds the initial acceleration
                const auto begin = std::chrono::steady_clock::now();
                for (const tasks::Task& task : step) task.body();
                seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
                if (model.clock.time >= model.clock.end) break;
            }
        });
    } catch (const solid::ConvergenceError& error) {
        out << "run time   unknown: " << error.what() << "\n";
        return;
    }
    out << fmt::format("run time   about {} on {} threads of this machine, without what is written\n",
                       duration(steps * seconds), executor.threads());
}

template <int D>
void check_in(const io::Scene& scene, int threads, std::ostream& out) {
    tasks::Executor executor(threads);
    const std::unique_ptr<Model<D>> model = make_model<D>(scene);
    out << scene.title << "\n";
    if (model->structure) check_structure(scene, *model, executor, out);
    if (model->fluid) {
        fluid::Fluid<D>& fluid = *model->fluid;
        executor.execute([&] {
            if (model->flux_walls)
                rebuild_lists(fluid, *model->flux_walls, tasks::parallel_loop);
            else
                rebuild_lists(fluid, model->walls ? &*model->walls : nullptr, tasks::parallel_loop);
        });
        fluid::StepLimits limits;
        for (std::size_t block = 0; block < fluid.blocks(); ++block)
            limits = combine(limits, step_limits(fluid.particles, fluid.cfl, fluid.kernel.radius(), fluid.lanes(block),
                                                 fluid.viscosity_of_step()));
        using Algorithm = io::CouplingAlgorithm;
        const Algorithm algorithm = scene.coupling.algorithm;
        const bool fixed = model->interface && algorithm != Algorithm::css;
        const double step = (fixed ? scene.coupling.step_fraction : 1) * limits.step();
        const double steps = std::ceil(scene.end_time / step);
        const double n = double(std::max<std::size_t>(1, fluid.particles.count));
        const double evaluation = time_evaluation(*model, step, executor);
        out << fmt::format("fluid      {}; {} particles of {:.4g} m, R/Δx {:g}, {:.0f} neighbours\n",
                           io::scheme_text(*scene.fluid), fluid.particles.count, fluid.spacing,
                           scene.fluid->support_ratio, double(fluid.lists.pairs()) / n);
        for (const FilledBody& body : model->water) print_filling(out, body);
        if (model->flux_walls)
            out << fmt::format("walls      normal fluxes: {} panels, {} points, {} particles near them\n",
                               model->flux_walls->panels.size() - model->flux_walls->panels.copies,
                               model->flux_walls->points.size(),
                               model->flux_walls->near_wall_count());
        if (model->walls)
            out << fmt::format("walls      ghost particles: {} panels, {} ghosts\n", model->walls->panels.panels.size(),
                               model->walls->ghosts.size());
        if (model->solid) print_solid(out, scene, model->solid->mesh());
        if (model->interface)
            out << fmt::format("coupling   {}, p {} {}, {} load on {} nodes\n",
                               algorithm == Algorithm::cps   ? "CPS (fluid and solid side by side)"
                               : algorithm == Algorithm::css ? "CSS (solid after fluid)"
                                                             : "iterated until both agree",
                               scene.coupling.ratio_control ? "up to" : "=", scene.coupling.ratio,
                               load_text(scene.coupling.load), model->interface->surface.vertices());
        out << fmt::format("time       {:g} s in about {:.0f} steps of {:.3g} s ({})\n", scene.end_time, steps, step,
                           limits.name());
        out << fmt::format("memory     {:.1f} MB, {:.0f} bytes per particle\n", bytes_per_particle(fluid) * n / 1e6,
                           bytes_per_particle(fluid));
        out << fmt::format("run time   about {} on {} threads of this machine\n",
                           duration(steps * fluid.integration.stages() * evaluation / pass_share), executor.threads());
    }
}

}  // namespace

void check(const io::Scene& scene, int threads, std::ostream& out) {
    scene.dimension == 3 ? check_in<3>(scene, threads, out) : check_in<2>(scene, threads, out);
}

}  // namespace aquagraph::engine
