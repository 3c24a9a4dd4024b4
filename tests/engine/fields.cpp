// Initial fields, columns that sum over the water, comparisons with formulas, the central force: whole small runs
// against closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/model.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// A square of water that flies freely; 100 particles.
const std::string patch = R"scene(schema_version = 1
gravity = [0, 0]
[constants]
U = 0.2
L = 1
k = "pi/L"
[time]
end = 0.05
[domain]
min = [-2, -2]
max = [3, 3]
[fluid]
spacing = 0.1
sound_speed = 10
[[fluid.box]]
min = [0, 0]
max = [1, 1]
)scene";

io::Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const ScratchFolder folder;
    return io::read_scene(folder.write("scene.toml", text), overrides);
}

double value(const io::History& history, const std::string& column, std::size_t row = 0) {
    return history.column(column)[row];
}

}  // namespace

TEST_CASE("water starts with the fields that the formulas say") {
    const auto model = engine::make_model<2>(
        scene_of(patch + "[fluid.initial]\nvelocity = [\"U*sin(k*x)\", \"-U*y\"]\npressure = \"100*cos(k*y) - 50\"\n"));
    const auto& s = model->fluid->particles;
    REQUIRE(s.count == 100);
    for (std::size_t i = 0; i < s.count; ++i) {
        const double x = s.x[0][i], y = s.x[1][i];
        CHECK(s.v[0][i] == doctest::Approx(0.2 * std::sin(M_PI * x)).epsilon(1e-14));
        CHECK(s.v[1][i] == doctest::Approx(-0.2 * y).epsilon(1e-14));
        CHECK(s.p[i] == doctest::Approx(100 * std::cos(M_PI * y) - 50).epsilon(1e-9));
        CHECK(s.mass[i] == doctest::Approx((1000 + s.deviation[i]) * 0.01).epsilon(1e-14));
        CHECK(s.volume[i] == doctest::Approx(0.01).epsilon(1e-14));
    }
}

TEST_CASE("a field that is no number somewhere, or no pressure that water can have, is refused with the place") {
    for (const auto& [line, says] :
         {std::pair{"pressure = \"100/(x - 0.25)^2/(x < 0.3 && x > 0.2 ? 0 : 1)\"", "(0.25,"},
          std::pair{"velocity = [\"sqrt(x - 0.5)\", \"0\"]", "(0.05,"},
          std::pair{"pressure = \"-1e7\"", "stay above"}}) {
        try {
            engine::make_model<2>(scene_of(patch + "[fluid.initial]\n" + line + "\n"));
            FAIL("accepted: ", line);
        } catch (const io::SceneError& error) {
            CHECK(std::string(error.what()).find(says) != std::string::npos);
            CHECK(error.complaints()[0].position.line == count(patch, "\n") + 2);
        }
    }
}

TEST_CASE("integrals, means and extremes are what they are in closed form") {
    const Finished run(patch + R"scene([fluid.initial]
velocity = ["U", "0"]
[[integral]]
name = "mass"
value = "rho"
unit = "kg/m"
[[integral]]
name = "kinetic"
value = "0.5*rho*(vx^2 + vy^2)"
[[integral]]
name = "centre"
value = "x"
weight = "rho"
[[extreme]]
name = "front"
value = "x"
[[extreme]]
name = "back"
value = "x"
of = "smallest"
where = "y > 0.5"
[[extreme]]
name = "nobody"
value = "x"
where = "x > 100"
)scene");
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    CHECK(value(history, "mass") == doctest::Approx(1000).epsilon(1e-13));
    CHECK(value(history, "kinetic") == doctest::Approx(20).epsilon(1e-13));
    CHECK(value(history, "kinetic") == doctest::Approx(value(history, "fluid_kinetic_energy")).epsilon(1e-13));
    const std::size_t last = history.rows() - 1;
    // Uniform motion: everything moves by U t.
    CHECK(value(history, "centre", last) == doctest::Approx(0.5 + 0.2 * 0.05).epsilon(1e-12));
    CHECK(value(history, "front", last) == doctest::Approx(0.95 + 0.2 * 0.05).epsilon(1e-12));
    CHECK(value(history, "back", last) == doctest::Approx(0.05 + 0.2 * 0.05).epsilon(1e-12));
    CHECK(std::isnan(value(history, "nobody", last)));
    CHECK(history.columns[*history.find("mass")].unit == "kg/m");
}

