// Every mistake that a scene file can hold is reported with its place, the source line, a caret and what would be
// right.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/scene_reader.hpp"
#include "io/study_file.hpp"
#include "tests/io/scratch.hpp"
#include "tests/text.hpp"

using namespace aquagraph;
using test::ScratchFolder;
using test::with;
using test::without;

namespace {

// A sound scene; each test spoils one thing in it.
const std::string sound = R"(schema_version = 1
title = "test"
[time]
end = 1.0
[domain]
min = [-1.0, -1.0]
max = [2.0, 2.0]
[fluid]
spacing = 0.1
sound_speed = 20.0
[[fluid.box]]
min = [0.0, 0.0]
max = [1.0, 0.5]
[[wall]]
name = "floor"
points = [[0.0, 0.0], [1.0, 0.0]]
[solid]
wet = ["left"]
[solid.box]
min = [1.0, 0.0]
max = [1.1, 0.5]
elements = [1, 5]
[solid.material]
density = 1100.0
youngs_modulus = 1e6
poissons_ratio = 0.4
[[solid.clamp]]
set = "top"
[[solid.track]]
name = "tip"
point = [1.0, 0.0]
[coupling]
ratio = 2
)";

std::string error_of(const std::string& text, std::vector<io::SceneComplaint>* complaints = nullptr) {
    ScratchFolder folder;
    folder.write("curve.csv", "0, 1\n1, 2\n");
    folder.write("words.csv", "time, value\n");
    folder.write("body.msh", "");
    const auto file = folder.write("scene.toml", text);
    try {
        io::read_scene(file);
    } catch (const io::SceneError& error) {
        if (complaints) *complaints = error.complaints();
        std::string what = error.what();
        const std::string prefix = file.parent_path().string() + "/";
        for (auto at = what.find(prefix); at != std::string::npos; at = what.find(prefix))
            what.erase(at, prefix.size());
        return what;
    }
    return "";
}

// The one complaint about the spoilt scene.
void expect(std::string_view old, std::string_view replacement, int line, int column, std::string_view message,
            std::string_view help) {
    CAPTURE(old);
    CAPTURE(replacement);
    const std::string text = with(sound, old, replacement);
    std::vector<io::SceneComplaint> complaints;
    const std::string what = error_of(text, &complaints);
    CAPTURE(what);
    REQUIRE(complaints.size() == 1);
    CHECK(complaints[0].position.line == line);
    CHECK(complaints[0].position.column == column);
    CHECK(what.find(message) != std::string::npos);
    CHECK(what.substr(std::min(what.find("help: "), what.size())).find(help) != std::string::npos);
    CHECK(what.starts_with(fmt::format("scene.toml:{}:{}: error: ", line, column)));
}

}  // namespace

TEST_CASE("a sound scene is read") {
    CHECK(error_of(sound) == "");
}

TEST_CASE("the whole of a message") {
    CHECK(error_of(with(sound, "spacing = 0.1", "\tspacing = -0.1")) ==
          "scene.toml:9:12: error: `spacing` must be > 0, but it is -0.1\n"
          "    \tspacing = -0.1\n"
          "    \t          ^\n"
          "help: `spacing` is a number > 0, in m: Δx, distance between particles");
}

TEST_CASE("of a very long line the part about the mistake is shown, and no character that a terminal would obey") {
    const std::string long_title = "title = \"" + std::string(500, 'x') + "\" ü \x1b[2J\xff";
    const std::string what = error_of(with(sound, "title = \"test\"", long_title));
    CAPTURE(what);
    CHECK(what.size() < 500);
    CHECK(what.find('\x1b') == std::string::npos);
    CHECK(what.find('\xff') == std::string::npos);
    std::string crowded = "spacing = -0.1 # ";
    for (int k = 0; k < 300; ++k) crowded += "ü";
    CHECK(error_of(with(sound, "spacing = 0.1", crowded)).find("\n    spacing = -0.1 # üü") != std::string::npos);
    // The caret stands below its target although the line begins elsewhere.
    const std::string far = error_of(with(sound, "min = [0.0, 0.0]", "min = [0.0," + std::string(300, ' ') + "\"a\"]"));
    CAPTURE(far);
    const std::size_t line = far.find("\n    …") + 1, caret = far.find("\n    ", line + 1) + 1;
    const std::size_t target = far.find("\"a\"", line) - line - std::string("…").size() + 1;
    CHECK(far.find('^', caret) - caret == target);
}

