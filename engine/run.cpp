#include "engine/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <optional>
#include <system_error>

#include "engine/checkpoints.hpp"
#include "engine/cycle_graphs.hpp"
#include "engine/diagnosis.hpp"
#include "engine/listings.hpp"
#include "engine/results.hpp"
#include "engine/stop_request.hpp"
#include "engine/trace_summary.hpp"
#include "io/progress.hpp"
#include "tasks/executor.hpp"
#include "tasks/trace.hpp"

namespace aquagraph::engine {

namespace {

// 42 MB a thread, taken only with --trace: some thousand cycles of a small scene.
constexpr std::size_t trace_events_per_thread = std::size_t{1} << 20;

// Those of an earlier part of the run, and those of this one.
std::vector<PassTime> together(std::vector<PassTime> passes, const std::vector<PassTime>& more) {
    for (const PassTime& pass : more) {
        auto same =
            std::find_if(passes.begin(), passes.end(), [&](const PassTime& other) { return other.name == pass.name; });
        if (same == passes.end()) {
            passes.push_back(pass);
            continue;
        }
        same->calls += pass.calls;
        same->wall_seconds += pass.wall_seconds;
        same->busy_seconds += pass.busy_seconds;
        same->pairs += pass.pairs;
    }
    return passes;
}

void print_table(std::ostream& out, const RunFigures& figures) {
    double busy = 0;
    for (const PassTime& pass : figures.passes) busy += pass.busy_seconds;
    out << fmt::format("{:<20} {:>9} {:>10} {:>10} {:>7} {:>16}\n", "task", "calls", "wall [s]", "threads [s]", "share",
                       "Mpairs/s/core");
    for (const PassTime& pass : figures.passes)
        out << fmt::format("{:<20} {:>9} {:>10.3f} {:>10.3f} {:>6.1f}% {:>16}\n", pass.name, pass.calls,
                           pass.wall_seconds, pass.busy_seconds, busy > 0 ? 100 * pass.busy_seconds / busy : 0,
                           pass.pairs > 0 ? fmt::format("{:.1f}", pass.pairs_per_second() / 1e6) : "");
}

void print_comparisons(std::ostream& out, const std::vector<io::Comparison>& comparisons) {
    for (const io::Comparison& c : comparisons) {
        if (!c.error) continue;
        if (c.points == 0)
            out << fmt::format("{} against {}: nothing to compare in [{:g}, {:g}] s, which the run has not reached\n",
                               c.column, c.label, c.window[0], c.window[1]);
        else
            out << fmt::format(
                "{} against {}: RMS {:.4g} {} ({:.1f} % of the peak), mean {:+.3g} {}, {} points in [{:g}, {:g}] s\n",
                c.column, c.label, c.rms, c.unit, 100 * c.normalised, c.mean, c.unit, c.points, c.window[0],
                c.window[1]);
    }
}

// Says what has not gone to its end, and where what there is lies.
ExitCode exit_code(const RunEnd& end, StopRequest request, long steps, const std::filesystem::path& folder,
                   std::ostream& err) {
    switch (end.outcome) {
        case io::RunOutcome::failed:
            err << "aquagraph: " << end.message << "\nWhat was computed until then is in " << folder.string() << "\n";
            return run_failed;
        case io::RunOutcome::interrupted:
            err << "aquagraph: " << end.message << "; results kept in " << folder.string()
                << (steps > 0 ? "; go on with --restart auto\n" : "\n");
            return request == StopRequest::checkpoint ? stopped : interrupted;
        default:
            return success;
    }
}

template <int D>
ExitCode run_in(const io::Scene& scene, const RunOptions& options, std::ostream& out, std::ostream& err) {
    const std::filesystem::path folder =
        options.folder.empty() ? std::filesystem::path("results") / scene.name : options.folder;
    tasks::Executor executor(options.threads);
    std::optional<tasks::Trace> trace;
    if (!options.trace.empty()) {
        trace.emplace(tasks::Trace::Options{.events_per_thread = trace_events_per_thread});
        if (!std::ofstream(options.trace))  // known now rather than after the run
            throw std::system_error(errno, std::generic_category(), "cannot write " + options.trace.string());
    }

    std::optional<RestartPoint> from = find_restart_point(scene, folder, options.restart, err);
    const std::unique_ptr<Model<D>> model = make_model<D>(scene);
    Results<D> results(scene, *model, folder, from.has_value());
    Checkpoints<D> checkpoints(scene, *model, results,
                               options.checkpoint_every.value_or(scene.output.checkpoint_interval), from);
    CycleGraphs<D> graphs(*model, scene, results, executor, trace ? &*trace : nullptr);

    RunFigures before;
    if (from) {
        executor.execute([&] { before = checkpoints.restore(*from); });
        ++before.restarts;
        from->state = {};
    }
    const StopSignals signals;
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    const auto figures = [&] {
        return RunFigures{before.wall_seconds + seconds(), executor.threads(), together(before.passes, graphs.passes()),
                          before.restarts};
    };
    io::RunOutcome outcome = io::RunOutcome::finished;
    std::string message;
    std::optional<io::Progress> progress;
    if (!options.quiet)
        progress.emplace(out, &out == &std::cout && io::Progress::is_terminal(STDOUT_FILENO), scene.end_time,
                         model->clock.time);
    Clock& clock = model->clock;
    try {
        if (!from) {
            executor.execute([&] {
                start(*model, scene);
                for (const tasks::Task& task : first_evaluation(*model)) task.body();
                results.measure();
            });
            results.history_if_due();
            results.frame_if_due();
        }
        while (clock.time < clock.end * (1 - 1e-12)) {
            if (signals.request() != StopRequest::none) {
                outcome = io::RunOutcome::interrupted;
                message = fmt::format("{} at t = {:.6g} s of {:.6g} s",
                                      signals.request() == StopRequest::checkpoint ? "stopped" : "interrupted",
                                      clock.time, clock.end);
                checkpoints.write(figures());  // before anything is measured that an uninterrupted run would not
                executor.execute([&] { results.measure(); });
                break;
            }
            graphs.run();
            if (checkpoints.is_due() && clock.time < clock.end) checkpoints.write(figures());
            if (progress) progress->update({clock.time, clock.steps, clock.step, clock.limiter});
        }
    } catch (const tasks::TaskError& error) {
        outcome = io::RunOutcome::failed;
        message = describe(*model, error);
    } catch (const solid::SolverError& error) {
        outcome = io::RunOutcome::failed;
        message = error.what();
    } catch (const std::system_error& error) {
        outcome = io::RunOutcome::failed;
        message = fmt::format("{} (t = {:.6g} s, step {}); the checkpoint before, if there is one, is untouched",
                              error.what(), clock.time, clock.steps);
    }
    if (progress) progress->finish();

    const RunEnd end{outcome, message, figures()};
    std::vector<io::Comparison> comparisons;
    try {
        if (outcome != io::RunOutcome::finished) {
            results.write_history_row();
            results.write_frame();
        }
        comparisons = results.finish(end);
        if (trace) {
            trace->write(options.trace.string());
            if (trace->dropped_count() > 0)
                err << fmt::format("aquagraph: the trace was full and lacks its last {} events; trace a shorter run\n",
                                   trace->dropped_count());
        }
    } catch (const std::exception& error) {  // a full disk: what had been written before is there
        if (!message.empty()) err << "aquagraph: " << message << "\n";
        err << "aquagraph: the end of the run could not be written: " << error.what() << "\n"
            << "What was written before is in " << folder.string() << "\n";
        return run_failed;
    }

    if (!options.quiet) {
        print_table(out, end.figures);
        print_comparisons(out, comparisons);
        if (trace) print(summarise_trace(options.trace), out);
        out << fmt::format("{} steps in {:.2f} s on {} threads; results in {}\n", clock.steps, end.figures.wall_seconds,
                           end.figures.threads, folder.string());
    }
    return exit_code(end, signals.request(), clock.steps, folder, err);
}

}  // namespace

ExitCode run(const io::Scene& scene, const RunOptions& options, std::ostream& out, std::ostream& err) {
    return scene.dimension == 3 ? run_in<3>(scene, options, out, err) : run_in<2>(scene, options, out, err);
}

}  // namespace aquagraph::engine
