// Bodies and walls that begin away from the water are named, with a gap that is known in closed form.
#include "engine/dry_start.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/check.hpp"
#include "tests/engine/results_of_run.hpp"
#include "tests/engine/scenes.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

template <int D>
struct Said {
    std::vector<engine::DryStart<D>> dry;
    std::vector<std::string> texts;

    explicit Said(const std::string& text) {
        const ScratchFolder folder;
        const io::Scene scene = io::read_scene(folder.write("scene.toml", text));
        const auto model = engine::make_model<D>(scene);
        dry = engine::dry_starts(scene, *model);
        for (const engine::DryStart<D>& one : dry) texts.push_back(engine::text_of(one, *model));
    }
    bool has(std::size_t k, const char* part) const { return texts[k].find(part) != std::string::npos; }
};

// The gate of 5 by 79 mm at another place.
std::string gate_between(const std::string& low, const std::string& high) {
    std::string box = "min = [";
    box += low;
    box += "]\nmax = [";
    box += high;
    return with(gate, "min = [0.1, 0.0]\nmax = [0.105, 0.079]", box + "]");
}

std::string with_plate(const std::string& corners, const char* more = "force = true") {
    return falling_block + "[[wall]]\nname = \"plate\"\npoints = " + corners + "\n" + more + "\n";
}

}  // namespace

TEST_CASE("an elastic body away from the water is named with its gap to the nearest particle") {
    // Particles stand half a spacing of 5 mm inside the water, which ends at x = 0.1, y = 0.14.
    const Said<2> beside(gate_between("0.3, 0.0", "0.305, 0.079"));
    REQUIRE(beside.dry.size() == 1);
    CHECK(beside.dry[0].elastic);
    CHECK(beside.dry[0].gap == Approx(0.3 - 0.0975).epsilon(1e-12));
    CHECK(beside.has(0, "the wet surface of 'gate' begins away from the water"));
    CHECK(beside.has(0, "is 0.2025 m away, and R is 0.02 m"));
    const Said<2> across(gate_between("0.3, 0.2", "0.305, 0.279"));
    REQUIRE(across.dry.size() == 1);
    REQUIRE(across.dry[0].particle);
    CHECK(across.dry[0].gap == Approx(std::hypot(0.3 - 0.0975, 0.2 - 0.1375)).epsilon(1e-12));
    CHECK(((*across.dry[0].particle) - fluid::Vec2(0.0975, 0.1375)).norm() < 1e-12);
}

TEST_CASE("a body within R of the water is not away from it") {
    CHECK(Said<2>(gate).dry.empty());
    CHECK(Said<2>(plate).dry.empty());
    CHECK(Said<2>(strip).dry.empty());
    CHECK(Said<2>(gate_between("0.1174, 0.0", "0.1224, 0.079")).dry.empty());
    CHECK(Said<2>(gate_between("0.1176, 0.0", "0.1226, 0.079")).dry.size() == 1);
}

TEST_CASE("a wet surface that turns its back on all water has none in front") {
    const std::string low = with(gate, "max = [0.1, 0.14]", "max = [0.1, 0.07]");
    CHECK(Said<2>(low).dry.empty());
    const Said<2> turned(with(low, "\"left\", \"bottom\", \"right\"", "\"right\""));
    REQUIRE(turned.dry.size() == 1);
    CHECK_FALSE(turned.dry[0].particle);
    CHECK(turned.has(0, "no water lies in front of the wet surface of 'gate'"));
    CHECK(turned.has(0, "`wet`"));
}

TEST_CASE("walls that move or whose force is asked for are named where they begin dry, others are not") {
    CHECK(Said<2>(piston_channel).dry.empty());
    const std::string far_piston = with(piston_channel, "[[0.0, 0.5], [0.0, 0.0]]", "[[-0.2, 0.5], [-0.2, 0.0]]");
    const Said<2> moving(far_piston);
    REQUIRE(moving.dry.size() == 1);
    CHECK_FALSE(moving.dry[0].elastic);
    CHECK(moving.dry[0].gap == Approx(0.21).epsilon(1e-12));
    CHECK(moving.has(0, "wall 'piston' begins away from the water"));

    CHECK(Said<2>(walled_basin).dry.empty());
    const std::string far_east = with(walled_basin, "[[1, 0], [1, 1.5]]", "[[1.5, 0], [1.5, 1.5]]");
    const Said<2> measured(far_east);
    REQUIRE(measured.dry.size() == 1);
    CHECK(measured.has(0, "wall 'east'"));
    CHECK(measured.dry[0].gap == Approx(1.5 - 0.975).epsilon(1e-12));
    CHECK(Said<2>(far_east.substr(0, far_east.rfind("force = true"))).dry.empty());
    CHECK(Said<2>(with(far_east, "sound_speed = 40", "sound_speed = 40\nwalls = \"normal_flux\"")).dry.size() == 1);
}