TEST_CASE("a study in place of a scene is recognised, and the other way round") {
    const std::filesystem::path benchmarks = std::filesystem::path(AQUAGRAPH_SOURCE_DIR) / "benchmarks";
    CHECK_THROWS_WITH_AS(io::read_scene(benchmarks / "fluid.study.toml"),
                         doctest::Contains("this is a study, not a scene"), io::SceneError);
    CHECK_THROWS_WITH_AS(io::read_study(benchmarks / "gate_2d/scene.toml"),
                         doctest::Contains("this is a scene, not a study"), io::SceneError);
}

TEST_CASE("a file that cannot be read") {
    CHECK_THROWS_WITH_AS(io::read_scene("no/such/scene.toml"),
                         "no/such/scene.toml: error: the scene cannot be read: No such file or directory\n"
                         "help: give the path of a scene file, such as benchmarks/gate_2d/scene.toml",
                         io::SceneError);
    CHECK_THROWS_AS(io::read_scene("."), io::SceneError);
}

TEST_CASE("syntax") {
    expect("spacing = 0.1", "spacing = 0.1.2", 9, 14, "not valid TOML", "every bracket is closed");
    expect("spacing = 0.1", "spacing = 0.1\nspacing = 0.2", 10, 11, "not valid TOML", "a key stands once");
    expect("title = \"test\"", "title = \"test", 2, 14, "not valid TOML", "texts stand in quotes");
}

TEST_CASE("version") {
    expect("schema_version = 1\n", "", 1, 1, "`schema_version` is missing", "a whole number, 1");
    expect("schema_version = 1", "schema_version = 2", 1, 18, "schema_version 2 is not supported",
           "schema_version = 1");
    expect("schema_version = 1", "schema_version = \"1\"", 1, 18,
           "`schema_version` must be a whole number, 1, but it is a text", "version");
}

TEST_CASE("unknown keys and tables") {
    expect("sound_speed", "soundspeed = 3\nsound_speed", 10, 1, "unknown key `soundspeed` in [fluid]",
           "did you mean `sound_speed`?");
    expect("[time]", "[tyme]\n[time]", 3, 2, "unknown key or table `tyme`", "did you mean `time`?");
    expect("[solid.material]", "[solid.materail]\n[solid.material]", 23, 8, "unknown key `materail` in [solid]",
           "did you mean `material`?");
    expect("spacing = 0.1", "spacing = 0.1\nratio = 2", 10, 1, "unknown key `ratio` in [fluid]",
           "`ratio` belongs to [coupling]");
    expect("end = 1.0", "end = 1.0\nqqqqqq = 2", 5, 1, "unknown key `qqqqqq` in [time]", "known here: end");
    expect("end = 1.0", "end = 1.0\ntitle = \"x\"", 5, 1, "unknown key `title` in [time]",
           "belongs at the top of the file");
    expect("set = \"top\"", "set = \"top\"\nfixd = [\"x\"]", 29, 1, "unknown key `fixd` in [[solid.clamp]]",
           "did you mean `fixed`?");
}

TEST_CASE("missing tables and keys") {
    expect("[time]\nend = 1.0\n", "", 1, 1, "the table [time] is missing", "every scene needs [time]");
    expect("[domain]\nmin = [-1.0, -1.0]\nmax = [2.0, 2.0]\n", "", 1, 1, "the table [domain] is missing",
           "every scene needs [domain]");
    expect("spacing = 0.1\n", "", 8, 1, "`spacing` is missing in [fluid]", "Δx");
    expect("sound_speed = 20.0\n", "", 8, 1, "`sound_speed` is missing in [fluid]", "c0");
    expect("max = [1.0, 0.5]\n", "", 11, 1, "`max` is missing in [[fluid.box]]", "upper right corner");
    expect("density = 1100.0\n", "", 23, 1, "`density` is missing in [solid.material]", "in kg/m³");
    expect("elements = [1, 5]\n", "", 19, 1, "`elements` is missing in [solid.box]", "two whole numbers");
    expect("[solid.material]\ndensity = 1100.0\nyoungs_modulus = 1e6\npoissons_ratio = 0.4\n", "", 17, 1,
           "[solid.material] is missing", "give density, youngs_modulus");
}

