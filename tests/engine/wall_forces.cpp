// Forces on named walls: the weight of still water, the balance of momentum, and no influence on the run.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/model.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/rebuild.hpp"
#include "physics/fluid/walls/wall_forces.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// Half a metre cubed.
const std::string tank_in_space = R"(schema_version = 1
[time]
end = 0.01
[domain]
min = [-0.5, -0.5, -0.5]
max = [1.5, 1.5, 1.5]
[fluid]
spacing = 0.05
sound_speed = 30
support_ratio = 2.6
[[fluid.box]]
min = [0, 0, 0]
max = [0.5, 0.5, 0.5]
[[wall]]
name = "bottom"
points = [[0, 0, 0], [0.5, 0, 0], [0.5, 0.5, 0], [0, 0.5, 0]]
force = true
[[wall]]
name = "west"
points = [[0, 0, 0], [0, 0.5, 0], [0, 0.5, 0.8], [0, 0, 0.8]]
force = true
[[wall]]
name = "east"
points = [[0.5, 0, 0], [0.5, 0, 0.8], [0.5, 0.5, 0.8], [0.5, 0.5, 0]]
force = true
[[wall]]
name = "south"
points = [[0, 0, 0], [0, 0, 0.8], [0.5, 0, 0.8], [0.5, 0, 0]]
force = true
[[wall]]
name = "north"
points = [[0, 0.5, 0], [0.5, 0.5, 0], [0.5, 0.5, 0.8], [0, 0.5, 0.8]]
force = true
)";

// Forces of all walls, weight and rate of momentum of disordered, moving water: what is left over of the largest term.
template <int D>
double residual(const std::string& text) {
    ScratchFolder folder;
    const io::Scene scene = io::read_scene(folder.write("scene.toml", text));
    const auto model = engine::make_model<D>(scene);
    auto& fluid = *model->fluid;
    auto& walls = *model->walls;
    auto& s = fluid.particles;
    double wobble = 0.3;
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t d = 0; d < D; ++d) {
            wobble = std::fmod(997 * wobble + 0.1, 1.0);
            s.x[d][i] += 0.3 * fluid.spacing * (wobble - 0.5);
            s.v[d][i] = 2 * (wobble - 0.5);
        }
    rebuild_lists(fluid, &walls, serial_loop);
    fluid::Vec<D> gravity;
    for (int d = 0; d < D; ++d) gravity[d] = fluid.flux.gravity[d];
    for (std::size_t b = 0; b < walls.blocks(); ++b) walls.update_state(s, gravity, b);
    for (std::size_t b = 0; b < fluid.blocks(); ++b) compute_gradients(s, fluid.lists, fluid.kernel, fluid.lanes(b));
    for (std::size_t b = 0; b < walls.blocks(); ++b) walls.update_gradients(s, gravity, b);
    for (std::size_t b = 0; b < fluid.blocks(); ++b)
        compute_fluxes(s, fluid.lists, fluid.kernel, fluid.flux, fluid.tait, fluid.lanes(b));
    if (fluid.viscosity.dynamic > 0)
        for (std::size_t b = 0; b < fluid.blocks(); ++b)
            add_viscosity(s, fluid.lists, fluid.kernel, fluid.viscosity, fluid.lanes(b));
    const fluid::Scalars before = s.acceleration[D - 1];
    fluid::Vec<D> sum = fluid::Vec<D>::Zero();
    double largest = 0;
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t d = 0; d < D; ++d) sum[int(d)] += s.mass[i] * (s.acceleration[d][i] - fluid.flux.gravity[d]);
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        fluid::WallForces<D> wall{int(w)};
        wall.rebuild(fluid, walls);
        for (std::size_t b = 0; b < wall.blocks(); ++b) wall.compute(fluid, b);
        sum += wall.force();
        largest = std::max(largest, wall.force().norm());
    }
    CHECK(s.acceleration[D - 1] == before);  // used as scratch and put back
    CHECK(largest > 100);
    return sum.norm() / largest;
}

}  // namespace

TEST_CASE("forces of all walls balance the fluid's rate of momentum") {
    CHECK(residual<2>(walled_basin) < 1e-12);
    CHECK(residual<3>(tank_in_space) < 1e-12);
    for (const std::string form : {"morris", "monaghan_gingold"}) {
        CAPTURE(form);
        const std::string viscous = "[fluid.viscosity]\ndynamic = 50\noperator = \"" + form + "\"\n[[fluid.box]]";
        CHECK(residual<2>(with(walled_basin, "[[fluid.box]]", viscous)) < 1e-12);
        CHECK(residual<3>(with(tank_in_space, "[[fluid.box]]", viscous)) < 1e-12);
    }
}

