#include "engine/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/checkpoints.hpp"
#include "engine/cycle_graphs.hpp"
#include "engine/diagnosis.hpp"
#include "engine/dry_start.hpp"
#include "engine/listings.hpp"
#include "engine/results.hpp"
#include "engine/sharp_corners.hpp"
#include "engine/staggering.hpp"
#include "engine/stop_request.hpp"
#include "engine/trace_summary.hpp"
#include "io/progress.hpp"
#include "io/wording.hpp"
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
                "{} against {}: RMS {:.4g} {} ({:.1f} % of the peak), mean {:+.3g} {}, {} in [{:g}, {:g}] s\n",
                c.column, c.label, c.rms, c.unit, 100 * c.normalised, c.mean, c.unit,
                io::counted(long(c.points), "point"), c.window[0], c.window[1]);
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

// The file is made at once: one that cannot be written is known before the run rather than after it.
std::optional<tasks::Trace> trace_into(const std::filesystem::path& file) {
    if (file.empty()) return std::nullopt;
    if (!std::ofstream(file)) throw std::system_error(errno, std::generic_category(), "cannot write " + file.string());
    return std::optional<tasks::Trace>(std::in_place,
                                       tasks::Trace::Options{.events_per_thread = trace_events_per_thread});
}

// A run from its start or from a checkpoint to its end.
template <int D>
class Run {
  public:
    // Finds out what cannot be computed, read or written before anything is computed.
    Run(const io::Scene& scene, const RunOptions& options, std::ostream& out, std::ostream& err)
        : scene_(scene),
          options_(options),
          out_(out),
          err_(err),
          folder_(options.folder.empty() ? std::filesystem::path("results") / scene.name : options.folder),
          executor_(options.threads),
          trace_(trace_into(options.trace)),
          from_(find_restart_point(scene, folder_, options.restart, err)),
          model_(make_model<D>(scene)),
          results_(scene, *model_, folder_, from_.has_value()),
          checkpoints_(scene, *model_, results_, options.checkpoint_every.value_or(scene.output.checkpoint_interval),
                       from_),
          graphs_(*model_, scene, results_, executor_, trace_ ? &*trace_ : nullptr) {}

    ExitCode whole() {
        if (from_)
            restore();
        else
            warn();
        const StopSignals signals;
        begin_ = std::chrono::steady_clock::now();
        const RunEnd end = computed(signals);
        std::vector<io::Comparison> comparisons;
        try {
            comparisons = write_end(end);
        } catch (const std::exception& error) {  // a full disk: what had been written before is there
            if (!end.message.empty()) err_ << "aquagraph: " << end.message << "\n";
            err_ << "aquagraph: the end of the run could not be written: " << error.what() << "\n"
                 << "What was written before is in " << folder_.string() << "\n";
            return run_failed;
        }
        if (!options_.quiet) print_end(end, comparisons);
        return exit_code(end, signals.request(), model_->clock.steps, folder_, err_);
    }

  private:
    void restore() {
        executor_.execute([&] { before_ = checkpoints_.restore(*from_); });
        ++before_.restarts;
        from_->state = {};
    }

    // Cycle by cycle to the end, to a request to stop, or to the first thing that goes wrong.
    RunEnd computed(const StopSignals& signals) {
        const Clock& clock = model_->clock;
        std::optional<io::Progress> progress;
        if (!options_.quiet)
            progress.emplace(out_, &out_ == &std::cout && io::Progress::is_terminal(STDOUT_FILENO), scene_.end_time,
                             clock.time);
        RunEnd end;
        const auto fails = [&end](std::string message) {
            end.outcome = io::RunOutcome::failed;
            end.message = std::move(message);
        };
        try {
            if (!from_) start_from_nothing();
            while (clock.time < clock.end * (1 - 1e-12)) {
                if (signals.request() != StopRequest::none) {
                    end.outcome = io::RunOutcome::interrupted;
                    end.message = fmt::format("{} at t = {:.6g} s of {:.6g} s",
                                              signals.request() == StopRequest::checkpoint ? "stopped" : "interrupted",
                                              clock.time, clock.end);
                    leave_checkpoint();
                    break;
                }
                graphs_.run();
                if (checkpoints_.is_due() && clock.time < clock.end) checkpoints_.write(figures());
                if (progress) progress->update({clock.time, clock.steps, clock.step, clock.limiter});
            }
        } catch (const tasks::TaskError& error) {
            fails(describe(*model_, error));
        } catch (const solid::SolverError& error) {
            fails(error.what());
        } catch (const std::system_error& error) {
            fails(fmt::format(
                "{} (t = {:.6g} s, step {}); the checkpoint before, if there is one, is untouched: see that "
                "there is room and the right to write, then go on with --restart auto",
                error.what(), clock.time, clock.steps));
        }
        if (progress) progress->finish();
        end.figures = figures();
        return end;
    }

