// The command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "engine/calculix_command.hpp"
#include "engine/check.hpp"
#include "engine/graph_command.hpp"
#include "engine/modes_command.hpp"
#include "engine/run.hpp"
#include "engine/study.hpp"
#include "engine/trace_summary.hpp"
#include "engine/version.hpp"
#include "io/scene_reader.hpp"
#include "io/suggestion.hpp"

namespace {

using namespace aquagraph;
using std::filesystem::path;

// A command and what it does once its options have been read into what it holds.
using Command = std::pair<CLI::App*, std::function<engine::ExitCode()>>;

// The scene that a command is about.
class SceneOptions {
  public:
    explicit SceneOptions(CLI::App& command) {
        command.add_option("scene", values_->file, "Scene file (TOML)")->required();
        command
            .add_option("--set", values_->overrides,
                        "KEY=VALUE in place of the scene's, such as fluid.spacing=0.01; may be repeated")
            ->take_all()
            ->allow_extra_args(false);
    }
    io::Scene read() const { return io::read_scene(values_->file, values_->overrides); }

  private:
    struct Values {
        path file;
        std::vector<std::string> overrides;
    };
    std::shared_ptr<Values> values_ = std::make_shared<Values>();
};

void add_threads(CLI::App& command, int& threads, const std::string& what = "Threads") {
    command.add_option("--threads", threads, what + " (default: all cores)")->check(CLI::Range(1, 1024));
}

Command run(CLI::App& app) {
    auto& command = *app.add_subcommand("run", "Compute a scene");
    const SceneOptions scene(command);
    const auto options = std::make_shared<engine::RunOptions>();
    command.add_option("--out", options->folder, "Folder of results (default: results/<scene name>)");
    add_threads(command, options->threads);
    command.add_option("--trace", options->trace, "Write when every task ran on which thread (Chrome trace JSON)");
    command.add_option("--restart", options->restart,
                       "Go on from this checkpoint; \"auto\": from the newest good one in the folder of results");
    command
        .add_option("--checkpoint-every", options->checkpoint_every,
                    "Minutes of wall-clock time between checkpoints (default: the scene's; 0: only when asked to stop)")
        ->check(CLI::Range(0.0, 1e6));
    command.add_flag("--quiet", options->quiet, "No progress, no table");
    return {&command, [=] { return engine::run(scene.read(), *options, std::cout, std::cerr); }};
}

Command check(CLI::App& app) {
    auto& command = *app.add_subcommand("check", "Say what a scene models and what it will cost, without running it");
    const SceneOptions scene(command);
    const auto threads = std::make_shared<int>(0);
    add_threads(command, *threads, "Threads to estimate for");
    return {&command, [=] {
                engine::check(scene.read(), *threads, std::cout);
                return engine::success;
            }};
}

Command graph(CLI::App& app) {
    auto& command = *app.add_subcommand("graph", "Draw the job graph of a scene (DOT, and SVG if Graphviz is there)");
    const SceneOptions options(command);
    const auto drawing = std::make_shared<path>();
    command.add_option("--out", *drawing, "File for the DOT text (default: <scene name>.dot)");
    return {&command, [=] {
                const io::Scene scene = options.read();
                engine::draw_graph(scene, drawing->empty() ? path(scene.name + ".dot") : *drawing, std::cout);
                return engine::success;
            }};
}

Command modes(CLI::App& app) {
    auto& command = *app.add_subcommand("modes", "Natural frequencies and shapes of a scene's body, without water");
    const SceneOptions scene(command);
    const auto options = std::make_shared<engine::ModesOptions>();
    command.add_option("--count", options->count, "How many, from the lowest (default: 6)")
        ->check(CLI::Range(1, 100000));
    command.add_option("--out", options->folder, "Folder of results (default: results/<scene name>)");
    add_threads(command, options->threads);
    return {&command, [=] { return engine::modes(scene.read(), *options, std::cout, std::cerr); }};
}

Command export_ccx(CLI::App& app) {
    auto& command = *app.add_subcommand("export-ccx", "Write a scene's body as an input deck of CalculiX");
    const SceneOptions options(command);
    const auto deck = std::make_shared<path>(), loads = std::make_shared<path>();
    command.add_option("--out", *deck, "File (default: <scene name>.inp)");
    command.add_option("--loads", *loads,
                       "history.csv of a run with [output] interface_loads = true: the water's loads once more");
    return {&command, [=] {
                const io::Scene scene = options.read();
                engine::export_calculix(scene, deck->empty() ? path(scene.name + ".inp") : *deck, *loads, std::cout);
                return engine::success;
            }};
}

Command trace_summary(CLI::App& app) {
    auto& command = *app.add_subcommand("trace-summary", "Say how well fluid and solid overlap in a trace of a run");
    const auto file = std::make_shared<path>();
    command.add_option("trace", *file, "File that run --trace has written")->required();
    return {&command, [=] {
                engine::print(engine::summarise_trace(*file), std::cout);
                return engine::success;
            }};
}

Command study(CLI::App& app) {
    auto& command =
        *app.add_subcommand("study", "Run a matrix of scenes, resolutions and variants: what an error costs");
    const auto file = std::make_shared<path>();
    const auto options = std::make_shared<engine::StudyOptions>();
    command.add_option("study", *file, "Study file (TOML)")->required();
    command.add_option("--only", options->only, "Runs with this in CASE/VARIANT; may be repeated")
        ->take_all()
        ->allow_extra_args(false);
    command.add_flag("--coarse", options->coarse, "The coarse resolutions only");
    command.add_flag("--list", options->list, "Say what would be run, and run nothing");
    command.add_flag("--fresh", options->fresh, "Run again what an earlier start has finished");
    command.add_option("--repeats", options->repeats, "Runs of everything (default: the study's)")
        ->check(CLI::Range(1, 100));
    command.add_option("--out", options->out,
                       "File for the tables (default: RESULTS.md beside the study; with --only and --coarse they are "
                       "printed)");
    command.add_option("--results", options->folder, "Folder of the runs (default: results/study_<name>)");
    add_threads(command, options->threads);
    return {&command, [=] { return engine::study(io::read_study(*file), *options, std::cout, std::cerr); }};
}

// What is wrong with the word where a command belongs; empty: nothing.
std::string wrong_command(const std::vector<Command>& commands, int argc, char** argv) {
    const std::string word = argc > 1 ? argv[1] : "";
    std::vector<std::string> known;
    for (const auto& [command, action] : commands) known.push_back(command->get_name());
    if (word.starts_with('-') || std::find(known.begin(), known.end(), word) != known.end()) return {};
    const std::string all = fmt::format("{}; --help says what they do", fmt::join(known, ", "));
    if (word.empty()) return "give a command: " + all;
    const auto guess = io::nearest(word, known);
    return fmt::format("there is no command \"{}\": {}", word,
                       guess ? fmt::format("did you mean \"{}\"?", *guess) : "there are " + all);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Smoothed Particle Hydrodynamics and Finite Elements, coupled as a graph of tasks", "aquagraph");
    app.set_version_flag("--version", std::string("aquagraph ") + engine::version);
    app.require_subcommand(1);
    std::vector<Command> commands;
    for (const auto& add : {run, check, graph, modes, export_ccx, trace_summary, study}) commands.push_back(add(app));
    if (const std::string wrong = wrong_command(commands, argc, argv); !wrong.empty()) {
        std::cerr << "aquagraph: " << wrong << "\n";
        return engine::bad_input;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? engine::success : engine::bad_input;
    }
    try {
        for (const auto& [command, action] : commands)
            if (command->parsed()) return action();
    } catch (const io::SceneError& error) {  // begins with its place
        std::cerr << error.what() << "\n";
    } catch (const std::bad_alloc&) {
        std::cerr
            << "aquagraph: the memory of this machine is too small for this scene: take a larger spacing, or fewer "
               "elements\n";
    } catch (const std::exception& error) {
        std::cerr << "aquagraph: " << error.what() << "\n";
    }
    return engine::bad_input;
}
