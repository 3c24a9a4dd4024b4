// Bad input ends at once with exit code 2 and a message; nothing is computed, nothing is left behind.
#include <doctest/doctest.h>

#include "tests/robustness/program.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

const std::vector<std::string> run{"run", "SCENE", "--out", "results"};

void check_refused(const Call& call) {
    CHECK(call.code == 2);
    CHECK(call.left_nothing());
    CHECK_FALSE(call.err.empty());
    CHECK(call.err.find("terminate") == std::string::npos);
}

// The line on which `text` begins.
int line_of(const std::string& scene, const std::string& text) {
    return int(count(scene.substr(0, scene.find(text)), "\n")) + 1;
}

}  // namespace

TEST_CASE("a mistake in the scene is named with file, line and column") {
    struct Mistake {
        std::string from, to, says;
    };
    for (const Mistake& mistake :
         {Mistake{"spacing = 0.005", "spacing = -0.005", "spacing"}, Mistake{"spacing", "spacng", "did you mean"},
          Mistake{"ratio = 1", "ratio = 0", "ratio"}, Mistake{"ratio = 1", "ratio = \"one\"", "number"}}) {
        CAPTURE(mistake.to);
        const std::string scene = with(gate, mistake.from, mistake.to);
        const Call call(run, scene);
        check_refused(call);
        CHECK(call.err.find("scene.toml:" + std::to_string(line_of(gate, mistake.from)) + ":") != std::string::npos);
        CHECK(call.err.find(mistake.says) != std::string::npos);
        CHECK(call.out.empty());
    }
}

TEST_CASE("what only shows with the mesh at hand is refused as well") {
    for (const auto& [from, to, says] :
         {std::tuple{"set = \"top\"", "set = \"front\"", "front"},
          std::tuple{"wet = [\"left\", \"bottom\", \"right\"]", "wet = [\"left\", \"outside\"]", "outside"},
          std::tuple{"max = [0.1, 0.14]", "max = [0.12, 0.14]", "solid"},
          std::tuple{"name = \"gate\"\nwet", "name = \"gate\"\nmesh = \"none.msh\"\nwet", "mesh"}}) {
        CAPTURE(to);
        const Call call(run, with(gate, from, to));
        check_refused(call);
        CHECK(call.err.find("scene.toml:") != std::string::npos);
        CHECK(call.err.find(says) != std::string::npos);
    }
}

TEST_CASE("a comparison with a column that will not be there is refused before the run") {
    const ScratchFolder references;
    const std::string file = references.write("curve.csv", "0,0\n1,1\n").string();
    const std::string scene = gate + "[[compare]]\ncolumn = \"tipp_x\"\nfile = \"" + file + "\"\nlabel = \"x\"\n";
    for (const std::vector<std::string>& command : {run, {"check", "SCENE"}}) {
        const Call call(command, scene);
        check_refused(call);
        CHECK(call.err.find("did you mean \"tip_x\"") != std::string::npos);
    }
}

TEST_CASE("a missing scene is named") {
    const Call call({"run", "nowhere.toml"});
    check_refused(call);
    CHECK(call.err.find("nowhere.toml") != std::string::npos);
}

TEST_CASE("a command line that makes no sense is refused") {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                      {"swim"},
                                                      {"run"},
                                                      {"run", "SCENE", "--fast"},
                                                      {"run", "SCENE", "--threads", "0"},
                                                      {"run", "SCENE", "--threads", "many"},
                                                      {"check"},
                                                      {"graph"}}) {
        INFO(arguments.size(), " arguments, last ", arguments.empty() ? "" : arguments.back());
        const Call call(arguments, column);
        CHECK(call.code == 2);
        CHECK(call.left_nothing());
        CHECK_FALSE(call.err.empty());
    }
}

TEST_CASE("a command that is not there is named, with the one that may be meant") {
    CHECK(Call({"rnu", "SCENE"}, column).err == "aquagraph: there is no command \"rnu\": did you mean \"run\"?\n");
    const Call swim({"swim"}), none({});
    CHECK(swim.err.starts_with("aquagraph: there is no command \"swim\": there are run, check, "));
    CHECK(none.err.starts_with("aquagraph: give a command: run, check, "));
}

TEST_CASE("help and version are no errors") {
    const Call help({"run", "--help"}), version({"--version"});
    CHECK(help.code == 0);
    for (const char* option : {"--out", "--threads", "--trace", "--quiet"})
        CHECK(help.out.find(option) != std::string::npos);
    CHECK(version.code == 0);
    CHECK(version.out.starts_with("aquagraph "));
}

TEST_CASE("a folder that cannot be written is found out before anything is computed") {
    // Below a file there can be no folder, whoever asks. The run would take hours.
    const std::string hours = with(with(column, "spacing = 0.02", "spacing = 0.002"), "end = 0.1", "end = 100.0");
    const Call call({"run", "SCENE", "--out", "FOLDER/scene.toml/results"}, hours);
    check_refused(call);
    CHECK(call.err.find("scene.toml/results cannot be made: Not a directory") != std::string::npos);
    CHECK(count(call.err, "\n") == 1);
}

TEST_CASE("a trace that cannot be written is found out before anything is computed") {
    const std::string hours = with(with(column, "spacing = 0.02", "spacing = 0.002"), "end = 0.1", "end = 100.0");
    ScratchFolder folder;
    folder.write("scene.toml", hours);
    Program program(folder, {"run", "scene.toml", "--out", "results", "--trace", "scene.toml/trace.json"});
    const auto code = program.wait(std::chrono::seconds(10));
    CHECK(code == 2);
    if (code) CHECK(program.err().find("trace.json") != std::string::npos);
}
