// A solver of the body that is another program: it is not there, it dies, it answers nonsense. What was computed until
// then is kept, and the message says what happened.
#include <doctest/doctest.h>

#include <cstdlib>
#include <regex>

#include "tests/ccx.hpp"
#include "tests/robustness/program.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

const std::vector<std::string> run{"run", "scene.toml", "--out", "results"};

std::string by(const std::string& program, const std::string& scene = with(plate, "end = 0.1", "end = 0.05")) {
    return with(scene, "name = \"plate\"\n",
                "name = \"plate\"\nsolver = \"calculix\"\nintegration = \"full\"\n" + program);
}

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// A program that is ccx for the first five runs, the version and the equilibrium among them; then this happens.
struct Calculix {
    ScratchFolder folder;
    std::optional<int> code;
    std::string err;
    ResultsFolder results;

    explicit Calculix(const std::string& then) {
        folder.write("scene.toml", by("program = \"./ccx\"\n"));
        const auto file = folder.write("ccx",
                                       "#!/bin/sh\n"
                                       "n=$(($(cat runs 2>/dev/null || echo 0) + 1))\n"
                                       "echo $n > runs\n"
                                       "if [ $n -gt 5 ]; then\n" +
                                           then + "\nfi\nexec ccx \"$@\"\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        Program program(folder, run);
        code = program.wait(std::chrono::seconds(60));
        err = program.err();
        results.path = folder / "results";
    }
    // Whatever it was: the run has failed in its fourth step, and its results are whole.
    void check(const std::string& why) {
        INFO(err);
        REQUIRE(code == 3);
        CHECK(says(err, "CalculiX failed in step 4: "));
        CHECK(says(err, why));
        CHECK(says(err, "What was computed until then is in results"));
        const nlohmann::json summary = results.summary();
        CHECK(summary.at("outcome") == "failed");
        CHECK(summary.at("coupling_cycles") == 3);
        CHECK(summary.at("solid").at("steps") == 3);
        const io::History history = results.history();
        CHECK(history.rows() >= 4);
        CHECK(history.column("mid_y")[3] < -1e-6);
        CHECK(results.report().find("<html") != std::string::npos);
        for (const FrameOnDisk& frame : results.frames("solid")) CHECK_NOTHROW(results.open(frame));
        // Its files are kept, to be looked at.
        std::smatch match;
        REQUIRE(std::regex_search(err, match, std::regex("its files are step\\.\\* in (\\S+) ")));
        const std::filesystem::path kept = match[1].str();
        CHECK(std::filesystem::exists(kept / "step.inp"));
        if (kept.filename().string().starts_with("aquagraph_calculix_")) std::filesystem::remove_all(kept);
    }
};

}  // namespace

TEST_CASE("a second solver that is not there is missed before anything is computed") {
    const Call call({"run", "SCENE", "--out", "results"}, by("program = \"no/such/ccx\"\n"));
    CHECK(call.code == 2);
    INFO(call.err);
    CHECK(says(call.err, "scene.toml:"));
    CHECK(says(call.err, "CalculiX cannot be started"));
    CHECK(says(call.err, "no/such/ccx: No such file"));
    CHECK(says(call.err, "calculix-ccx"));
    CHECK(call.left_nothing());

    const Call other({"run", "SCENE", "--out", "results"}, by("program = \"/bin/true\"\n"));
    CHECK(other.code == 2);
    CHECK(says(other.err, "does not answer with a version"));

    const Call unused({"run", "SCENE", "--out", "results"},
                      with(plate, "name = \"plate\"\n", "name = \"plate\"\nprogram = \"ccx\"\n"));
    CHECK(unused.code == 2);
    CHECK(says(unused.err, "solver = \"calculix\""));
}

TEST_CASE("what the second solver does not know is refused before anything is computed") {
    if (ccx_is_missing()) return;
    const Call plane({"run", "SCENE", "--out", "results"}, by("plane = \"stress\"\n"));
    CHECK(plane.code == 2);
    CHECK(says(plane.err, "plane strain"));
    const Call reduced({"run", "SCENE", "--out", "results"}, with(by(""), "\"full\"", "\"reduced\""));
    CHECK(reduced.code == 2);
    CHECK(says(reduced.err, "integration = \"full\""));
    const Call scheme({"run", "SCENE", "--out", "results"},
                      by("", plate + "[solid.scheme]\nname = \"newmark\"\nalpha = -0.1\n"));
    CHECK(scheme.code == 2);
    CHECK(says(scheme.err, "CalculiX has no Newmark scheme"));
}

TEST_CASE("a second solver that is killed, gives up, vanishes or answers nonsense ends the run and spoils nothing") {
    if (ccx_is_missing()) return;
    Calculix("(kill -9 $$) & exec ccx \"$@\"").check("it was ended by signal 9");
    Calculix("echo ' *ERROR in fancy: the moon'\necho '       is in the wrong phase'\nexit 201")
        .check("*ERROR in fancy: the moon is in the wrong phase");
    Calculix("exit 7").check("it ended with code 7");
    Calculix("exit 0").check("there is no displacement of any node");
    Calculix("ccx \"$@\"; sed -i 's/E-0[0-9]/NaN/' step.dat; exit 0").check("is missing or no number");
    Calculix("ccx \"$@\"; rm step.rout; exit 0").check("it has written no restart file");
    // Gone after its fifth run.
    Calculix vanished("exit 9\nfi\nif [ $n -eq 5 ]; then rm \"$0\"");
    vanished.check("No such file");
}