    void start_from_nothing() {
        executor_.execute([&] {
            start(*model_, scene_);
            for (const tasks::Task& task : first_evaluation(*model_)) task.body();
            results_.measure();
        });
        results_.history_if_due();
        results_.frame_if_due();
    }

    // Once, at the beginning: what may be meant and may be a slip.
    void warn() {
        for (const DryStart<D>& dry : dry_starts(scene_, *model_)) say_warning(text_of(dry, *model_));
        if constexpr (D == 2) {
            warn_of_staggering();
            if (!model_->walls) return;
            for (const std::string& corner : sharp_corners(model_->walls->panels)) say_warning(corner);
        }
    }
    void say_warning(const std::string& text) { err_ << "aquagraph: warning: " << text << "\n"; }

    // Bodies with many nodes are left to `check`: their modes take longer than a user should wait for a warning.
    void warn_of_staggering() requires(D == 2) {
        constexpr std::size_t most_nodes = 4000;
        if (!model_->interface || model_->solid->mesh().nodes.size() > most_nodes) return;
        const auto staggering = forecast_staggering(scene_, *model_);
        if (!staggering) return;
        const std::string warning = warning_of(*staggering, scene_);
        if (!warning.empty()) say_warning(warning);
    }

    // Before anything is measured that an uninterrupted run would not measure.
    void leave_checkpoint() {
        checkpoints_.write(figures());
        executor_.execute([&] { results_.measure(); });
    }

    // Of all parts of the run together.
    RunFigures figures() const {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
        return {before_.wall_seconds + seconds, executor_.threads(), together(before_.passes, graphs_.passes()),
                before_.restarts};
    }

    std::vector<io::Comparison> write_end(const RunEnd& end) {
        if (end.outcome != io::RunOutcome::finished) {
            results_.write_history_row();
            results_.write_frame();
        }
        std::vector<io::Comparison> comparisons = results_.finish(end);
        if (trace_) {
            trace_->write(options_.trace.string());
            if (trace_->dropped_count() > 0)
                err_ << fmt::format("aquagraph: the trace was full and lacks its last {} events; trace a shorter run\n",
                                    trace_->dropped_count());
        }
        return comparisons;
    }

    void print_end(const RunEnd& end, const std::vector<io::Comparison>& comparisons) {
        print_table(out_, end.figures);
        print_comparisons(out_, comparisons);
        if (trace_) print(summarise_trace(options_.trace), out_);
        out_ << fmt::format("{} in {:.2f} s on {}; results in {}, begin with report.html\n",
                            io::counted(model_->clock.steps, "step"), end.figures.wall_seconds,
                            io::counted(end.figures.threads, "thread"), folder_.string());
    }

    const io::Scene& scene_;
    const RunOptions& options_;
    std::ostream &out_, &err_;
    const std::filesystem::path folder_;
    tasks::Executor executor_;
    std::optional<tasks::Trace> trace_;
    std::optional<RestartPoint> from_;
    const std::unique_ptr<Model<D>> model_;
    Results<D> results_;
    Checkpoints<D> checkpoints_;
    CycleGraphs<D> graphs_;
    RunFigures before_;  // of the parts before this one
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace

ExitCode run(const io::Scene& scene, const RunOptions& options, std::ostream& out, std::ostream& err) {
    return scene.dimension == 3 ? Run<3>(scene, options, out, err).whole() : Run<2>(scene, options, out, err).whole();
}

}  // namespace aquagraph::engine