TEST_CASE("wrong types") {
    expect("spacing = 0.1", "spacing = \"0.1\"", 9, 11, "`spacing` must be a number > 0, in m, but it is a text", "Δx");
    expect("title = \"test\"", "title = 3", 2, 9, "`title` must be a text in quotes, but it is a whole number",
           "one line for the report");
    expect("title = \"test\"", "title = \"\"", 2, 9, "`title` must be a text in quotes, but it is empty",
           "one line for the report");
    expect("ratio = 2", "ratio = 2.0", 33, 9,
           "`ratio` must be a whole number in [1, 100], but it is a number with a fraction", "fluid steps");
    expect("wet = [\"left\"]", "wet = \"left\"", 18, 7, "`wet` must be a list of texts", "surface sets");
    expect("wet = [\"left\"]", "wet = [\"left\"]\nstatic_start = 1", 19, 16,
           "`static_start` must be true or false, but it is a whole number", "equilibrium");
    expect("min = [0.0, 0.0]", "min = [0.0]", 12, 7,
           "`min` must be two numbers [x, y] or three [x, y, z], in m, but it is a list of 1", "lower left");
    expect("min = [0.0, 0.0]", "min = [0.0, \"a\"]", 12, 13, "`min` must be two numbers", "lower left");
    expect("points = [[0.0, 0.0], [1.0, 0.0]]", "points = [[0.0, 0.0], 1.0]", 16, 23,
           "`points` must be a list of points", "two or more");
    expect("elements = [1, 5]", "elements = [1.5, 5]", 22, 13, "`elements` must be two whole numbers", "along x");
    expect("[[wall]]", "[wall]", 14, 2, "`wall` must be a list of tables, but it is a table",
           "write [[wall]] with double brackets");
    expect("[time]\nend = 1.0\n", "time = 3\n", 3, 1, "`time` must be a table, but it is a whole number",
           "write [time] once");
}

TEST_CASE("impossible numbers") {
    expect("spacing = 0.1", "spacing = 0", 9, 11, "`spacing` must be > 0, but it is 0", "Δx");
    expect("spacing = 0.1", "spacing = nan", 9, 11, "`spacing` must be a finite number, but it is nan", "Δx");
    expect("end = 1.0", "end = inf", 4, 7, "`end` must be a finite number, but it is inf", "simulated time");
    expect("end = 1.0", "end = -1.0", 4, 7, "`end` must be > 0, but it is -1", "simulated time");
    expect("sound_speed = 20.0", "sound_speed = -20.0", 10, 15, "`sound_speed` must be > 0", "c0");
    expect("spacing = 0.1", "spacing = 0.1\nsupport_ratio = 1.4", 10, 17,
           "`support_ratio` must be in [1.5, 6], but it is 1.4", "R/Δx");
    expect("spacing = 0.1", "spacing = 0.1\nsupport_ratio = 6.1", 10, 17, "`support_ratio` must be in [1.5, 6]",
           "R/Δx");
    expect("spacing = 0.1", "spacing = 0.1\ncfl = 0.0", 10, 7, "`cfl` must be in ]0, 1], but it is 0", "K of");
    expect("spacing = 0.1", "spacing = 0.1\ncfl = 1.5", 10, 7, "`cfl` must be in ]0, 1], but it is 1.5", "K of");
    expect("spacing = 0.1", "spacing = 0.1\ndensity = 0", 10, 11, "`density` must be > 0", "ρ0");
    expect("ratio = 2", "ratio = 0", 33, 9, "`ratio` must be in [1, 100], but it is 0", "fluid steps per solid step");
    expect("ratio = 2", "ratio = 101", 33, 9, "`ratio` must be in [1, 100], but it is 101",
           "fluid steps per solid step");
    expect("ratio = 2", "step_fraction = 1.01", 33, 17, "`step_fraction` must be in ]0, 1], but it is 1.01",
           "CFL step");
    expect("poissons_ratio = 0.4", "poissons_ratio = 0.5", 26, 18,
           "`poissons_ratio` must be in ]-1, 0.5[, but it is 0.5", "ν");
    expect("youngs_modulus = 1e6", "youngs_modulus = 0.0", 25, 18, "`youngs_modulus` must be > 0", "in Pa");
    expect("density = 1100.0", "density = -1.0", 24, 11, "`density` must be > 0", "in kg/m³");
    expect("elements = [1, 5]", "elements = [0, 5]", 22, 13, "`elements` must be ≥ 1, but it is 0", "each ≥ 1");
    expect("[coupling]", "[solid.scheme]\nalpha = 0.1\n[coupling]", 33, 9,
           "`alpha` must be in ]-1/3, 0], but it is 0.1", "damping");
    expect("[coupling]", "[solid.scheme]\nalpha = -0.3333333333333333\n[coupling]", 33, 9,
           "`alpha` must be in ]-1/3, 0]", "damping");
    expect("[coupling]", "[output]\nframe_interval = 0.0\n[coupling]", 33, 18, "`frame_interval` must be > 0",
           "frames");
    expect("[coupling]", "[output]\nhistory_interval = -1\n[coupling]", 33, 20, "`history_interval` must be > 0",
           "history.csv");
}

