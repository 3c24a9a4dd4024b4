// Walls that move by themselves, end to end: from the scene file through the listing of a step.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

// A closed box, half full.
const std::string tank = R"(schema_version = 1
[time]
end = 0.5
[domain]
min = [-1.0, -1.0]
max = [2.0, 2.0]
[fluid]
spacing = 0.025
sound_speed = 20.0
[[fluid.box]]
min = [0.0, 0.0]
max = [0.6, 0.2]
[[wall]]
name = "tank"
[wall.box]
min = [0.0, 0.0]
max = [0.6, 0.4]
fluid = "inside"
)";

}  // namespace

TEST_CASE("a piston pushes the water up to the height of the simple wave") {
    const ModelRun<2> run(piston_channel);
    const double place = 0.25 * (0.6 - 0.05);
    const auto& panels = run.model->walls->panels;
    CHECK(panels.position.back().x() == Approx(place));
    CHECK(panels.velocity.back().x() == Approx(0.25));
    REQUIRE(run.count() == 500);
    double highest = 0, leftmost = 1, momentum = 0;
    for (std::size_t i = 0; i < run.count(); ++i) {
        const auto x = run.x(i);
        leftmost = std::min(leftmost, x.x());
        momentum += run.model->fluid->particles.v[0][i];
        if (x.x() < place + 0.1) highest = std::max(highest, x.y());
    }
    // Shallow water, sqrt(g h) = sqrt(g h0) + u/2 at the piston.
    const double root = std::sqrt(9.81 * 0.2) + 0.125, depth = root * root / 9.81;
    MESSAGE("depth at the piston ", highest + 0.01, ", simple wave ", depth);
    CHECK(highest + 0.01 == Approx(depth).epsilon(0.06));
    CHECK(leftmost > place);
    CHECK(leftmost < place + 0.02);
    CHECK(momentum > 0);
}

TEST_CASE("a rolling tank keeps its water") {
    const std::string rolling = tank + R"([wall.motion.rotation]
centre = [0.3, 0.0]
amplitude = 0.2
period = 0.8
)";
    const ModelRun<2> run(rolling);
    const double angle = 0.2 * std::sin(2 * std::numbers::pi * 0.5 / 0.8);
    const Eigen::Rotation2Dd back(-angle);
    double left = 1, low = 1, high = 0;
    for (std::size_t i = 0; i < run.count(); ++i) {
        const Eigen::Vector2d x = back * (run.x(i) - Eigen::Vector2d(0.3, 0)) + Eigen::Vector2d(0.3, 0);
        left = std::min({left, x.x(), 0.6 - x.x()});
        low = std::min(low, x.y());
        high = std::max(high, x.y());
    }
    CHECK(run.count() == 192);
    CHECK(left > 0);
    CHECK(low > 0);
    CHECK(high > 0.2);
    CHECK(high < 0.4);
    CHECK(run.model->fluid->held_back == 0);
    // The whole program with the same scene: results, summary, report.
    const Finished finished(rolling);
    CHECK(finished.code == engine::success);
    CHECK(finished.results.summary()["scene"]["wall"][0]["motion"]["rotation"]["amplitude"] == 0.2);
    CHECK(finished.results.report().find("box, moves") != std::string::npos);
}

TEST_CASE("water carried along by a tank at constant velocity is at rest in it") {
    const auto moving = with(tank, "max = [0.6, 0.2]", "max = [0.6, 0.2]\nvelocity = [0.8, -0.3]") +
                        "[wall.motion.translation]\nvelocity = [0.8, -0.3]\n";
    const ModelRun<2> run(moving), rest(tank);
    REQUIRE(run.count() == rest.count());
    double worst = 0;
    std::vector<geometry::Vec<2>> place(rest.count());
    for (std::size_t i = 0; i < rest.count(); ++i) place[std::size_t(rest.model->fluid->particles.id[i])] = rest.x(i);
    for (std::size_t i = 0; i < run.count(); ++i) {
        const auto id = std::size_t(run.model->fluid->particles.id[i]);
        worst = std::max(worst, (run.x(i) - geometry::Vec<2>(0.4, -0.15) - place[id]).norm());
    }
    MESSAGE("largest difference between the tank in motion and the tank at rest: ", worst, " m");
    CHECK(worst < 1e-4);
}

TEST_CASE("in three dimensions too, along a table") {
    const std::string scene = R"(schema_version = 1
[time]
end = 0.1
[domain]
min = [-1.0, -1.0, -1.0]
max = [2.0, 2.0, 2.0]
[fluid]
spacing = 0.05
sound_speed = 20.0
support_ratio = 3.0
[[fluid.box]]
min = [0.0, 0.0, 0.0]
max = [0.4, 0.3, 0.2]
velocity = [0.5, 0.25, 0.0]
[[wall]]
name = "tank"
[wall.box]
min = [0.0, 0.0, 0.0]
max = [0.4, 0.3, 0.4]
fluid = "inside"
open = ["top"]
[wall.motion]
table = "motion.csv"
)";
    const ModelRun<3> run(
        scene, {{"motion.csv", "# of the tank\ntime[s], x[m], y\n-1, -0.5, -0.25\n0, 0, 0\n0.3, 0.15, 0.075\n"}});
    REQUIRE(run.count() == 8 * 6 * 4);
    for (std::size_t i = 0; i < run.count(); ++i) {
        const geometry::Vec<3> x = run.x(i) - geometry::Vec<3>(0.05, 0.025, 0);
        CHECK((x.array() > 0).all());
        CHECK(std::fabs(run.model->fluid->particles.v[0][i] - 0.5) < 0.1);
    }
    const FilesBeside short_table{{"motion.csv", "time, x\n0, 0\n0.05, 1\n"}};
    CHECK_THROWS_WITH_AS(ModelRun<3>(scene, short_table),
                         doctest::Contains("the table ends at 0.05 s, before the end of the run at 0.1 s"),
                         io::SceneError);
}

TEST_CASE("a wall that does not move is in no task") {
    const Built still(tank);
    CHECK(!still.has("wall motion (stage 1)"));
    const Built moving(tank + "[wall.motion.translation]\nvelocity = [1.0, 0.0]\n");
    CHECK(moving.has("wall motion (stage 1)"));
}
