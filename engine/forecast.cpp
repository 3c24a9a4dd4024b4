#include "engine/forecast.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "engine/body_parts.hpp"
#include "engine/listings.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/rebuild.hpp"
#include "physics/fluid/time_step.hpp"
#include "physics/solid/stable_steps.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

namespace {

// Share of a run that gradients and fluxes take; the rest is searches, stages, ghosts, output. Measured: 0.82 (gate),
// 0.87 (dam break), 0.90 (still tank), 0.85 (dam break in 3D).
constexpr double pass_share = 0.85;
// The lists of a step reach as much further than R as particles of this Mach number may move in it.
constexpr double usual_mach = 0.05;

template <class Work>
double time(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// The median of a few, so that another program in between does not count.
template <std::size_t few, class Work>
double typical_time(const Work& work) {
    std::array<double, few> times{};
    for (double& seconds : times) seconds = time(work);
    std::sort(times.begin(), times.end());
    return times[few / 2];
}

// Wall-clock time of one evaluation of all rates, normal flux walls included.
template <int D>
double time_evaluation(Model<D>& model, double step, tasks::Executor& executor) {
    fluid::Fluid<D>& fluid = *model.fluid;
    auto* const walls = model.flux_walls ? &*model.flux_walls : nullptr;
    executor.execute([&] {
        prune(fluid.particles, fluid.lists, 2 * usual_mach * fluid.tait.sound_speed * step, tasks::parallel_loop);
    });
    const auto evaluate = [&] {
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
    };
    return typical_time<5>([&] { executor.execute(evaluate); });
}

// Of a body alone. The first step also finds the first acceleration, the second is timed.
template <int D>
void forecast_structure(const io::Scene& scene, Model<D>& model, Forecast& made) {
    if (scene.solid->scheme == solid::Scheme::central_difference) static_start(scene, model);
    made.steps = std::ceil(scene.end_time / model.structure->step * (1 - 1e-9));
    made.step = scene.end_time / made.steps;
    const auto step = structural_step(model);
    double seconds = 0;
    for (int k = 0; k < 2 && model.clock.time < model.clock.end; ++k)
        seconds = time([&] {
            for (const tasks::Task& task : step) task.body();
        });
    made.seconds = made.solid_seconds = made.steps * seconds;
}

// A step of the body in water, over a cycle of p fluid steps, which under these loads it begins to move in.
double time_solve(const io::Scene& scene, Model<2>& model, double cycle) {
    start(model, scene);
    coupling::Interface& interface = *model.interface;
    const auto step = [&] {
        advance_stably(solver_of(model), cycle, interface.solid_loads, interface.borne_loads, interface.between,
                       tasks::parallel_loop);
    };
    step();  // also finds the first acceleration
    return typical_time<3>(step);
}

}  // namespace

template <int D>
Forecast forecast(const io::Scene& scene, Model<D>& model, tasks::Executor& executor) {
    Forecast made;
    if (model.structure) {
        try {
            executor.execute([&] { forecast_structure(scene, model, made); });
        } catch (const solid::SolverError& error) {
            made.no_solid_step = error.what();
        }
        return made;
    }
    fluid::Fluid<D>& fluid = *model.fluid;
    fluid::StepLimits limits;
    for (std::size_t block = 0; block < fluid.blocks(); ++block)
        limits = combine(limits, step_limits(fluid.particles, fluid.cfl, fluid.kernel.radius(), fluid.lanes(block),
                                             fluid.viscous_rate()));
    const bool css = scene.coupling.algorithm == io::CouplingAlgorithm::css;
    made.step = (model.interface && !css ? scene.coupling.step_fraction : 1) * limits.step();
    made.steps = std::ceil(scene.end_time / made.step);
    made.limiter = limits.name();
    made.seconds = made.fluid_seconds =
        made.steps * fluid.integration.stages() * time_evaluation(model, made.step, executor) / pass_share;
    made.pairs = fluid.lists.pairs();
    if constexpr (D == 2)
        if (model.interface) {
            const int p = model.interface->ratio.p;  // regulated: 1, where it begins
            try {
                executor.execute(
                    [&] { made.solid_seconds = std::ceil(made.steps / p) * time_solve(scene, model, p * made.step); });
            } catch (const solid::SolverError& error) {
                made.no_solid_step = error.what();
            }
            // Side by side the solve takes one of the threads.
            made.seconds =
                css ? made.fluid_seconds + made.solid_seconds
                    : std::max(made.fluid_seconds + made.solid_seconds / executor.threads(), made.solid_seconds);
        }
    return made;
}

template Forecast forecast(const io::Scene&, Model<2>&, tasks::Executor&);
template Forecast forecast(const io::Scene&, Model<3>&, tasks::Executor&);

}  // namespace aquagraph::engine