TEST_CASE("choices") {
    expect("ratio = 2", "algorithm = \"cpss\"", 33, 13,
           "`algorithm` must be one of \"cps\", \"css\", \"iterated\", but it is \"cpss\"", "did you mean \"cps\"?");
    expect("max = [2.0, 2.0]", "max = [2.0, 2.0]\nedge = \"periodic\"", 8, 8,
           "`edge` must be one of \"closed\", \"open\"", "taken out and counted");
}

TEST_CASE("boxes") {
    expect("max = [1.0, 0.5]", "max = [1.0, -0.5]", 13, 7,
           "`max` must lie beyond `min`, but in y it is -0.5 and `min` is 0", "upper right");
    expect("max = [1.1, 0.5]", "max = [1.0, 0.5]", 21, 7,
           "`max` must lie beyond `min`, but in x it is 1 and `min` is 1", "upper right");
    expect("max = [2.0, 2.0]", "max = [-2.0, 2.0]", 7, 7, "`max` must lie beyond `min`", "lower left");
    expect("max = [1.0, 0.5]", "max = [1.0, 0.05]", 13, 7, "the box is 0.05 m high, less than one spacing of 0.1 m",
           "a cell of Δx in every direction");
    expect("[[wall]]", "[[fluid.box]]\nmin = [0.9, 0.4]\nmax = [1.0, 0.6]\n[[wall]]", 14, 1,
           "water box 2 overlaps water box 1 in [0.9, 0.4] – [1, 0.5]", "may share an edge");
    expect("max = [1.0, 0.5]", "max = [1.05, 0.5]", 11, 1, "water box 1 overlaps the solid box in [1, 0] – [1.05, 0.5]",
           "which fills [1, 0] – [1.1, 0.5]");
    expect("max = [1.0, 0.5]", "max = [1.0, 2.5]", 11, 1, "water box 1 reaches out of the domain [-1, -1] – [2, 2]",
           "enclose all water");
    expect("[[fluid.box]]\nmin = [0.0, 0.0]\nmax = [1.0, 0.5]\n", "", 8, 1, "[fluid] has no water in it",
           "[[fluid.box]]");
    CHECK(error_of(with(sound, "[[wall]]", "[[fluid.box]]\nmin = [0.0, 0.5]\nmax = [1.0, 0.6]\n[[wall]]")) == "");
}

TEST_CASE("periodic directions") {
    const std::string_view max = "max = [2.0, 2.0]\n";
    CHECK(error_of(with(sound, max, "max = [2.0, 2.0]\nperiodic = [\"x\"]\n")) == "");
    expect(max, "max = [2.0, 2.0]\nperiodic = [\"z\"]\n", 8, 12, "'z' is no direction of a 2D scene", "periodic = [");
    expect(max, "max = [2.0, 2.0]\nperiodic = [\"y\"]\n", 8, 12, "gravity acts along y", "across the periodic");
}

TEST_CASE("walls") {
    expect("points = [[0.0, 0.0], [1.0, 0.0]]", "points = [[0.0, 0.0]]", 16, 10,
           "a wall needs at least 2 points, but this one has 1", "on the left of the way");
    expect("points = [[0.0, 0.0], [1.0, 0.0]]", "points = [[0.0, 0.0], [0.0, 0.0]]", 16, 23,
           "segment 1 of the wall has no length", "one of the two points out");
    expect("points = [[0.0, 0.0], [1.0, 0.0]]", "points = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]\nclosed = true", 16, 35,
           "the first point is repeated", "already joins");
}