TEST_CASE("in a periodic domain water is as near as its nearest image") {
    const std::string channel = R"(schema_version = 1
[time]
end = 0.02
[domain]
min = [-0.5, -0.1]
max = [1.5, 0.6]
periodic = ["x"]
[fluid]
spacing = 0.02
sound_speed = 20.0
[[fluid.box]]
min = [0.0, 0.0]
max = [0.3, 0.2]
[[wall]]
name = "floor"
points = [[-0.5, 0.0], [1.5, 0.0]]
[[wall]]
name = "gauge"
points = [[1.4, 0.5], [1.4, 0.0]]
force = true
)";
    const Said<2> periodic(channel), plain(with(channel, "periodic = [\"x\"]\n", ""));
    REQUIRE(periodic.dry.size() == 1);
    CHECK(periodic.dry[0].gap == Approx(2.01 - 1.4).epsilon(1e-12));
    REQUIRE(plain.dry.size() == 1);
    CHECK_FALSE(plain.dry[0].particle);  // the gauge looks the other way
}

TEST_CASE("in space") {
    // The block's particles begin at z = 0.025 and end at x = 0.475; R is 0.13 m.
    const Said<3> below(with_plate("[[0, 0, -0.5], [0.5, 0, -0.5], [0.5, 0.4, -0.5], [0, 0.4, -0.5]]"));
    REQUIRE(below.dry.size() == 1);
    CHECK(below.dry[0].gap == Approx(0.525).epsilon(1e-12));
    CHECK(below.has(0, "wall 'plate'"));
    const std::string beside = "[[1, 0, -0.5], [1.5, 0, -0.5], [1.5, 0.4, -0.5], [1, 0.4, -0.5]]";
    const Said<3> across(with_plate(beside));
    REQUIRE(across.dry.size() == 1);
    REQUIRE(across.dry[0].particle);
    CHECK(across.dry[0].gap == Approx(std::hypot(1 - 0.475, 0.525)).epsilon(1e-12));
    CHECK((*across.dry[0].particle)[2] == Approx(0.025));
    CHECK(Said<3>(with_plate("[[0, 0, -0.1], [0.5, 0, -0.1], [0.5, 0.4, -0.1], [0, 0.4, -0.1]]")).dry.empty());
    CHECK(Said<3>(with_plate("[[0, 0, -0.11], [0.5, 0, -0.11], [0.5, 0.4, -0.11], [0, 0.4, -0.11]]")).dry.size() == 1);
    CHECK(Said<3>(with_plate(beside, "")).dry.empty());
}

TEST_CASE("check and the start of a run say it once, and the run goes on") {
    const std::string far = with(gate_between("0.3, 0.0", "0.305, 0.079"), "end = 0.02", "end = 0.001");
    const auto times_said = [](const std::string& text) { return count(text, "begins away from the water"); };
    {
        const ScratchFolder folder;
        std::ostringstream out;
        engine::check(io::read_scene(folder.write("scene.toml", far)), 1, out);
        CHECK(times_said(out.str()) == 1);
        CHECK(out.str().find("warning    the wet surface of 'gate' begins") != std::string::npos);
    }
    const Finished run(far, 1);
    CHECK(run.code == engine::success);
    CHECK(times_said(run.err.str()) == 1);
    CHECK(run.err.str().find("aquagraph: warning: the wet surface of 'gate' begins") != std::string::npos);
    const Finished in_space(with(with_plate("[[0, 0, -0.5], [0.5, 0, -0.5], [0.5, 0.4, -0.5], [0, 0.4, -0.5]]"),
                                 "end = 0.05", "end = 0.002"),
                            1);
    CHECK(in_space.code == engine::success);
    CHECK(times_said(in_space.err.str()) == 1);
}
