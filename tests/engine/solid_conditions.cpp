// What moves, presses and holds a body on its own, as scenes ask for it: against closed forms, and the columns that
// show it.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/body_scenes.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// A block of 0.2 m by 0.1 m of unit depth.
std::string block(const std::string& scheme, const std::string& gravity, const std::string& end) {
    return elastic_box({.corner = "0.2, 0.1",
                        .elements = "4, 2",
                        .end = end,
                        .gravity = gravity,
                        .poissons_ratio = "0.0",
                        .scheme = scheme});
}

// A run and the columns it has left.
class RunOfText {
  public:
    explicit RunOfText(const std::string& scene) : run_(scene) {
        INFO(run_.err.str());
        REQUIRE(run_.code == engine::success);
        history_ = run_.results.history();
    }
    bool has(const std::string& column) const { return history_.find(column).has_value(); }
    double last(const std::string& column) const { return history_.column(column).back(); }
    double largest(const std::string& column) const {
        const auto values = history_.column(column);
        return *std::max_element(values.begin(), values.end());
    }
    double at(double time, const std::string& column) const {
        for (std::size_t k = 0; k < history_.rows(); ++k)
            if (std::abs(history_.time()[k] - time) < 1e-9) return history_.column(column)[k];
        FAIL("there is no row at ", time);
        return 0;
    }

  private:
    Finished run_;
    io::History history_;
};

}  // namespace

TEST_CASE("prescribed motion: a bar is drawn out, the force that does it and the force that holds it") {
    const RunOfText run(block("name = \"static\"\nstep = 0.25\n", "", "1.0") + R"(
[[solid.clamp]]
name = "wall"
set = "left"
[[solid.motion]]
name = "grip"
set = "right"
along = "x"
points = [[0.0, 0.0], [1.0, 0.002]]
[[solid.track]]
name = "end"
point = [0.2, 0.0]
)");
    const double force = 1e7 * 0.002 / 0.2 * 0.1;  // E ε A
    CHECK(run.last("end_x") == doctest::Approx(0.002));
    CHECK(run.last("grip_force_x") == doctest::Approx(force).epsilon(1e-8));
    CHECK(run.last("wall_force_x") == doctest::Approx(-force).epsilon(1e-8));
    // Half way at half time: the law, and not the ramp of a static solve, says where.
    CHECK(run.at(0.5, "end_x") == doctest::Approx(0.001));
}

TEST_CASE("a harmonic motion of the root, in a dynamic run, does the work that the body shows") {
    const RunOfText run(block("alpha = 0.0\nstep = 1e-4\n", "", "0.02") + R"(
[[solid.motion]]
set = "left"
along = "x"
amplitude = 1e-3
frequency = 50.0
ramp = 0.01
[[solid.motion]]
set = "left"
along = "y"
value = 0.0
[[solid.track]]
name = "root"
point = [0.0, 0.0]
)");
    CHECK(run.last("root_x") == doctest::Approx(1e-3 * std::sin(2 * M_PI * 50 * 0.02)).scale(1e-3).epsilon(1e-9));
    CHECK(run.largest("solid_kinetic_energy") > 0);
    CHECK(std::abs(run.last("solid_energy_residual")) < 1e-3 * run.largest("solid_kinetic_energy"));
}

TEST_CASE("follower pressure on all sides: the block shrinks as its bulk modulus says") {
    const RunOfText run(block("name = \"static\"\n", "", "1.0") + R"(
[[solid.clamp]]
set = "left"
fixed = ["x"]
[[solid.clamp]]
set = "bottom"
fixed = ["y"]
[[solid.pressure]]
surface = "right"
value = 1.0e4
[[solid.pressure]]
surface = "top"
rate = 1.0e4
[[solid.track]]
name = "corner"
point = [0.2, 0.1]
)");
    CHECK(run.last("corner_x") == doctest::Approx(-0.2 * 1e4 / 1e7).epsilon(2e-3));  // ν = 0: each way its own
    CHECK(run.last("corner_y") == doctest::Approx(-0.1 * 1e4 / 1e7).epsilon(2e-3));
}

