// Bodies of water in a scene: how they are filled, and where water cannot be.
#include <doctest/doctest.h>

#include <numbers>

#include "engine/check.hpp"
#include "physics/geometry/shapes.hpp"
#include "tests/engine/model_run.hpp"
#include "tests/io/stl_writer.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

const std::string pond = R"(schema_version = 1
[time]
end = 0.01
[domain]
min = [-1.0, -1.0]
max = [2.0, 2.0]
[fluid]
spacing = 0.02
sound_speed = 20.0
[[fluid.polygon]]
points = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.5, 0.2], [0.5, 0.4], [0.0, 0.4]]
[[fluid.disc]]
centre = [0.8, 0.6]
radius = 0.1
velocity = [0.0, -1.0]
[[wall]]
name = "tank"
points = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
)";

std::string refusal_when_built(const std::string& text) {
    return refusal_by([&] { Built built(text); });
}

void refused(const std::string& text, std::string_view place, std::string_view message) {
    const std::string what = refusal_when_built(text);
    CAPTURE(what);
    CHECK(what.find(place) != std::string::npos);
    CHECK(what.find(message) != std::string::npos);
}

}  // namespace

TEST_CASE("a pond and a drop") {
    const Built built(pond);
    const auto& s = built.model->fluid->particles;
    REQUIRE(built.model->water.size() == 2);
    CHECK(built.model->water[0].particles == 750);
    CHECK(built.model->water[0].filled == Approx(0.3));
    CHECK(built.model->water[1].volume == Approx(std::numbers::pi * 0.01).epsilon(0.01));
    for (std::size_t i = 0; i < s.count; ++i) {
        const bool drop = i >= 750;
        CHECK(s.v[1][i] == (drop ? -1 : 0));
        CHECK(s.p[i] == Approx(drop ? 0 : 9810 * (0.4 - s.x[1][i])).epsilon(0.02));
    }
    std::ostringstream out;
    engine::check(built.scene, 1, out);
    CHECK(out.str().find("fluid.polygon[0]: 750 particles, 0.3 of 0.3, ") != std::string::npos);
    const Finished run(pond);
    CHECK(run.code == engine::success);
    CHECK(run.results.summary()["water"][0]["particles"] == 750);
}

TEST_CASE("relaxed water in a round tank") {
    const std::string round = R"(schema_version = 1
[time]
end = 0.3
[domain]
min = [-1.0, -1.0]
max = [1.0, 1.0]
[fluid]
spacing = 0.025
sound_speed = 20.0
relax = true
[[fluid.disc]]
centre = [0.0, 0.0]
radius = 0.3
level = 0.0
initial_pressure = "hydrostatic"
[[wall]]
name = "tank"
[wall.circle]
centre = [0.0, 0.0]
radius = 0.3
fluid = "inside"
)";
    const Finished run(round);
    CHECK(run.code == engine::success);
    CAPTURE(run.err.str());
    const auto water = run.results.summary()["water"][0];
    CHECK(water["filled_volume"].get<double>() == Approx(water["volume"].get<double>()).epsilon(1e-12));
    const double before = water["relaxation"]["kernel_sum_deviation_before"],
                 after = water["relaxation"]["kernel_sum_deviation_after"];
    CHECK(after < before / 5);
    CHECK(run.results.summary()["particles"] == water["particles"]);
    // Still water stays nearly still: kinetic energy after 0.3 s, against the energy of a fall by the radius.
    const auto history = run.results.history();
    MESSAGE("kinetic energy at the end ", history.column("fluid_kinetic_energy").back());
    CHECK(history.column("fluid_kinetic_energy").back() < 1e-4 * 1000 * std::numbers::pi * 0.09 / 2 * 9.81 * 0.3);
}

TEST_CASE("water where it cannot be") {
    refused(with(pond, "centre = [0.8, 0.6]", "centre = [0.8, 0.25]"), "scene.toml:12:1",
            "two bodies of water overlap");
    refused(with(pond, "centre = [0.8, 0.6]", "centre = [1.05, 0.6]"), "scene.toml:16:1",
            "water on the wrong side of wall 'tank'");
    refused(with(pond, "[[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]",
                 "[[1.0, 1.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]]"),
            "scene.toml:16:1", "wrong side of wall 'tank'");
    const std::string pillar = pond + R"([[wall]]
name = "pillar"
[wall.circle]
centre = [0.3, 0.2]
radius = 0.08
fluid = "outside"
)";
    refused(pillar, "scene.toml:19:1", "wrong side of wall 'pillar': a particle of fluid.polygon[0]");
    CHECK(refusal_when_built(with(pillar, "centre = [0.3, 0.2]", "centre = [0.2, 0.8]")) == "");
    refused(with(pond, "radius = 0.1", "radius = 0.005"), "scene.toml:12:1", "too thin for a single particle");
}

TEST_CASE("an STL tank filled by an STL body of water") {
    const std::string text = R"(schema_version = 1
[time]
end = 0.01
[domain]
min = [-1.0, -1.0, -1.0]
max = [2.0, 2.0, 2.0]
[fluid]
spacing = 0.1
sound_speed = 20.0
support_ratio = 2.5
[[fluid.volume]]
stl = "tank.stl"
scale = 0.001
level = 0.3
[[wall]]
name = "tank"
[wall.stl]
file = "tank.stl"
scale = 0.001
fluid = "inside"
)";
    ScratchFolder folder;
    const auto tank =
        geometry::box<3>(geometry::Vec<3>(0, 0, 0), geometry::Vec<3>(600, 500, 400), geometry::FluidSide::outside);
    folder.write("tank.stl", binary_stl(tank, "in millimetres"));
    const io::Scene scene = io::read_scene(folder.write("scene.toml", text));
    const auto model = engine::make_model<3>(scene);
    CHECK(model->fluid->particles.count == 6 * 5 * 3);
    CHECK(model->water[0].volume == Approx(0.09));
    CHECK(model->walls->panels.size() == 12);
    // The file's triangles look outwards; the wall's look at the water.
    for (std::size_t k = 0; k < 12; ++k)
        CHECK(model->walls->panels.normal[k].dot(geometry::Vec<3>(0.3, 0.25, 0.2) - model->walls->panels.centroid[k]) >
              0);
}
