// Probes of a scene: their columns, and values that are known.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// Still water, 1 m deep and 1 m wide.
const std::string tank = R"(schema_version = 1
title = "Tank"
[time]
end = 0.02
[domain]
min = [-0.5, -0.5]
max = [1.5, 1.5]
[fluid]
spacing = 0.05
sound_speed = 40
[[fluid.box]]
min = [0, 0]
max = [1, 1]
[[wall]]
name = "basin"
points = [[0, 1.5], [0, 0], [1, 0], [1, 1.5]]
[[probe]]
name = "inside"
quantity = "pressure"
point = [0.52, 0.4]
[[probe]]
name = "floor"
quantity = "pressure"
point = [0.5, 0.01]
wall = "basin"
interpolation = "linear"
[[probe]]
name = "middle"
quantity = "velocity"
point = [0.5, 0.5]
[[probe]]
name = "surface"
quantity = "level"
point = [0.5, 0]
[[probe]]
name = "shore"
quantity = "level"
point = [1, 0]
[[probe]]
name = "air"
quantity = "pressure"
point = [0.5, 1.4]
[output]
history_interval = 0.005
)";

const std::string falling = falling_block + R"([[probe]]
name = "heart"
quantity = "velocity"
point = [0.25, 0.2, 0.15]
[[probe]]
name = "top"
quantity = "level"
point = [0.25, 0.2, -1]
)";

}  // namespace

TEST_CASE("probes in still water") {
    const Finished run(tank);
    REQUIRE(run.code == engine::success);
    const std::string csv = contents(run.results.path / "history.csv");
    const std::string header = csv.substr(0, csv.find('\n'));
    CHECK(
        header.ends_with(",inside_pressure[Pa],floor_pressure[Pa],middle_velocity_x[m/s],middle_velocity_y[m/s],"
                         "surface_level[m],shore_level[m],air_pressure[Pa]"));
    const io::History history = run.results.history();
    // Tait's water is a little denser at depth than ρ0: 0.3 % at this sound speed.
    for (std::size_t row = 0; row < history.rows(); ++row) {
        CAPTURE(row);
        CHECK(history.column("inside_pressure")[row] == doctest::Approx(9810 * 0.6).epsilon(0.02));
        CHECK(history.column("floor_pressure")[row] == doctest::Approx(9810).epsilon(0.02));
        CHECK(std::fabs(history.column("middle_velocity_x")[row]) < 0.01);
        CHECK(std::fabs(history.column("middle_velocity_y")[row]) < 0.01);
        CHECK(std::fabs(history.column("surface_level")[row] - 1) < 0.05 * 0.05);
        CHECK(std::fabs(history.column("shore_level")[row] - 1) < 0.1 * 0.05);
        CHECK(history.column("air_pressure")[row] == 0);
    }
    // At the start pressures are exact but for the curvature that compressibility gives them.
    CHECK(history.column("floor_pressure")[0] == doctest::Approx(9810).epsilon(0.005));
}

TEST_CASE("probes in falling water") {
    const Finished run(falling);
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    for (std::size_t row = 0; row < history.rows(); ++row) {
        const double t = history.time()[row];
        CHECK(history.column("heart_velocity_z")[row] == doctest::Approx(-9.81 * t).epsilon(1e-10));
        CHECK(std::fabs(history.column("heart_velocity_x")[row]) < 1e-12);
        CHECK(std::fabs(history.column("top_level")[row] - (0.3 - 0.5 * 9.81 * t * t)) < 0.03 * 0.05);
    }
    CHECK(run.results.summary().at("tasks").contains("probes"));
    CHECK(run.results.summary().at("scene").at("probe")[0].at("quantity") == "velocity");
}

TEST_CASE("probes have the same bits on 1, 2 and 4 threads") {
    for (const std::string& text : {tank, falling}) {
        const std::string reference = history_text(text, 1);
        CHECK(history_text(text, 2) == reference);
        CHECK(history_text(text, 4) == reference);
    }
}

TEST_CASE("a scene without probes has no task for them") {
    CHECK_FALSE(Finished(falling_block).results.summary().at("tasks").contains("probes"));
}

TEST_CASE("probes that cannot be are refused with their place") {
    const auto says = [&](const std::string& text, std::string_view place, std::string_view what) {
        const std::string error = refusal_by([&] { Finished run(text); });
        CAPTURE(error);
        CHECK(error.find(place) != std::string::npos);
        CHECK(error.find(what) != std::string::npos);
    };
    says(with(tank, "point = [0.5, 0.01]", "point = [0.5, 0.1]"), "scene.toml:24:", "0.1 m away from wall 'basin'");
    says(with(tank, "wall = \"basin\"", "wall = \"bassin\""), "scene.toml:25:", "did you mean \"basin\"?");
    says(with(tank, "quantity = \"level\"\n", "quantity = \"level\"\nwall = \"basin\"\n"),
         "scene.toml:34:", "a level has no `wall`");
    says(with(tank, "name = \"air\"", "name = \"floor\""), "scene.toml:40:", "already taken");
    says(with(tank, "quantity = \"velocity\"", "quantity = \"speed\""), "scene.toml:29:", "`quantity` must be one of");
    says(with(tank, "point = [0.5, 0.5]", "point = [0.5, 0.5, 0]"), "scene.toml:30:", "3 coordinates");
}
