// Runs that cannot go on: exit code 3, a diagnosis that helps, and everything computed until then kept.
#include <doctest/doctest.h>

#include <cmath>
#include <regex>

#include "tests/robustness/program.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

const std::vector<std::string> run{"run", "SCENE", "--out", "results"};

// History, frames, summary and report of a failed run are whole and say what happened.
nlohmann::json check_kept(const Call& call) {
    REQUIRE(call.code == 3);
    const ResultsFolder results = call.results();
    const nlohmann::json summary = results.summary();
    CHECK(summary.at("outcome") == "failed");
    const std::string message = summary.at("message");
    CHECK(call.err.find(message.substr(0, message.find('\n'))) != std::string::npos);
    CHECK(call.err.find("results") != std::string::npos);  // where what was computed is
    const io::History history = results.history();
    REQUIRE(history.rows() >= 1);
    CHECK(history.time().back() == summary.at("time_s"));
    CHECK(results.report().find("<html") != std::string::npos);
    return summary;
}

// The last frame shows the moment of the failure.
void check_last_frame(const Call& call, const nlohmann::json& summary) {
    const auto frames = call.results().frames("fluid");
    REQUIRE(frames.size() >= 2);
    CHECK(frames.back().time == summary.at("time_s"));
    for (const FrameOnDisk& frame : frames) CHECK_NOTHROW(call.results().open(frame));
}

// Time, ids, positions, neighbours and the likely cause.
std::int64_t check_diagnosis(const std::string& err) {
    CHECK(err.find("t = ") != std::string::npos);
    CHECK(err.find("neighbours within R") != std::string::npos);
    CHECK(err.find("likely cause: ") != std::string::npos);
    const std::regex particle("particle +([0-9]+)  x \\(");
    std::smatch match;
    REQUIRE(std::regex_search(err, match, particle));
    return std::stoll(match[1]);
}

}  // namespace

TEST_CASE("a particle that leaves a closed domain stops the run") {
    // A tank without its floor.
    const Call call(run, with(with(column, "points = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]",
                                   "points = [[0.0, 1.0], [0.0, 0.0]]"),
                              "end = 0.1", "end = 1.0"));
    const nlohmann::json summary = check_kept(call);
    check_last_frame(call, summary);
    const std::int64_t id = check_diagnosis(call.err);
    CHECK(call.err.find("left the closed domain") != std::string::npos);
    CHECK(call.err.find("hole") != std::string::npos);
    // It fell 0.1 m below the floor that is not there: 0.14 s and a little less with the water on top of it.
    CHECK(summary.at("time_s").get<double>() < 0.15);
    CHECK(summary.at("time_s").get<double>() > 0.02);

    const auto frame = call.results().open(call.results().frames("fluid").back());
    const auto ids = frame.read<std::int64_t>("VTKHDF/PointData/id");
    const auto at = std::find(ids.begin(), ids.end(), id);
    REQUIRE(at != ids.end());
    const auto y = frame.read<float>("VTKHDF/Points")[3 * std::size_t(at - ids.begin()) + 1];
    CHECK(y < -0.1);
}

TEST_CASE("an open domain takes the same particles out and counts them") {
    const Call call(run, with(with(column, "points = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]",
                                   "points = [[0.0, 1.0], [0.0, 0.0]]"),
                              "max = [1.1, 1.1]", "max = [1.1, 1.1]\nedge = \"open\""));
    CHECK(call.code == 0);
    const nlohmann::json summary = call.results().summary();
    CHECK(summary.at("outcome") == "finished");
}

TEST_CASE("a sound speed far below the flow's stops the run with the advice to raise it") {
    // The column falls at up to 3 m/s; the water behaves like a light gas.
    const Call call(run, with(with(with(column, "sound_speed = 40.0", "sound_speed = 0.5"), "end = 0.1", "end = 2.0"),
                              "history_interval = 0.01", "history_interval = 0.1"));
    const nlohmann::json summary = check_kept(call);
    check_last_frame(call, summary);
    check_diagnosis(call.err);
    CHECK(call.err.find("sound_speed") != std::string::npos);
}

TEST_CASE("a solid that cannot carry its load stops the run") {
    // Rubber a million times too soft: in equilibrium it would be torn to pieces.
    const Call at_start(run, with(plate, "youngs_modulus = 67.5e9", "youngs_modulus = 10.0"));
    const nlohmann::json summary = check_kept(at_start);
    CHECK(summary.at("time_s") == 0);
    CHECK(at_start.results().frames("solid").size() == 1);

    const Call under_way(run, with(gate, "youngs_modulus = 8.0e6", "youngs_modulus = 1.0"));
    check_kept(under_way);
    CHECK(under_way.err.find("FE Newton solve") != std::string::npos);
}