TEST_CASE("names") {
    expect("[solid]", "[[wall]]\nname = \"floor\"\npoints = [[0.0, 0.0], [1.0, 0.0]]\n[solid]", 18, 8,
           "the name \"floor\" is already taken", "choose another");
    expect("[solid]", "[solid]\nname = \"floor\"", 18, 8, "the name \"floor\" is already taken", "choose another");
    expect("[coupling]", "[[solid.track]]\nname = \"tip\"\npoint = [1.0, 0.5]\n[coupling]", 33, 8,
           "the name \"tip\" is already taken", "choose another");
    expect("name = \"tip\"", "name = \"energy\"", 30, 8, "the name \"energy\" is reserved for the results",
           "reserved are time");
    expect("name = \"tip\"", "name = \"my tip\"", 30, 8, "\"my tip\" cannot be a name", "beginning with a letter");
}

TEST_CASE("the solid's shape and sets") {
    expect("wet = [\"left\"]", "wet = [\"left\"]\nmesh = \"body.msh\"", 19, 8,
           "[solid] has both `mesh` and [solid.box]", "keep one");
    expect("[solid.box]\nmin = [1.0, 0.0]\nmax = [1.1, 0.5]\nelements = [1, 5]\n", "", 17, 1, "[solid] has no shape",
           "mesh = ");
    expect("wet = [\"left\"]\n[solid.box]\nmin = [1.0, 0.0]\nmax = [1.1, 0.5]\nelements = [1, 5]\n",
           "wet = [\"left\"]\nmesh = \"none.msh\"\n", 19, 8, "none.msh does not exist", "a Gmsh (.msh)");
    expect("wet = [\"left\"]", "wet = []", 18, 7, "`wet` is empty", "name the surfaces");
    expect("wet = [\"left\"]", "", 17, 1, "no surface of the solid touches the water", "name the surfaces");
    expect("wet = [\"left\"]", "wet = [\"letf\"]", 18, 8, "the box has no surface \"letf\"", "did you mean \"left\"?");
    expect("wet = [\"left\"]", "wet = [\"left\", \"left\"]", 18, 16, "\"left\" is named twice", "once");
    expect("set = \"top\"", "set = \"front\"", 28, 7, "the box has no node set \"front\"",
           "left, right, bottom and top");
    expect("set = \"top\"", "set = \"top\"\nfixed = [\"z\"]", 29, 9, "`fixed` must name \"x\", \"y\" or both",
           "holds the nodes");
    expect("[coupling]", "[[solid.clamp]]\nset = \"top\"\n[coupling]", 33, 7, "\"top\" is named twice", "once");
    CHECK(error_of(with(sound, "[solid.box]\nmin = [1.0, 0.0]\nmax = [1.1, 0.5]\nelements = [1, 5]\n",
                        "mesh = \"body.msh\"\n")) == "");
    expect(
        "wet = [\"left\"]\n[solid.box]\nmin = [1.0, 0.0]\nmax = [1.1, 0.5]\nelements = [1, "
        "5]\n[solid.material]\ndensity = 1100.0\n"
        "youngs_modulus = 1e6\npoissons_ratio = 0.4\n[[solid.clamp]]\nset = \"top\"\n",
        "wet = [\"left\"]\nstatic_start = true\n[solid.box]\nmin = [1.0, 0.0]\nmax = [1.1, 0.5]\nelements = [1, "
        "5]\n[solid.material]\n"
        "density = 1100.0\nyoungs_modulus = 1e6\npoissons_ratio = 0.4\n",
        19, 16, "has no equilibrium to start from", "clamp it");
}

TEST_CASE("laws and their numbers") {
    const std::string numbers = "density = 1100.0\nyoungs_modulus = 1e6\npoissons_ratio = 0.4\n";
    expect("youngs_modulus = 1e6\n", "", 23, 1, "`youngs_modulus` is missing in [solid.material]",
           "the law saint_venant_kirchhoff takes density, youngs_modulus and poissons_ratio");
    expect(numbers, "law = \"mooney_rivlin\"\ndensity = 1100.0\nc10 = 1e5\n", 23, 1,
           "`bulk_modulus` is missing in [solid.material]", "c01 (0 if not given)");
    expect(numbers, numbers + "c10 = 1e5\n", 27, 7, "`c10` does not belong to the law saint_venant_kirchhoff",
           "takes density, youngs_modulus");
    expect(numbers, "law = \"neo_hookean\"\n" + numbers + "[[solid.part]]\nset = \"belt\"\n" + numbers, 29, 7,
           "a box has no element sets", "physical groups");
}