TEST_CASE("a rigid face, loaded: moves without turning under a force, and the column of what is prescribed") {
    const RunOfText run(block("name = \"static\"\n", "", "1.0") + R"(
[[solid.clamp]]
set = "left"
[[solid.rigid_body]]
name = "plate"
set = "right"
[[solid.rigid_motion]]
body = "plate"
freedom = "turn"
value = 0.0
[[solid.rigid_load]]
body = "plate"
freedom = "x"
value = 600.0
[[solid.rigid_load]]
body = "plate"
freedom = "x"
rate = 400.0
)");
    CHECK(run.last("plate_x") == doctest::Approx(1000.0 * 0.2 / (1e7 * 0.1)).epsilon(1e-6));
    CHECK(std::abs(run.last("plate_y")) < 1e-12);
    CHECK(run.last("plate_turn") == 0);
    CHECK(std::abs(run.last("plate_moment")) < 1e-6);
    CHECK_FALSE(run.has("plate_force_x"));
}

TEST_CASE("a block let down on the ground: contact bears its weight, on its area; the ground comes up and lifts it") {
    const std::string scene = block("name = \"static\"\n", "0.0, -10.0", "1.0") + R"(
[[solid.clamp]]
set = "left"
fixed = ["x"]
[[solid.contact]]
name = "ground"
surface = "bottom"
point = [0.0, 0.0]
normal = [0.0, 2.0]
)";
    const RunOfText rest(scene);
    const double weight = 1000 * 10 * 0.2 * 0.1;
    CHECK(rest.last("ground_force_y") == doctest::Approx(weight).epsilon(1e-6));
    CHECK(rest.last("ground_area") == doctest::Approx(0.2).epsilon(1e-3));
    CHECK(rest.last("ground_pressure") == doctest::Approx(weight / 0.2).epsilon(0.05));
    CHECK(rest.last("solid_contact_energy") > 0);
    const RunOfText lifted(scene + R"([[solid.ground_motion]]
contact = "ground"
along = "y"
value = 0.05
[[solid.track]]
name = "low"
point = [0.1, 0.0]
)");
    CHECK(lifted.last("low_y") == doctest::Approx(0.05).epsilon(1e-3));
}

TEST_CASE("damping from a scene brings a swing to rest, and its column says what it took") {
    const std::string scene = block("alpha = 0.0\nstep = 2e-4\n", "10.0, 0.0", "0.1") + R"(
[[solid.clamp]]
set = "left"
[[solid.track]]
name = "end"
point = [0.2, 0.05]
[solid.damping]
mass = 50.0
stiffness = 1e-4
)";
    const RunOfText run(scene);
    CHECK(run.last("end_x") == doctest::Approx(1000 * 10 * 0.2 * 0.2 / 2 / 1e7).epsilon(0.01));  // ρ g L²/2E
    CHECK(run.last("solid_kinetic_energy") < 1e-3 * run.last("solid_strain_energy"));
    // What gravity gave is half stored and half lost.
    CHECK(run.last("solid_damping_energy") == doctest::Approx(run.last("solid_strain_energy")).epsilon(0.02));
}

TEST_CASE("central differences from a scene find their step; a longer one is refused with the largest") {
    const std::string scene = block("name = \"central_difference\"\n", "10.0, 0.0", "0.01") + R"(
[[solid.clamp]]
set = "left"
[[solid.track]]
name = "end"
point = [0.2, 0.05]
)";
    const RunOfText run(scene);
    const std::string named = "name = \"central_difference\"";
    const RunOfText reference(with(scene, named, "alpha = 0.0\nstep = 1e-5"));
    CHECK(run.largest("end_x") == doctest::Approx(reference.largest("end_x")).epsilon(0.01));
    CHECK(std::abs(run.last("solid_energy_residual")) < 0.02 * run.largest("solid_strain_energy"));
    CHECK_THROWS_WITH_AS(Finished(with(scene, named, named + "\nstep = 1.0")),
                         doctest::Contains("central differences are stable up to a step of"), io::SceneError);
}

