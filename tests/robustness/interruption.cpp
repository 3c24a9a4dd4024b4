// Ctrl-C and SIGTERM end a run in good order: what was computed is kept and can be read.
#include <doctest/doctest.h>

#include <csignal>

#include "tests/graph/waiting.hpp"
#include "tests/robustness/program.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

TEST_CASE("an interrupted run keeps what it has computed") {
    const std::string endless =
        with(with(gate, "end = 0.02", "end = 1000.0"), "frame_interval = 0.005", "frame_interval = 0.002");
    for (const int signal : {SIGINT, SIGTERM}) {
        CAPTURE(signal);
        const ScratchFolder folder;
        folder.write("scene.toml", endless);
        Program program(folder, {"run", "scene.toml", "--out", "results"});
        const ResultsFolder results{folder / "results"};
        REQUIRE(tests::comes_true([&] { return std::filesystem::exists(results.path / "solid_000003.hdf"); }));
        program.send(signal);
        REQUIRE(program.wait(std::chrono::seconds(20)) == 130);

        const nlohmann::json summary = results.summary();
        CHECK(summary.at("outcome") == "interrupted");
        const double reached = summary.at("time_s");
        CHECK(reached > 0.004);
        CHECK(reached < 1000);
        CHECK(results.column("time").back() == reached);
        for (const char* stem : {"fluid", "solid"}) {
            const auto frames = results.frames(stem);
            CHECK(frames.size() >= 4);
            CHECK(frames.back().time == reached);
            CHECK(frames.size() == results.frames_on_disk(stem));
            for (const FrameOnDisk& frame : frames) CHECK_NOTHROW(results.open(frame));
        }
        CHECK(results.report().find("interrupted") != std::string::npos);
        CHECK(program.err().find("interrupted at t = ") != std::string::npos);
        CHECK(program.err().find("results") != std::string::npos);
    }
}