TEST_CASE("a solid without water") {
    std::string alone =
        without(sound,
                "[fluid]\nspacing = 0.1\nsound_speed = 20.0\n[[fluid.box]]\nmin = [0.0, 0.0]\nmax = [1.0, "
                "0.5]\n[[wall]]\nname = \"floor\"\npoints = [[0.0, 0.0], [1.0, 0.0]]\n");
    alone = without(without(alone, "wet = [\"left\"]\n"), "[coupling]\nratio = 2\n");
    const auto found = [&](const std::string& extra, const std::string& message) {
        const std::string error = error_of(alone + extra);
        CAPTURE(error);
        CHECK(error.find(message) != std::string::npos);
    };
    const std::string step = "[solid.scheme]\nstep = 1e-3\n",
                      load = "[[solid.traction]]\nsurface = \"left\"\nvalue = [1, 0]\n";
    CHECK(error_of(alone + step + load) == "");
    CHECK(error_of(alone + "[solid.scheme]\nname = \"static\"\n") == "");
    found("", "nothing says how long a time step is");
    found("[solid.scheme]\nname = \"static\"\nalpha = -0.1\n", "this does nothing in a static run");
    found(step + "[[wall]]\nname = \"floor\"\npoints = [[0.0, 0.0], [1.0, 0.0]]\n", "walls hold water");
    found(step + with(load, "left", "lefd"), "the box has no surface \"lefd\"");
    found(step + load + "factor = \"x\"\n", "\"x\" is no formula");
    found(step + load + "table = \"none.csv\"\n", "none.csv does not exist");
    found(step + "[[solid.force]]\nvalue = [1, 0]\n", "neither `set` nor `point`");
    found(step + "[[solid.force]]\nvalue = [1, 0]\npoint = [1, 0, 0]\n", "a point of 3 coordinates");
    found(step + "[[solid.force]]\nvalue = [1, 0]\nset = \"top\"\npoint = [1, 0]\n", "both a `set` and a `point`");
    found(step + "[output]\nenergy_ledger = true\n", "a body alone has its energies as columns");
    CHECK(error_of(with(alone + step, "max = [2.0, 2.0]\n", "max = [2.0, 2.0]\nperiodic = [\"x\"]\n"))
              .find("only water goes round") != std::string::npos);
    found(step + "[[probe]]\nname = \"p\"\nquantity = \"pressure\"\npoint = [0, 0]\n", "a probe needs water");
    expect("[coupling]", load + "[coupling]", 32, 1, "a body in water bears the water's load alone", "");
    expect("[coupling]", step + "[coupling]", 33, 8, "with water the step of the solid is the coupling cycle", "");
    expect("elements = [1, 5]", "elements = [1, 5, 2]", 22, 12, "3 counts in a scene of 2 dimensions", "along y]");
    expect("wet = [\"left\"]", "wet = [\"left\"]\norder = 1", 19, 9, "needs elements with nodes on their edges", "");
}

TEST_CASE("keys that would do nothing") {
    expect("[[fluid.box]]", "[fluid.transport]\nname = \"none\"\nepsilon = 0.3\n[[fluid.box]]", 13, 11,
           "`epsilon` belongs to X-SPH", "x_sph");
    expect("ratio = 2", "algorithm = \"css\"\nstep_rule = \"predicted\"", 34, 13, "css chooses every step anew",
           "\"cps\"");
    CHECK(error_of(with(sound, "ratio = 2", "algorithm = \"css\"\nstep_rule = \"fixed\"")) == "");
    expect("spacing = 0.1", "spacing = 0.1\nrelax_tolerance = 0.01", 10, 19, "nothing is relaxed in this scene",
           "relax = true");
}

TEST_CASE("more particles or elements than can be counted") {
    expect("spacing = 0.1", "spacing = 1e-7", 9, 11, "the water would be 5e+13 particles", "take a larger spacing");
    expect("elements = [1, 5]", "elements = [100000, 100000]", 22, 12, "1e+10 elements are more than", "take fewer");
}

