// The command line.
#include <CLI/CLI.hpp>
#include <iostream>

#include "engine/calculix_command.hpp"
#include "engine/check.hpp"
#include "engine/graph_command.hpp"
#include "engine/modes_command.hpp"
#include "engine/run.hpp"
#include "engine/study.hpp"
#include "engine/trace_summary.hpp"
#include "engine/version.hpp"
#include "io/scene_reader.hpp"

int main(int argc, char** argv) {
    using namespace aquagraph;
    CLI::App app("Smoothed Particle Hydrodynamics and Finite Elements, coupled as a graph of tasks");
    app.set_version_flag("--version", std::string("aquagraph ") + engine::version);
    app.require_subcommand(1);

    std::filesystem::path scene_file;
    std::vector<std::string> overrides;
    const std::string set_help = "KEY=VALUE in place of the scene's, such as fluid.spacing=0.01; may be repeated";
    engine::RunOptions options;
    auto* run = app.add_subcommand("run", "Compute a scene");
    run->add_option("scene", scene_file, "Scene file (TOML)")->required();
    run->add_option("--set", overrides, set_help)->take_all()->allow_extra_args(false);
    run->add_option("--out", options.folder, "Folder of results (default: results/<scene name>)");
    run->add_option("--threads", options.threads, "Threads (default: all cores)")->check(CLI::Range(1, 1024));
    run->add_option("--trace", options.trace, "Write when every task ran on which thread (Chrome trace JSON)");
    run->add_option("--restart", options.restart,
                    "Go on from this checkpoint; \"auto\": from the newest good one in the folder of results");
    run->add_option("--checkpoint-every", options.checkpoint_every,
                    "Minutes of wall-clock time between checkpoints (default: the scene's; 0: only when asked to stop)")
        ->check(CLI::NonNegativeNumber);
    run->add_flag("--quiet", options.quiet, "No progress, no table");

    int check_threads = 0;
    auto* check = app.add_subcommand("check", "Say what a scene models and what it will cost, without running it");
    check->add_option("scene", scene_file, "Scene file (TOML)")->required();
    check->add_option("--set", overrides, set_help)->take_all()->allow_extra_args(false);
    check->add_option("--threads", check_threads, "Threads to estimate for (default: all cores)")
        ->check(CLI::Range(1, 1024));

    std::filesystem::path drawing;
    auto* graph = app.add_subcommand("graph", "Draw the job graph of a scene (DOT, and SVG if Graphviz is there)");
    graph->add_option("scene", scene_file, "Scene file (TOML)")->required();
    graph->add_option("--out", drawing, "File for the DOT text (default: <scene name>.dot)");

    engine::ModesOptions modes_options;
    auto* modes = app.add_subcommand("modes", "Natural frequencies and shapes of a scene's body, without water");
    modes->add_option("scene", scene_file, "Scene file (TOML)")->required();
    modes->add_option("--set", overrides, set_help)->take_all()->allow_extra_args(false);
    modes->add_option("--count", modes_options.count, "How many, from the lowest (default: 6)")
        ->check(CLI::Range(1, 100000));
    modes->add_option("--out", modes_options.folder, "Folder of results (default: results/<scene name>)");
    modes->add_option("--threads", modes_options.threads, "Threads (default: all cores)")->check(CLI::Range(1, 1024));

    std::filesystem::path deck_file, loads_file;
    auto* deck = app.add_subcommand("export-ccx", "Write a scene's body as an input deck of CalculiX");
    deck->add_option("scene", scene_file, "Scene file (TOML)")->required();
    deck->add_option("--set", overrides, set_help)->take_all()->allow_extra_args(false);
    deck->add_option("--out", deck_file, "File (default: <scene name>.inp)");
    deck->add_option("--loads", loads_file,
                     "history.csv of a run with [output] interface_loads = true: the water's loads once more");

    std::filesystem::path trace_file;
    auto* trace = app.add_subcommand("trace-summary", "Say how well fluid and solid overlap in a trace of a run");
    trace->add_option("trace", trace_file, "File that run --trace has written")->required();

    std::filesystem::path study_file;
    engine::StudyOptions study_options;
    auto* study = app.add_subcommand("study", "Run a matrix of scenes, resolutions and variants: what an error costs");
    study->add_option("study", study_file, "Study file (TOML)")->required();
    study->add_option("--only", study_options.only, "Runs with this in CASE/VARIANT; may be repeated")
        ->take_all()
        ->allow_extra_args(false);
    study->add_flag("--coarse", study_options.coarse, "The coarse resolutions only");
    study->add_flag("--list", study_options.list, "Say what would be run");
    study->add_flag("--fresh", study_options.fresh, "Run again what an earlier start has finished");
    study->add_option("--repeats", study_options.repeats, "Runs of everything (default: the study's)")
        ->check(CLI::Range(1, 100));
    study->add_option("--out", study_options.out,
                      "File for the tables (default: RESULTS.md beside the study; with --only and --coarse they are "
                      "printed)");
    study->add_option("--results", study_options.folder, "Folder of the runs (default: results/study_<name>)");
    study->add_option("--threads", study_options.threads, "Threads (default: all cores)")->check(CLI::Range(1, 1024));

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? engine::success : engine::bad_input;
    }
    try {
        if (trace->parsed()) {
            engine::print(engine::summarise_trace(trace_file), std::cout);
            return engine::success;
        }
        if (study->parsed()) return engine::study(io::read_study(study_file), study_options, std::cout, std::cerr);
        const io::Scene scene = io::read_scene(scene_file, overrides);
        if (check->parsed()) {
            engine::check(scene, check_threads, std::cout);
            return engine::success;
        }
        if (modes->parsed()) return engine::modes(scene, modes_options, std::cout, std::cerr);
        if (deck->parsed()) {
            engine::export_calculix(scene, deck_file.empty() ? std::filesystem::path(scene.name + ".inp") : deck_file,
                                    loads_file, std::cout);
            return engine::success;
        }
        if (graph->parsed()) {
            engine::draw_graph(scene, drawing.empty() ? std::filesystem::path(scene.name + ".dot") : drawing,
                               std::cout);
            return engine::success;
        }
        return engine::run(scene, options, std::cout, std::cerr);
    } catch (const io::SceneError& error) {
        std::cerr << error.what() << "\n";
        return engine::bad_input;
    } catch (const std::exception& error) {
        std::cerr << "aquagraph: " << error.what() << "\n";
        return engine::bad_input;
    }
}
