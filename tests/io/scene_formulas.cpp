// Formulas, constants and overrides in scene files: what they mean and what is refused, with the place.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "io/comparison.hpp"
#include "io/scene_formulas.hpp"
#include "tests/io/refusal.hpp"

using namespace aquagraph;

namespace {

const std::string tank = R"(schema_version = 1
[time]
end = 1
[domain]
min = [-1, -1]
max = [2, 2]
[fluid]
spacing = 0.1
sound_speed = 20
[[fluid.box]]
min = [0, 0]
max = [1, 1]
[[wall]]
name = "floor"
points = [[0, 0], [1, 0]]
)";

io::Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const test::ScratchFolder folder;
    return io::read_scene(folder.write("scene.toml", text), overrides);
}

// All that is said of a wrong scene.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return test::refusal_by([&] { read(text, overrides); });
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("constants are numbers or formulas of one another, in any order") {
    const io::Scene scene = read(tank + "[constants]\nomega = \"sqrt(9.81*k)\"\nk = \"2*pi/L\"\nL = 2\n");
    CHECK(scene.constants.at("L") == 2);
    CHECK(scene.constants.at("k") == doctest::Approx(3.14159265358979));
    CHECK(scene.constants.at("omega") == doctest::Approx(5.5515));
    const io::Constants all = io::all_constants(scene);
    CHECK(all.at("dx") == 0.1);
    CHECK(all.at("rho0") == 1000);
    CHECK(all.at("c0") == 20);
}

TEST_CASE("constants that mean nothing are refused") {
    CHECK(contains(refusal(tank + "[constants]\nk = \"2*pi/L\"\n"), "nothing is called \"L\""));
    CHECK(contains(refusal(tank + "[constants]\na = \"b\"\nb = \"a\"\n"), "circle"));
    CHECK(contains(refusal(tank + "[constants]\nx = 1\n"), "cannot be the name of a constant"));
    CHECK(contains(refusal(tank + "[constants]\nsin = 1\n"), "cannot be the name of a constant"));
    CHECK(contains(refusal(tank + "[constants]\nU = true\n"), "finite number or a formula"));
    CHECK(contains(refusal(tank + "[constants]\nU = \"1/0\"\n"), "finite"));
    CHECK(contains(refusal(tank + "[constants]\nU = \"1/0\"\n"), "scene.toml:17:"));
}

TEST_CASE("a formula that is none is named with its place and what helps") {
    const std::string said =
        refusal(tank + "[constants]\nomega = 2\n[fluid.initial]\nvelocity = [\"omga*y\", \"0\"]\n");
    CHECK(contains(said, "scene.toml:19:13"));
    CHECK(contains(said, "did you mean \"omega\"?"));
    CHECK(contains(refusal(tank + "[fluid.initial]\nvelocity = [\"0\"]\n"), "one per direction"));
    CHECK(contains(refusal(tank + "[fluid.initial]\npressure = \"t\"\n"), "nothing is called \"t\""));
    CHECK(refusal(tank + "[fluid.initial]\npressure = 3\n").empty());
    CHECK(contains(refusal(tank + "[fluid.initial]\npressure = true\n"), "a formula in quotes or a number"));
    CHECK(contains(refusal(tank + "[[integral]]\nname = \"a\"\nvalue = \"vx*\"\n"), "ends too early"));
    CHECK(contains(
        refusal(tank + "[[integral]]\nname = \"a\"\nvalue = \"1\"\n[[extreme]]\nname = \"a\"\nvalue = \"x\"\n"),
        "already"));
    CHECK(contains(refusal(tank + "[[field_error]]\nname = \"a\"\n"), "no field"));
    const std::string compare = "[[compare]]\ncolumn = \"particles\"\nlabel = \"l\"\n";
    CHECK(contains(refusal(tank + compare), "nothing to compare with"));
    CHECK(contains(refusal(tank + compare + "formula = \"x\"\n"), "nothing is called \"x\""));
    CHECK(contains(refusal(tank + compare + "formula = \"1/(t - t)\"\n"),
                   "scene.toml:19:11: error: at t = 0 s the formula is"));
    CHECK(contains(refusal(tank + compare + "formula = \"sqrt(0.5 - t)\"\n"), "the formula is"));
    CHECK(refusal(tank + compare + "formula = \"sqrt(0.5 - t)\"\nwindow = [0, 0.5]\n").empty());
    CHECK(contains(refusal(tank + compare + "formula = \"1\"\nfile = \"scene.toml\"\n"), "both"));
}