TEST_CASE("parts that a scene needs together") {
    const std::string head = "schema_version = 1\n[time]\nend = 1.0\n[domain]\nmin = [0, 0]\nmax = [1, 1]\n";
    const std::string none = error_of(head);
    CHECK(none.find("scene.toml:1:1: error: the scene has neither [fluid] nor [solid]") == 0);
    CHECK(none.find("help: give at least one of them") != std::string::npos);
    const std::string alone = error_of(
        head + "[fluid]\nspacing = 0.1\nsound_speed = 10\n[[fluid.box]]\nmin = [0, 0]\nmax = [1, 1]\n[coupling]\n");
    CHECK(alone.find("scene.toml:13:1: error: [coupling] needs a fluid and a solid, but there is no [solid]") == 0);
    CHECK(alone.find("help: add [solid] or take [coupling] out") != std::string::npos);
}

TEST_CASE("comparisons") {
    const std::string end = "[coupling]\nratio = 2\n";
    const auto compare = [&](const std::string& rest) {
        return end + "[[compare]]\ncolumn = \"tip_x\"\nlabel = \"a\"\n" + rest;
    };
    expect(end, compare("file = \"none.csv\"\n"), 37, 8, "none.csv does not exist", "two columns of numbers");
    expect(end, compare("file = \"words.csv\"\n"), 37, 8, "holds no line with two numbers", "two columns of numbers");
    expect(end, compare("file = \".\"\n"), 37, 8, "the file cannot be used", "two columns of numbers");
    expect(end, compare("file = \"curve.csv\"\nwindow = [0.5, 0.1]\n"), 38, 10,
           "`window` runs backwards, from 0.5 s to 0.1 s", "from < to");
    expect(end, compare("file = \"curve.csv\"\nwindow = [7, 8]\n"), 38, 10, "no point between 7 s and 8 s",
           "time_scale");
    expect(end, compare("file = \"curve.csv\"\ntime_scale = 0\n"), 38, 14, "`time_scale` must be > 0", "seconds");
    CHECK(error_of(with(sound, end, compare("file = \"curve.csv\"\n"))) == "");
}

TEST_CASE("all mistakes of a file are reported at once, in its order") {
    std::vector<io::SceneComplaint> complaints;
    const std::string what = error_of(
        with(with(with(sound, "end = 1.0", "end = 0"), "ratio = 2", "ratoi = 2"), "spacing = 0.1", "spacing = -1"),
        &complaints);
    REQUIRE(complaints.size() == 3);
    CHECK(complaints[0].key == "time.end");
    CHECK(complaints[1].key == "fluid.spacing");
    CHECK(complaints[2].key == "coupling.ratoi");
    CHECK(std::count(what.begin(), what.end(), '^') == 3);
}

TEST_CASE("a mistake that shows later points into the file too") {
    ScratchFolder folder;
    const io::Scene scene = io::read_scene(folder.write("scene.toml", sound));
    const io::SceneError error = io::scene_error(scene, "solid.wet[0]", "the mesh has no set \"left\"", "it has a, b");
    CHECK(std::string(error.what()).find("scene.toml:18:8: error: the mesh has no set") != std::string::npos);
    CHECK(io::scene_error(scene, "solid.box.unknown", "m", "h").complaints()[0].position.line == 19);
}

TEST_CASE("a compared column that the run will not write") {
    ScratchFolder folder;
    folder.write("curve.csv", "0, 1\n");
    const io::Scene scene = io::read_scene(
        folder.write("scene.toml", sound + "[[compare]]\ncolumn = \"tpi_x\"\nfile = \"curve.csv\"\nlabel = \"a\"\n"));
    const std::vector<std::string> columns{"time", "tip_x", "tip_y"};
    CHECK_THROWS_WITH_AS(io::check_compared_columns(scene, columns),
                         doctest::Contains("scene.toml:35:10: error: history.csv will have no column \"tpi_x\""),
                         io::SceneError);
    CHECK_THROWS_WITH_AS(io::check_compared_columns(scene, columns), doctest::Contains("did you mean \"tip_x\"?"),
                         io::SceneError);
    CHECK_NOTHROW(io::check_compared_columns(scene, std::vector<std::string>{"tpi_x"}));
}
