// What is asked of a scene's body besides a run: its natural modes, and its deck for CalculiX.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/calculix_command.hpp"
#include "engine/modes_command.hpp"
#include "tests/engine/body_scenes.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// The beam of body_scenes.hpp in motion about a static state: stretched, it swings faster.
std::vector<double> frequencies(const std::string& text, int wanted) {
    ScratchFolder folder;
    const io::Scene scene = io::read_scene(folder.write("scene.toml", text));
    std::ostringstream out, err;
    engine::ModesOptions options;
    options.count = wanted;
    options.threads = 2;
    options.folder = folder / "modes";
    REQUIRE(engine::modes(scene, options, out, err) == engine::success);
    const io::History table = io::read_history(options.folder / "modes.csv");
    REQUIRE(table.rows() == std::size_t(wanted));
    CHECK(test::count(out.str(), "\n") == std::size_t(wanted) + 3);
    const ResultsFolder results{options.folder};
    const auto frames = results.frames("modes");
    REQUIRE(frames.size() == std::size_t(wanted));
    const auto shape = results.open(frames[0]).read<double>("VTKHDF/PointData/mode_shape");
    double largest = 0;
    for (const double x : shape) largest = std::max(largest, std::abs(x));
    CHECK(largest == 1);
    const auto column = table.column("frequency");
    return {column.begin(), column.end()};
}

}  // namespace

TEST_CASE("modes of a scene's body: table, file, shapes; about its static state where it has one") {
    const std::vector<double> free_swing = frequencies(with(beam, "[time]", "gravity = [0.0, 0.0]\n[time]"), 3);
    // A clamped beam, Bernoulli, plane strain: f = 0.5596/L² sqrt(E I/(ρ A (1 - ν²))), less some for its thickness
    const double bending = 0.5596 * std::sqrt(1e7 * 0.01 / 12 / 1000 / (1 - 0.09));
    CHECK(free_swing[0] == doctest::Approx(bending).epsilon(0.02));
    CHECK(free_swing[1] > 5 * free_swing[0]);
    const std::string pulled =
        with(with(beam, "[time]", "gravity = [0.0, 0.0]\n[time]"), "[solid.scheme]\nstep = 0.001",
             "[[solid.traction]]\nsurface = \"right\"\nvalue = [2.0e5, 0.0]\n[solid.scheme]\nname = "
             "\"static\"");
    CHECK(frequencies(pulled, 1)[0] > 1.2 * free_swing[0]);
}

TEST_CASE("modes of the body of a coupled scene are those of the dry body; more than there are is refused") {
    CHECK(frequencies(gate, 1)[0] > 1);
    ScratchFolder folder;
    std::ostringstream out, err;
    CHECK_THROWS_WITH_AS(engine::modes(io::read_scene(folder.write("scene.toml", column)), {}, out, err),
                         doctest::Contains("no body in this scene"), io::SceneError);
    engine::ModesOptions many;
    many.count = 5000;
    CHECK_THROWS_WITH_AS(engine::modes(io::read_scene(folder.write("scene.toml", beam)), many, out, err),
                         doctest::Contains("not 5000"), io::SceneError);
}

TEST_CASE("a scene's body as a deck for CalculiX") {
    ScratchFolder folder;
    const std::string text = beam + "[[solid.track]]\nname = \"tip\"\npoint = [1.0, 0.1]\n";
    std::ostringstream out;
    engine::export_calculix(io::read_scene(folder.write("scene.toml", text)), folder / "beam.inp", {}, out);
    const std::string deck = contents(folder / "beam.inp");
    for (const char* part : {"*ELEMENT, ELSET=BODY, TYPE=CPE8R\n", "*ELASTIC\n10000000, ", "*DENSITY\n1000\n",
                             "*STEP, INC=1000000, NLGEOM\n*DYNAMIC, DIRECT, ALPHA=", "BODY, GRAV, 9.81", "*END STEP"})
        CHECK(deck.find(part) != std::string::npos);
    CHECK(out.str().find("track tip is node") != std::string::npos);
    CHECK_THROWS_WITH_AS(
        engine::export_calculix(io::read_scene(folder.write("scene.toml", gate)), folder / "x", {}, out),
        doctest::Contains("without water"), io::SceneError);
}