TEST_CASE("a pressure at the start is given once") {
    std::string twice = tank;
    twice.insert(twice.find("[[fluid.box]]"), "initial_pressure = \"zero\"\n");
    CHECK(refusal(twice).empty());
    CHECK(contains(refusal(twice + "[fluid.initial]\npressure = \"1\"\n"), "given twice"));
}

TEST_CASE("a comparison with a formula is one with the curve") {
    io::Compare compare;
    compare.column = "tip";
    compare.formula = "A*sin(t)";
    compare.window = {0, 2};
    io::History history{{{"time", "s"}, {"tip", "m"}}, {{0, 1, 2}, {0, 0, 0}}};
    const io::Comparison result = io::compare_with(compare, history, {{"A", 3.0}});
    CHECK(result.points == 1001);
    CHECK(result.peak == doctest::Approx(3).epsilon(1e-5));
    // RMS of sin over [0, 2], exactly sqrt((1 - sin(4)/4)/2).
    CHECK(result.normalised == doctest::Approx(std::sqrt((1 - std::sin(4.0) / 4) / 2)).epsilon(1e-3));
    compare.scale = 30;
    compare.formula = "0";
    history.values[1] = {5, 6, 7};
    CHECK(io::compare_with(compare, history).mean == doctest::Approx(6));
    compare.change = true;
    CHECK(io::compare_with(compare, history).mean == doctest::Approx(1));
    compare.change = false;
    history.values[1] = {0, 0, 0};
    compare.formula = "A*sin(t)";
    CHECK(io::compare_with(compare, history, {{"A", 3.0}}).normalised == doctest::Approx(result.normalised / 10));
}

TEST_CASE("overrides stand above the file") {
    const io::Scene scene =
        read(tank, {"fluid.spacing=0.05", "fluid.scheme.reconstruction=none", "wall[0].slip=\"none\"",
                    "fluid.box[0].max=[0.5, 1]", "output.history_interval=0.1", "title=Small tank"});
    CHECK(scene.fluid->spacing == 0.05);
    CHECK(scene.fluid->scheme.reconstruction == io::Reconstruction::none);
    CHECK(scene.walls[0].slip == io::Slip::none);
    CHECK(scene.fluid->boxes[0].max == io::Point{0.5, 1});
    CHECK(scene.output.history_interval == 0.1);
    CHECK(scene.title == "Small tank");
    CHECK(scene.overrides.size() == 6);
    CHECK(scene.text.ends_with("# --set title=Small tank\n"));
}

TEST_CASE("an override is checked like the file, and the message says which it was") {
    CHECK(contains(refusal(tank, {"fluid.spacing=-1"}), "--set fluid.spacing=-1: error: `spacing` must be > 0"));
    CHECK(contains(refusal(tank, {"fluid.spacng=1"}), "did you mean `spacing`"));
    CHECK(contains(refusal(tank, {"fluid.spacing=coarse"}), "--set fluid.spacing=coarse: error"));
    CHECK(contains(refusal(tank, {"fluid.spacing"}), "KEY=VALUE"));
    CHECK(contains(refusal(tank, {"wall[1].slip=none"}), "there is no wall[1]"));
    CHECK(contains(refusal(tank, {"wall[x].slip=none"}), "there is no wall[x]"));
    CHECK(contains(refusal(tank, {"wall[].slip=none"}), "there is no wall[]"));
    CHECK(contains(refusal(tank, {"wall.slip=none"}), "wall[0]"));
    CHECK(contains(refusal(tank, {"title.x=1", "fluid.box[0].max=[-1, 1]"}), "--set fluid.box[0].max=[-1, 1]: error"));
    // The file's own mistakes keep their places.
    CHECK(contains(refusal(tank + "[output]\nframe_intervall = 1\n", {"fluid.spacing=0.2"}), "scene.toml:17:"));
}
