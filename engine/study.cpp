#include "engine/study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <ostream>
#include <stdexcept>
#include <thread>

#include "engine/study_report.hpp"
#include "engine/study_runs.hpp"

namespace aquagraph::engine {

namespace {

volatile std::sig_atomic_t stop_requested = 0;

// The first Ctrl-C ends the present run and the study in good order, the second at once.
class StopGuard {
  public:
    StopGuard() {
        stop_requested = 0;
        for (const int signal : {SIGINT, SIGTERM})
            std::signal(signal, [](int number) {
                stop_requested = 1;
                std::signal(number, SIG_DFL);
            });
    }
    ~StopGuard() {
        for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
    }
    StopGuard(const StopGuard&) = delete;
    StopGuard& operator=(const StopGuard&) = delete;
};

std::string name_of(const io::Study& study, const StudyRun& run) {
    const io::StudyCase& one = study.cases[run.study_case];
    return fmt::format("{}/{} at {} = {:g}", one.name, study.variants[run.variant].name, one.resolution_key,
                       run.resolution);
}

void list_runs(const io::Study& study, const std::vector<StudyRun>& runs, std::ostream& out) {
    for (const StudyRun& run : runs) out << fmt::format("{}: {}\n", name_of(study, run), fmt::join(run.overrides, " "));
}

std::string in_short(const RunRecord& record) {
    if (!record.failure.empty()) return "failed: " + record.failure;
    std::string text = fmt::format("{:.1f} s", record.wall_seconds);
    for (const RunError& error : record.errors)
        text += std::isfinite(error.normalised) ? fmt::format(", {} {:.3g} %", error.label, 100 * error.normalised)
                                                : fmt::format(", {}: outside the run", error.label);
    return text;
}

}  // namespace

ExitCode study(const io::Study& study, const StudyOptions& options, std::ostream& out, std::ostream& err) {
    const std::filesystem::path program =
        options.program.empty() ? std::filesystem::read_symlink("/proc/self/exe") : options.program;
    const std::filesystem::path folder =
        options.folder.empty() ? std::filesystem::path("results") / ("study_" + study.name) : options.folder;
    const std::vector<StudyRun> runs = runs_of(study, options.coarse, options.only, program, options.threads);
    if (runs.empty())
        throw std::invalid_argument("no run has any of what --only says in its name: see --list without --only");
    if (options.list) {
        list_runs(study, runs, out);
        return success;
    }

    const StopGuard guard;
    const auto stop = [] { return stop_requested != 0; };
    const int repeats = options.repeats > 0 ? options.repeats : study.repeats;
    std::vector<StudyResult> results;
    for (const StudyRun& run : runs) results.push_back({run, {}});
    std::size_t number = 0, failed = 0;
    for (int repeat = 0; repeat < repeats && !stop(); ++repeat)
        for (StudyResult& result : results) {
            const StudyRun& run = result.run;
            std::optional<RunRecord> record;
            if (!options.fresh) record = kept_run(folder / "kept", run, repeat);
            const bool kept = record.has_value();
            if (!kept) {
                const std::filesystem::path place =
                    folder / study.cases[run.study_case].name /
                    fmt::format("{}_{:g}", study.variants[run.variant].name, run.resolution);
                record = make_run(study, run, program, options.threads, place, stop);
                if (!record) break;
                // A run that could not even begin may have met a passing trouble.
                if (record->failure.empty() || record->steps > 0) keep_run(folder / "kept", run, repeat, *record);
            }
            failed += !record->failure.empty();
            err << fmt::format("[{}/{}] {}{}: {}\n", ++number, runs.size() * std::size_t(repeats), name_of(study, run),
                               kept ? " (kept)" : "", in_short(*record))
                << std::flush;
            result.repeats.push_back(*std::move(record));
        }
    if (stop()) {
        err << fmt::format("aquagraph: interrupted; the finished runs are kept in {}, start again to go on\n",
                           (folder / "kept").string());
        return interrupted;
    }

    const int threads = options.threads > 0 ? options.threads : int(std::thread::hardware_concurrency());
    const bool part = options.coarse || !options.only.empty();
    const std::filesystem::path file =
        options.out.empty() && !part ? study.file.parent_path() / "RESULTS.md" : options.out;
    const std::string name = study.name + (options.coarse ? "-coarse" : "");
    if (file.empty()) {
        out << study_markdown(study, results, {}, threads, options.coarse);
    } else {
        const std::filesystem::path beside = std::filesystem::absolute(file).parent_path() / "plots";
        std::vector<std::string> plots;
        bool drawn = false;
        for (const std::filesystem::path& plot : draw_plots(study, results, beside)) {
            plots.push_back(plot.empty() ? "" : "plots/" + plot.filename().string());
            drawn = drawn || !plot.empty();
        }
        if (!drawn)
            err << "aquagraph: no plots: gnuplot (Debian: gnuplot-nox) is not there, or no run has an error to draw\n";
        put_section(file, name, study_markdown(study, results, plots, threads, options.coarse));
        out << fmt::format("the section \"{}\" of {} is written\n", name, file.string());
    }
    if (failed > 0) err << fmt::format("aquagraph: {} runs have failed; the tables say which and why\n", failed);
    return success;
}

}  // namespace aquagraph::engine