TEST_CASE("plates bear the friction of the water between them: µ dU/dy") {
    // Couette's straight line and Poiseuille's parabola, as they stand.
    const auto flowing = [](const std::string& velocity) {
        return with(with(plates, "end = 1.0", "end = 1e-6"), "[[fluid.box]]",
                    "[fluid.initial]\nvelocity = [\"" + velocity + "\", \"0\"]\n[[fluid.box]]");
    };
    const std::string line = with_upper_plate_at(flowing("0.001*y"), "0.001"), parabola = flowing("0.004*y*(1-y)"),
                      fine = with(parabola, "spacing = 0.05", "spacing = 0.025");
    const auto check = [](const std::string& text, double lower, double upper, double tolerance) {
        const Finished run(text);
        REQUIRE(run.code == engine::success);
        const io::History history = run.results.history();
        const double of_lower = history.column("lower_force_x")[0] / lower,
                     of_upper = history.column("upper_force_x")[0] / upper;
        MESSAGE("lower " << of_lower << ", upper " << of_upper);
        CHECK(std::fabs(of_lower - 1) < tolerance);
        CHECK(std::fabs(of_upper - 1) < tolerance);
    };
    check(line, 0.1, -0.1, 0.005);
    check(parabola, 0.4, 0.4, 0.04);
    check(fine, 0.4, 0.4, 0.01);
    // Monaghan and Gingold's operator is 4 % short of its viscosity on a lattice.
    check(with(line, "morris", "monaghan_gingold"), 0.1, -0.1, 0.05);
    check(with(fine, "morris", "monaghan_gingold"), 0.4, 0.4, 0.05);
}

TEST_CASE("still water rests with its weight on the bottom") {
    const Finished run(walled_basin);
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    const std::string csv = contents(run.results.path / "history.csv");
    CHECK(csv.substr(0, csv.find('\n'))
              .ends_with(",west_force_x[N/m],west_force_y[N/m],bottom_force_x[N/m],"
                         "bottom_force_y[N/m],east_force_x[N/m],east_force_y[N/m]"));
    const double weight = 9810;
    // The ghosts of the two corners are shared with the side walls.
    CHECK(history.column("bottom_force_y")[0] == doctest::Approx(-weight).epsilon(0.04));
    CHECK(history.column("west_force_x")[0] == doctest::Approx(-weight / 2).epsilon(0.06));
    CHECK(history.column("east_force_x")[0] == doctest::Approx(weight / 2).epsilon(0.06));
    // Lines of sight exactly through a corner go to one of its two walls, not half to each.
    CHECK(std::fabs(history.column("bottom_force_x")[0]) < 0.01 * weight);
    double mean = 0;
    for (const double force : history.column("bottom_force_y")) mean += force / double(history.rows());
    CHECK(mean == doctest::Approx(-weight).epsilon(0.04));
}

TEST_CASE("still water in space rests with its weight on the bottom") {
    const Finished run(tank_in_space);
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    CHECK(contents(run.results.path / "history.csv").find("bottom_force_z[N]") != std::string::npos);
    const double weight = 9810 * 0.125;
    CHECK(history.column("bottom_force_z")[0] == doctest::Approx(-weight).epsilon(0.08));
    CHECK(history.column("west_force_x")[0] == doctest::Approx(-weight / 2).epsilon(0.15));
    CHECK(history.column("east_force_x")[0] == doctest::Approx(weight / 2).epsilon(0.15));
    CHECK(history.column("south_force_y")[0] == doctest::Approx(-weight / 2).epsilon(0.15));
    CHECK(history.column("north_force_y")[0] == doctest::Approx(weight / 2).epsilon(0.15));
    CHECK(std::fabs(history.column("bottom_force_x")[0]) < 1e-2 * weight);
}

TEST_CASE("measuring forces changes nothing, and they have the same bits on 1, 2 and 4 threads") {
    std::string unmeasured = walled_basin;
    for (int wall = 0; wall < 3; ++wall) unmeasured = without(unmeasured, "force = true\n");
    const Finished with_forces(walled_basin), plain(unmeasured);
    const io::History a = with_forces.results.history(), b = plain.results.history();
    REQUIRE(a.rows() == b.rows());
    // The first row's sums run in another order: the particles have been sorted before it, not after it.
    for (std::size_t c = 0; c < b.columns.size(); ++c)
        for (std::size_t row = 1; row < b.rows(); ++row) CHECK(a.values[c][row] == b.values[c][row]);
    CHECK_FALSE(plain.results.summary().at("tasks").contains("wall forces"));
    for (const std::string& text : {walled_basin, tank_in_space}) {
        const std::string reference = history_text(text, 1);
        CHECK(history_text(text, 2) == reference);
        CHECK(history_text(text, 4) == reference);
    }
}
