// What the program says and writes besides results: to a file instead of a terminal, with --quiet, with --trace.
#include <doctest/doctest.h>

#include <set>

#include "tests/engine/body_scenes.hpp"
#include "tests/engine/model_run.hpp"
#include "tests/robustness/program.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

TEST_CASE("into a file the program writes few lines and never rewrites one") {
    const Call call({"run", "SCENE"}, gate);
    REQUIRE(call.code == 0);
    CHECK(call.err.empty());
    CHECK(count(call.out, "\r") == 0);
    CHECK(count(call.out, "\033") == 0);
    CHECK(count(call.out, "\n") < 40);
    CHECK(call.out.find("t = 0.02 s of 0.02 (100 %)") != std::string::npos);
    for (const char* pass : {"fluxes", "gradients", "FE Newton solve", "Mpairs/s/core"})
        CHECK(call.out.find(pass) != std::string::npos);
    // Without --out: results/<name of the scene>, in the folder where the program was started.
    std::size_t folders = 0;
    for (const auto& entry : std::filesystem::directory_iterator(call.folder / "results")) {
        CHECK(std::filesystem::exists(entry.path() / "report.html"));
        ++folders;
    }
    CHECK(folders == 1);
}

TEST_CASE("--quiet says nothing and leaves the same results") {
    const Call call({"run", "SCENE", "--out", "results", "--quiet"}, gate);
    CHECK(call.code == 0);
    CHECK(call.out.empty());
    CHECK(call.err.empty());
    CHECK(call.results().summary().at("outcome") == "finished");
}

TEST_CASE("--threads is the number of threads") {
    const Call call({"run", "SCENE", "--out", "results", "--threads", "3", "--quiet"}, gate);
    CHECK(call.code == 0);
    CHECK(call.results().summary().at("threads") == 3);
}

TEST_CASE("--trace writes when every task ran") {
    const std::string text = with(gate, "end = 0.02", "end = 0.002");
    const Call call({"run", "SCENE", "--out", "results", "--trace", "trace.json", "--quiet"}, text);
    REQUIRE(call.code == 0);
    const nlohmann::json trace = nlohmann::json::parse(contents(call.folder / "trace.json"));
    std::set<std::string> names;
    for (const auto& event : trace.at("traceEvents"))
        if (event.at("ph") == "X") {
            names.insert(event.at("name"));
            CHECK(event.at("dur").get<double>() >= 0);
            CHECK(event.contains("tid"));
        }
    for (const tasks::Task& task : Built(text).listing) {
        CAPTURE(task.name);
        CHECK(names.count(task.name) == 1);
    }
    for (const char* name : {"history", "frames"}) CHECK(names.count(name) == 1);
}

// Frames of the first run, finer in time, would stay beside those of the second.
TEST_CASE("a second run into the same folder leaves nothing of the first") {
    const ScratchFolder folder;
    folder.write("scene.toml", with(gate, "frame_interval = 0.005", "frame_interval = 0.001"));
    Program first(folder, {"run", "scene.toml", "--out", "results", "--quiet"});
    REQUIRE(first.wait() == 0);
    folder.write("scene.toml", gate);
    Program second(folder, {"run", "scene.toml", "--out", "results", "--quiet"});
    REQUIRE(second.wait() == 0);
    const ResultsFolder results{folder / "results"};
    CHECK(results.frames("fluid").size() == results.frames_on_disk("fluid"));
    CHECK(results.frames("solid").size() == results.frames_on_disk("solid"));
}

TEST_CASE("a scene with a solid alone runs, can be looked at beforehand and drawn") {
    const Call run({"run", "SCENE", "--out", "results", "--quiet"}, beam);
    CHECK(run.code == 0);
    CHECK(ResultsFolder{run.folder / "results"}.frames("solid").size() > 2);
    const Call check({"check", "SCENE"}, beam);
    CHECK(check.code == 0);
    CHECK(check.out.find("20 quadrilaterals of 8 nodes") != std::string::npos);
    CHECK(check.out.find("in 10 steps of 0.001 s") != std::string::npos);
    CHECK(check.left_nothing());
    const Call graph({"graph", "SCENE", "--out", "step.dot"}, beam);
    CHECK(graph.code == 0);
    CHECK(contents(graph.folder / "step.dot").find("FE Newton solve") != std::string::npos);
}

TEST_CASE("check says what a scene is and computes nothing") {
    const Call call({"check", "SCENE"}, gate);
    CHECK(call.code == 0);
    CHECK(call.out.find("560") != std::string::npos);
    CHECK(call.left_nothing());
}

TEST_CASE("graph draws the job graph") {
    const Call call({"graph", "SCENE", "--out", "cycle.dot"}, gate);
    CHECK(call.code == 0);
    const std::string dot = contents(call.folder / "cycle.dot");
    CHECK(dot.find("digraph") != std::string::npos);
    for (const tasks::Task& task : Built(gate).listing) {
        CAPTURE(task.name);
        CHECK(dot.find(task.name.substr(0, task.name.find(" ("))) != std::string::npos);
    }
}