TEST_CASE("the error of a field is its L2 norm by mass over that of the known field") {
    const Finished run(patch + R"scene([fluid.initial]
velocity = ["U", "0"]
[[field_error]]
name = "right"
velocity = ["U", "0"]
[[field_error]]
name = "off"
velocity = ["U", "U/2"]
pressure = "x > 0.5 ? 3 : 0"
pressure_scale = 6
[[field_error]]
name = "left_half"
pressure = "4"
where = "x < 0.5"
[[compare]]
column = "right_velocity_error"
formula = "0"
scale = 1
label = "exact"
)scene");
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    CHECK(value(history, "right_velocity_error") == 0);
    CHECK(value(history, "off_velocity_error") == doctest::Approx(0.5 / std::sqrt(1.25)).epsilon(1e-12));
    CHECK(value(history, "off_pressure_error") == doctest::Approx(std::sqrt(4.5) / 6).epsilon(1e-12));
    CHECK(value(history, "left_half_pressure_error") == doctest::Approx(1).epsilon(1e-12));
    const auto comparison = run.results.summary().at("comparisons").at(0);
    CHECK(comparison.at("rms").get<double>() < 1e-12);
    CHECK(comparison.at("formula") == "0");
}

TEST_CASE("under a central force the centre of mass is a harmonic oscillator, whatever the water does") {
    const Finished run(with(patch, "end = 0.05", "end = 0.5") + R"scene([fluid.central_force]
centre = [0.4, 0.5]
rate = 2
[[integral]]
name = "centre"
value = "x"
weight = "rho"
unit = "m"
[[compare]]
column = "centre"
formula = "0.4 + 0.1*cos(2*t)"
label = "oscillator"
[output]
history_interval = 0.01
)scene");
    REQUIRE(run.code == engine::success);
    const auto summary = run.results.summary();
    const auto comparison = summary.at("comparisons").at(0);
    CHECK(comparison.at("points") == 1001);
    // What is left is the comparison's interpolation between rows, (0.01)²/8 of the second derivative.
    CHECK(comparison.at("largest_error").get<double>() < 2e-5);
    const io::History history = run.results.history();
    const std::size_t last = history.rows() - 1;
    CHECK(value(history, "centre", last) == doctest::Approx(0.4 + 0.1 * std::cos(1.0)).epsilon(1e-6));
    // ½ m Ω² (x² + y²) of a unit square about the centre, and of its offset; on 10 × 10 points.
    CHECK(value(history, "fluid_potential_energy") ==
          doctest::Approx(0.5 * 1000 * 4 * (2 * (1 - 0.01) / 12 + 0.01)).epsilon(1e-12));
}

TEST_CASE("a driving force accelerates all water alike") {
    const Finished run(with(patch, "sound_speed = 10", "sound_speed = 10\ndriving_force = [0.5, -1]") +
                       "[[integral]]\nname = \"u\"\nvalue = \"vx - 2*vy\"\nweight = \"1\"\n");
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    CHECK(value(history, "u", history.rows() - 1) == doctest::Approx(0.05 * 2.5).epsilon(1e-12));
    CHECK(value(history, "fastest_particle", history.rows() - 1) ==
          doctest::Approx(0.05 * std::sqrt(1.25)).epsilon(1e-12));
}

TEST_CASE("a column may not have the name of another") {
    for (const char* name : {"time", "fluid_kinetic_energy"}) {
        const ScratchFolder folder;
        const io::Scene scene = scene_of(patch + "[[integral]]\nname = \"" + name + "\"\nvalue = \"1\"\n");
        std::ostringstream out;
        CHECK_THROWS_AS(
            engine::run(scene, {.folder = folder / "results", .trace = {}, .threads = 2, .quiet = true}, out, out),
            io::SceneError);
    }
}

TEST_CASE("an override is as if the file had said so, and the summary says it") {
    const ScratchFolder folder;
    const std::vector<std::string> overrides{"fluid.spacing=0.2", "fluid.scheme.reconstruction=none",
                                             "constants.U=0.3"};
    const io::Scene scene =
        io::read_scene(folder.write("scene.toml", patch + "[fluid.initial]\nvelocity = [\"U\", \"0\"]\n"), overrides);
    std::ostringstream out;
    REQUIRE(engine::run(scene, {.folder = folder / "results", .trace = {}, .threads = 2, .quiet = true}, out, out) ==
            engine::success);
    const auto summary = ResultsFolder{folder / "results"}.summary();
    CHECK(summary.at("particles") == 25);
    CHECK(summary.at("scene").at("fluid").at("scheme").at("reconstruction") == "none");
    CHECK(summary.at("scene").at("constants").at("U") == 0.3);
    CHECK(summary.at("scene_file").at("set") == overrides);
}
