#include "engine/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <thread>

#include "engine/study_plots.hpp"
#include "engine/study_report.hpp"
#include "engine/study_runs.hpp"
#include "io/atomic_file.hpp"

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

// Runs everything `repeats` times in turn, or takes what is kept. Ends early where `stop` says so.
std::vector<StudyResult> make_runs(const io::Study& study, const std::vector<StudyRun>& runs,
                                   const StudyOptions& options, const std::filesystem::path& program,
                                   const std::filesystem::path& folder, const std::function<bool()>& stop,
                                   std::ostream& err) {
    const int repeats = options.repeats > 0 ? options.repeats : study.repeats;
    std::vector<StudyResult> results;
    for (const StudyRun& run : runs) results.push_back({run, {}});
    std::size_t number = 0;
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
            err << fmt::format("[{}/{}] {}{}: {}\n", ++number, runs.size() * std::size_t(repeats), name_of(study, run),
                               kept ? " (kept)" : "", in_short(*record))
                << std::flush;
            result.repeats.push_back(*std::move(record));
        }
    return results;
}

// Where a study's sections go.
struct Places {
    std::filesystem::path file;  // with all cases; empty: standard output
    std::string name;            // of its section
    struct Readme {
        std::size_t study_case;
        std::filesystem::path file;
        std::string name;
    };
    std::vector<Readme> readmes;  // those that have markers for their case
};

// Throws std::runtime_error where a file has one marker of two: before hours of computing, not after them.
Places places_of(const io::Study& study, const StudyOptions& options) {
    const bool part = options.coarse || !options.only.empty();
    const std::filesystem::path beside = study.file.parent_path() / "RESULTS.md";
    Places places{
        options.out.empty() && !part ? beside : options.out, study.name + (options.coarse ? "-coarse" : ""), {}};
    if (places.file.empty()) return places;
    has_section(places.file, places.name);
    // READMEs refer to the results beside the study, and to all of them.
    if (part || std::filesystem::weakly_canonical(places.file) != std::filesystem::weakly_canonical(beside))
        return places;
    for (std::size_t c = 0; c < study.cases.size(); ++c) {
        const std::filesystem::path readme = study.cases[c].scene.parent_path() / "README.md";
        const std::string name = study.name + "/" + study.cases[c].name;
        if (has_section(readme, name)) places.readmes.push_back({c, readme, name});
    }
    return places;
}

void write_sections(const io::Study& study, const std::vector<StudyResult>& results, const Places& places, int threads,
                    bool coarse, std::ostream& out, std::ostream& err) {
    if (places.file.empty()) {
        out << study_markdown(study, results, {}, threads, coarse);
        return;
    }
    const std::filesystem::path folder = std::filesystem::absolute(places.file).parent_path();
    bool drawn = false;
    const auto links = [&](const std::vector<std::filesystem::path>& files) {
        std::vector<std::string> texts;
        for (const std::filesystem::path& plot : files) {
            texts.push_back(plot.empty() ? "" : "plots/" + plot.filename().string());
            drawn = drawn || !plot.empty();
        }
        return texts;
    };
    const StudyPlots plots{links(draw_plots(study, results, folder / "plots", coarse)),
                           links(draw_speedups(study, results, folder / "plots", threads, coarse))};
    if (!drawn)
        err << "aquagraph: no plots: gnuplot (Debian: gnuplot-nox) is not there, or no run has an error to draw\n";
    put_section(places.file, places.name, study_markdown(study, results, plots, threads, coarse));
    out << fmt::format("the section \"{}\" of {} is written\n", places.name, places.file.string());
    for (const auto& [study_case, readme, name] : places.readmes) {
        const std::filesystem::path everything =
            std::filesystem::proximate(std::filesystem::absolute(places.file), readme.parent_path());
        put_section(readme, name, case_markdown(study, study_case, results, threads, everything.string()));
        out << fmt::format("the section \"{}\" of {} is written\n", name, readme.string());
    }
}

std::size_t failures(const std::vector<StudyResult>& results) {
    std::size_t failed = 0;
    for (const StudyResult& result : results)
        failed += std::size_t(std::count_if(result.repeats.begin(), result.repeats.end(),
                                            [](const RunRecord& record) { return !record.failure.empty(); }));
    return failed;
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
    const Places places = places_of(study, options);
    if (!places.file.empty()) io::check_writable(places.file);

    const StopGuard guard;
    const auto stop = [] { return stop_requested != 0; };
    const std::vector<StudyResult> results = make_runs(study, runs, options, program, folder, stop, err);
    if (stop()) {
        err << fmt::format("aquagraph: interrupted; the finished runs are kept in {}, start again to go on\n",
                           (folder / "kept").string());
        return interrupted;
    }

    const int threads = options.threads > 0 ? options.threads : int(std::thread::hardware_concurrency());
    write_sections(study, results, places, threads, options.coarse, out, err);
    if (const std::size_t failed = failures(results); failed > 0)
        err << fmt::format("aquagraph: {} runs have failed; the tables say which and why\n", failed);
    return success;
}

}  // namespace aquagraph::engine