TEST_CASE("cords in a layer: stiff along them when pulled") {
    const auto stretched = [](const std::string& angle) {
        const std::string rubber = elastic_box({.corner = "0.2, 0.1, 0.01",
                                                .elements = "2, 2, 2",
                                                .law = "neo_hookean",
                                                .youngs_modulus = "1.0e6",
                                                .poissons_ratio = "0.45"});
        const RunOfText run(rubber + sliding_faces + R"([[solid.cords]]
modulus = 1.0e9
section = 1.0e-6
spacing = 1.0e-3
thickness = 0.005
angles = [)" + angle + R"(]
[[solid.traction]]
surface = "right"
value = [1.0e4, 0.0, 0.0]
[[solid.track]]
name = "end"
point = [0.2, 0.0, 0.0]
)");
        return run.last("end_x") / 0.2;
    };
    // E + E_c A/(s t) along them; nothing across them, where rubber is pushed together.
    CHECK(stretched("0.0") == doctest::Approx(1e4 / (1e6 + 1e9 * 1e-6 / (1e-3 * 0.005))).epsilon(0.02));
    CHECK(stretched("1.5707963267948966") == doctest::Approx(1e4 / 1e6).epsilon(0.03));
}

TEST_CASE("a body that is thrown flies, and its rigid rim with it; where it is clamped it stays") {
    const std::string thrown = block("alpha = 0.0\nstep = 1e-3\n", "0.0, -10.0", "0.1") + R"(
[[solid.rigid_body]]
name = "plate"
set = "right"
mass = 5.0
[[solid.track]]
name = "middle"
point = [0.1, 0.05]
)";
    const RunOfText run(with(thrown, "[solid]\n", "[solid]\nvelocity = [2.0, 1.0]\n"));
    CHECK(run.last("middle_x") == doctest::Approx(0.2).epsilon(1e-6));
    CHECK(run.last("middle_y") == doctest::Approx(0.1 - 0.05).epsilon(1e-3));
    CHECK(run.last("plate_x") == doctest::Approx(0.2).epsilon(1e-6));
    CHECK(std::abs(run.last("plate_turn")) < 1e-6);
    const RunOfText held(with(thrown, "[solid]\n", "[solid]\nvelocity = [0.0, 0.01]\n") +
                         "[[solid.clamp]]\nset = \"left\"\n[[solid.track]]\nname = \"root\"\npoint = [0.0, 0.0]\n");
    CHECK(held.last("root_y") == 0);
    CHECK(held.largest("solid_kinetic_energy") > 0);
}

TEST_CASE("the film of a body with a hole draws two closed lines, not one through both") {
    // A square frame of eight unit squares around a hole.
    std::string nodes = "16\n", elements = "9\n";
    for (int n = 0; n < 16; ++n)
        nodes += std::to_string(n + 1) + " " + std::to_string(n % 4) + " " + std::to_string(n / 4) + " 0\n";
    int number = 1;
    for (int e = 0; e < 9; ++e)
        if (e != 4) {
            const int a = e % 3 + 4 * (e / 3) + 1;
            elements += std::to_string(number++) + " 3 2 2 1 " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
                        std::to_string(a + 5) + " " + std::to_string(a + 4) + "\n";
        }
    elements += std::to_string(number) + " 1 2 1 1 1 2\n";
    const std::string mesh =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"foot\"\n2 2 \"all\"\n"
        "$EndPhysicalNames\n$Nodes\n" +
        nodes + "$EndNodes\n$Elements\n" + elements + "$EndElements\n";
    const std::string scene =
        with(block("name = \"static\"\n", "0.0, -1.0", "1.0"),
             "[solid.box]\nmin = [0.0, 0.0]\nmax = [0.2, 0.1]\nelements = [4, 2]\n", "mesh = \"frame.msh\"\n");
    const Finished run(scene + "[[solid.clamp]]\nset = \"foot\"\n", 1, {{"frame.msh", mesh}});
    REQUIRE(run.code == engine::success);
    const std::string report = run.results.report();
    const auto outlines = report.find("\"outlines\":[[");
    REQUIRE(outlines != std::string::npos);
    const std::string frame = report.substr(outlines, report.find("]]", outlines) - outlines);
    CHECK(count(frame, "],[") == 1);
    // Outside 12 edges, inside 4; with the nodes in their middles twice as many points of two numbers.
    CHECK(count(frame, ",") == 2 * 2 * 16 - 1);
}
