#include "engine/study_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/child_process.hpp"
#include "engine/study_checks.hpp"
#include "io/atomic_file.hpp"
#include "io/history.hpp"
#include "io/scene_json.hpp"
#include "io/scene_reader.hpp"
#include "io/scene_solid_files.hpp"

namespace aquagraph::engine {

namespace {

// FNV-1a, 64 bits: enough to tell a few hundred runs apart.
class Hash {
  public:
    void add(std::string_view text) {
        for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
        value_ = (value_ ^ 0x100U) * 1099511628211ULL;  // where one text ends and the next begins
    }
    std::string text() const { return fmt::format("{:016x}", value_); }

  private:
    std::uint64_t value_ = 14695981039346656037ULL;
};

std::string content_of(const io::Scene& scene, const std::string& program, int threads) {
    Hash hash;
    hash.add(program);
    hash.add(std::to_string(threads));
    hash.add(scene.text);
    hash.add(io::to_json(scene).dump());
    for (const io::Compare& compare : scene.comparisons)
        if (!compare.file.empty()) hash.add(io::read_file(compare.file));
    if (scene.solid)
        for (const auto& [key, file] : io::files_of(*scene.solid)) hash.add(io::read_file(file));
    return hash.text();
}

std::filesystem::path file_of(const std::filesystem::path& folder, const StudyRun& run, int repeat) {
    return folder / fmt::format("{}_{}.json", run.content, repeat);
}

// The number of evaluations of the rates is that of the flux passes.
long evaluations_of(const nlohmann::json& summary) {
    if (summary.contains("evaluations")) return summary["evaluations"].get<long>();
    const auto& tasks = summary.at("tasks");
    return tasks.contains("fluxes") ? tasks["fluxes"].at("calls").get<long>() : 0;
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

// What the child said, without the program's name.
std::string complaint(const std::filesystem::path& said) {
    std::string line;
    try {
        line = first_line(io::read_file(said));
    } catch (const std::exception&) {
    }
    constexpr std::string_view name = "aquagraph: ";
    return line.starts_with(name) ? line.substr(name.size()) : line;
}

// JSON has no NaN: null.
std::vector<double> numbers(const nlohmann::json& json) {
    std::vector<double> values;
    for (const auto& value : json) values.push_back(value.is_number() ? value.get<double>() : NAN);
    return values;
}

RunRecord record_of(const nlohmann::json& summary) {
    RunRecord record;
    for (const auto& [name, task] : summary.at("tasks").items()) {
        if (name == "FE Newton solve") {
            record.solves = task.at("calls").get<long>();
            record.solve_seconds = task.at("wall_seconds").get<double>();
        } else {
            record.other_seconds += task.at("thread_seconds").get<double>();
        }
    }
    record.wall_seconds = summary.at("wall_seconds").get<double>();
    record.steps = summary.at("steps").get<long>();
    record.particles = summary.value("particles", 0L) + summary.value("particles_removed", 0L);
    record.evaluations = evaluations_of(summary);
    record.nodes = summary.value("nodes", 0L);
    if (summary.contains("solid")) record.newton_iterations = summary["solid"].at("newton_iterations").get<long>();
    for (const auto& comparison : summary.at("comparisons")) {
        const auto& error = comparison.at("normalised_rms");
        record.errors.push_back({comparison.at("label").get<std::string>(), comparison.at("column").get<std::string>(),
                                 error.is_number() ? error.get<double>() : NAN});
    }
    return record;
}

}  // namespace

std::vector<StudyRun> runs_of(const io::Study& study, bool coarse, const std::vector<std::string>& only,
                              const std::filesystem::path& program, int threads) {
    const std::string code = io::read_file(program);
    Hash program_hash;
    program_hash.add(code);
    std::vector<StudyRun> runs;
    for (std::size_t c = 0; c < study.cases.size(); ++c) {
        const io::StudyCase& one = study.cases[c];
        const std::size_t levels =
            coarse ? std::min(one.resolutions.size(), std::size_t(one.coarse)) : one.resolutions.size();
        for (std::size_t level = 0; level < levels; ++level)
            for (const std::string& name : one.variants) {
                const std::string full = one.name + "/" + name;
                const auto variant = std::find_if(study.variants.begin(), study.variants.end(),
                                                  [&](const io::StudyVariant& known) { return known.name == name; });
                if (coarse && !variant->coarse) continue;
                if (!only.empty() && std::none_of(only.begin(), only.end(), [&](const std::string& part) {
                        return full.find(part) != std::string::npos;
                    }))
                    continue;
                StudyRun run;
                run.study_case = c;
                run.level = level;
                run.resolution = one.resolutions[level];
                run.variant = std::size_t(variant - study.variants.begin());
                run.overrides = one.set;
                run.overrides.insert(run.overrides.end(), variant->set.begin(), variant->set.end());
                run.overrides.push_back(fmt::format("{}={}", one.resolution_key, run.resolution));
                std::vector<std::string> keys;
                for (std::size_t k = 0; k < one.set.size(); ++k) keys.push_back(fmt::format("case[{}].set[{}]", c, k));
                keys.insert(keys.end(), variant->set_keys.begin(), variant->set_keys.end());
                keys.push_back(fmt::format("case[{}].resolutions[{}]", c, level));
                const io::Scene scene = scene_of_run(study, run, keys);
                // Frames are for looking at: the first and the last, so that time is that of computing.
                run.overrides.push_back(fmt::format("output.frame_interval={}", scene.end_time));
                run.parallel = scene.coupling.algorithm == io::CouplingAlgorithm::cps;
                run.ratio = scene.coupling.ratio;
                run.step_fraction = scene.coupling.step_fraction;
                run.content = content_of(scene, program_hash.text(), threads);
                check_drawn_error(study, run, scene);
                if (!one.curve.empty() && (runs.empty() || runs.back().study_case != c)) check_curve(study, run);
                runs.push_back(std::move(run));
            }
    }
    return runs;
}

std::optional<RunRecord> make_run(const io::Study& study, const StudyRun& run, const std::filesystem::path& program,
                                  int threads, const std::filesystem::path& folder, const std::function<bool()>& stop) {
    io::make_folder(folder);
    std::vector<std::string> arguments{"run", study.cases[run.study_case].scene.string(), "--quiet", "--out",
                                       folder.string()};
    for (const std::string& override : run.overrides) arguments.insert(arguments.end(), {"--set", override});
    if (threads > 0) arguments.insert(arguments.end(), {"--threads", std::to_string(threads)});
    std::filesystem::remove(folder / "summary.json");  // an earlier run's must not be taken for this one's
    const std::filesystem::path said = folder / "said.txt";
    const ChildEnd end = run_child(program, arguments, said, study.time_limit, stop);
    if (!end.timed_out && stop()) return std::nullopt;

    RunRecord record;
    std::string message;
    try {
        const auto summary = nlohmann::json::parse(io::read_file(folder / "summary.json"));
        message = first_line(summary.value("message", ""));
        record = record_of(summary);
    } catch (const std::exception&) {  // it did not get that far
    }
    record.cpu_seconds = end.cpu_seconds;
    if (const std::string& column = study.cases[run.study_case].curve; !column.empty()) try {
            const io::History history = io::read_history(folder / "history.csv");
            const auto time = history.time(), value = history.column(column);
            record.curve = {{time.begin(), time.end()}, {value.begin(), value.end()}};
        } catch (const std::exception& error) {
            if (record.failure.empty() && message.empty()) message = error.what();
        }
    if (end.timed_out)
        record.failure = fmt::format("stopped after {:g} s", study.time_limit);
    else if (end.signal != 0)
        record.failure = fmt::format("ended by signal {}", end.signal);
    else if (end.code != 0)
        record.failure = !message.empty() ? message : fmt::format("exit code {}: {}", end.code, complaint(said));
    return record;
}

std::optional<RunRecord> kept_run(const std::filesystem::path& folder, const StudyRun& run, int repeat) {
    const std::filesystem::path file = file_of(folder, run, repeat);
    if (!std::filesystem::exists(file)) return std::nullopt;
    try {
        const auto json = nlohmann::json::parse(io::read_file(file));
        RunRecord record{.failure = json.at("failure").get<std::string>(),
                         .wall_seconds = json.at("wall_seconds").get<double>(),
                         .cpu_seconds = json.at("cpu_seconds").get<double>(),
                         .particles = json.at("particles").get<long>(),
                         .steps = json.at("steps").get<long>(),
                         .evaluations = json.at("evaluations").get<long>(),
                         .nodes = json.at("nodes").get<long>(),
                         .newton_iterations = json.at("newton_iterations").get<long>(),
                         .errors = {},
                         .curve = {json.at("curve_time"), numbers(json.at("curve"))},
                         .solves = json.at("solves").get<long>(),
                         .solve_seconds = json.at("solve_seconds").get<double>(),
                         .other_seconds = json.at("other_seconds").get<double>()};
        for (const auto& error : json.at("errors"))
            record.errors.push_back({error.at("label").get<std::string>(), error.at("column").get<std::string>(),
                                     error.at("normalised").is_number() ? error.at("normalised").get<double>() : NAN});
        return record;
    } catch (const std::exception&) {  // of another version, or damaged: made again
        return std::nullopt;
    }
}

void keep_run(const std::filesystem::path& folder, const StudyRun& run, int repeat, const RunRecord& record) {
    io::make_folder(folder);
    nlohmann::json json = {{"set", run.overrides},
                           {"failure", record.failure},
                           {"wall_seconds", record.wall_seconds},
                           {"cpu_seconds", record.cpu_seconds},
                           {"particles", record.particles},
                           {"steps", record.steps},
                           {"evaluations", record.evaluations},
                           {"nodes", record.nodes},
                           {"newton_iterations", record.newton_iterations},
                           {"curve_time", record.curve.time},
                           {"curve", record.curve.value},
                           {"solves", record.solves},
                           {"solve_seconds", record.solve_seconds},
                           {"other_seconds", record.other_seconds},
                           {"errors", nlohmann::json::array()}};
    for (const RunError& error : record.errors)
        json["errors"].push_back({{"label", error.label}, {"column", error.column}, {"normalised", error.normalised}});
    io::write_file_atomically(file_of(folder, run, repeat),
                              json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace aquagraph::engine
