// A body on its own: static and dynamic runs in two and three dimensions, with loads constant and in time, against
// closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/body_scenes.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// A bar of 1 m by 0.1 m (by 0.2 m), pulled at its right end along x; its sides free to shrink.
const std::string bar_2d =
    elastic_box({.corner = "1.0, 0.1", .elements = "4, 1", .solid = "plane = \"stress\"\n"}) + R"([[solid.clamp]]
set = "left"
fixed = ["x"]
[[solid.clamp]]
set = "bottom"
fixed = ["y"]
[[solid.traction]]
surface = "right"
value = [1.0e4, 0.0]
[[solid.track]]
name = "tip"
point = [1.0, 0.1]
)";

const std::string bar_3d = elastic_box({.corner = "1.0, 0.1, 0.2", .elements = "4, 1, 2"}) + sliding_faces +
                           R"([[solid.traction]]
surface = "right"
value = [1.0e4, 0.0, 0.0]
[[solid.track]]
name = "tip"
point = [1.0, 0.1, 0.2]
)";

// A free block of 200 kg.
const std::string block = elastic_box({.corner = "1.0, 0.5, 0.4",
                                       .elements = "2, 1, 1",
                                       .end = "0.5",
                                       .law = "saint_venant_kirchhoff",
                                       .youngs_modulus = "1.0e9",
                                       .scheme = "step = 0.0125\n"}) +
                          R"([[solid.traction]]
surface = "left"
value = [1000.0, 0.0, 0.0]
factor = "6*t"
[[solid.traction]]
surface = "right"
value = [1000.0, 0.0, 0.0]
factor = "6*t"
[[solid.track]]
name = "middle"
point = [0.5, 0.25, 0.2]
[output]
frame_interval = 0.25
)";

}  // namespace

TEST_CASE("a bar under tension is Hooke's, in the plane and in space, with either order of elements") {
    for (const std::string& scene : {bar_2d, bar_3d})
        for (const char* order : {"", "order = 1\n", "integration = \"full\"\n"}) {
            CAPTURE(scene);
            CAPTURE(order);
            const Finished run(with(scene, "[solid]\n", "[solid]\n" + std::string(order)));
            REQUIRE(run.code == engine::success);
            const io::History history = run.results.history();
            REQUIRE(history.rows() == 2);  // before the load, and under it
            CHECK(history.column("tip_x")[0] == 0);
            CHECK(history.column("tip_x").back() == doctest::Approx(1e-3).epsilon(1e-9));
            CHECK(history.column("tip_y").back() == doctest::Approx(-0.3e-3 * 0.1).epsilon(1e-9));
            if (scene == bar_3d) CHECK(history.column("tip_z").back() == doctest::Approx(-0.3e-3 * 0.2).epsilon(1e-9));
            // ½ σ²/E of the volume
            const double volume = scene == bar_2d ? 0.1 : 0.02;
            CHECK(history.column("solid_strain_energy").back() == doctest::Approx(5 * volume).epsilon(1e-9));
        }
}

TEST_CASE("Mooney-Rivlin rubber under a small pull has the modulus 6 (C10 + C01)") {
    const Finished run(with(bar_3d, "law = \"linear\"\ndensity = 1000.0\nyoungs_modulus = 1.0e7\npoissons_ratio = 0.3",
                            "law = \"mooney_rivlin\"\ndensity = 1000.0\nc10 = 1.2e6\nc01 = 0.3e6\nbulk_modulus = 3e9"));
    REQUIRE(run.code == engine::success);
    const double G = 3e6, K = 3e9, E = 9 * K * G / (3 * K + G), strain = 1e4 / E;
    CHECK(run.results.column("tip_x").back() == doctest::Approx(strain).epsilon(2 * strain));
}

TEST_CASE("a measured curve: a strip pulled as far as its table says") {
    std::string scene =
        with(bar_3d, "law = \"linear\"\ndensity = 1000.0\nyoungs_modulus = 1.0e7\npoissons_ratio = 0.3",
             "law = \"uniaxial_curve\"\ndensity = 1000.0\ncurve = \"curve.csv\"\npoissons_ratio = 0.49");
    scene = with(scene, "value = [1.0e4, 0.0, 0.0]", "value = [1.4e4, 0.0, 0.0]");
    const Finished run(scene, 1, {{"curve.csv", "strain,stress[Pa]\n0,0\n0.1,0.8e4\n0.2,1.4e4\n0.4,2.2e4\n"}});
    REQUIRE(run.code == engine::success);
    CHECK(run.results.column("tip_x").back() == doctest::Approx(0.2).epsilon(0.02));
}

TEST_CASE("steps of a static run follow the loads in time: a table and a formula of the same curve") {
    const std::string stepped = with(bar_2d, "name = \"static\"", "name = \"static\"\nstep = 0.125");
    const Finished formula(
        with(stepped, "value = [1.0e4, 0.0]\n", "value = [1.0e4, 0.0]\nfactor = \"t < 0.5 ? 2*t : 2 - 2*t\"\n"));
    REQUIRE(formula.code == engine::success);
    const Finished table(with(stepped, "value = [1.0e4, 0.0]\n", "value = [1.0e4, 0.0]\ntable = \"tent.csv\"\n"), 1,
                         {{"tent.csv", "time,factor\n0,0\n0.5,1\n1,0\n"}});
    REQUIRE(table.code == engine::success);
    const io::History a = formula.results.history(), b = table.results.history();
    REQUIRE(a.rows() == 9);
    REQUIRE(b.rows() == 9);
    for (std::size_t k = 0; k < 9; ++k) {
        CHECK(a.time()[k] == 0.125 * double(k));
        CHECK(a.column("tip_x")[k] == doctest::Approx(1e-3 * (1 - std::abs(1 - 2 * a.time()[k]))).epsilon(1e-9));
        CHECK(b.column("tip_x")[k] == doctest::Approx(a.column("tip_x")[k]).epsilon(1e-9));
    }
}

TEST_CASE("a free block under a growing force: t³, and its work is its kinetic energy") {
    const Finished run(block);
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    REQUIRE(history.rows() == 41);
    const double t = 0.5, mass = 200, force = 2 * 1000 * 0.2 * 6;  // × t
    // second order: the error of t³ is t Δt² times a constant
    CHECK(history.column("middle_x").back() == doctest::Approx(force / mass * t * t * t / 6).epsilon(0.01));
    CHECK(std::abs(history.column("middle_y").back()) < 1e-6);
    const double work = 0.5 * mass * std::pow(force / mass * t * t / 2, 2);
    CHECK(history.column("solid_kinetic_energy").back() == doctest::Approx(work).epsilon(0.01));
    CHECK(history.column("solid_external_work").back() == doctest::Approx(work).epsilon(0.01));
    // An even force on the node set of the same body
    const Finished forced(with(without(block,
                                       "[[solid.traction]]\nsurface = \"left\"\nvalue = [1000.0, 0.0, "
                                       "0.0]\nfactor = \"6*t\"\n"),
                               "[[solid.traction]]\nsurface = \"right\"\nvalue = [1000.0, 0.0, 0.0]",
                               "[[solid.force]]\nset = \"right\"\nvalue = [400.0, 0.0, 0.0]"));
    REQUIRE(forced.code == engine::success);
    CHECK(forced.results.column("middle_x").back() == doctest::Approx(history.column("middle_x").back()).epsilon(1e-3));
}

TEST_CASE("a body alone in three dimensions leaves history, frames, summary and a film of its surface") {
    const Finished run(block);
    REQUIRE(run.code == engine::success);
    const auto frames = run.results.frames("solid");
    REQUIRE(frames.size() == 3);
    CHECK(run.results.frames_on_disk("fluid") == 0);
    const io::Hdf5File last = run.results.open(frames.back());
    CHECK(last.read<std::uint8_t>("VTKHDF/Types") == std::vector<std::uint8_t>(2, 25));
    const nlohmann::json summary = run.results.summary();
    CHECK(summary["outcome"] == "finished");
    CHECK(summary["elements"] == 2);
    CHECK(summary["steps"] == 40);
    CHECK(summary["scene"]["solid"]["traction"].size() == 2);
    CHECK(summary["tasks"].contains("FE Newton solve"));
    CHECK_FALSE(summary.contains("particles"));
    const std::string report = run.results.report();
    CHECK(report.find("Motion") != std::string::npos);
    CHECK(report.find("20 nodes each") != std::string::npos);
    CHECK(report.find("\"fields\":[]") != std::string::npos);  // no colours without water
    CHECK(count(report, "\"walls\":[[") >= 3);                 // ten quadrilaterals in every frame
}

TEST_CASE("a body alone gives the same bits with one thread and with four") {
    const std::string wobbling = with(block, "elements = [2, 1, 1]", "elements = [9, 6, 5]");
    const std::string soft = with(wobbling, "youngs_modulus = 1.0e9", "youngs_modulus = 1.0e5");
    const std::string shorter = with(soft, "end = 0.5", "end = 0.05");
    const Finished one(shorter, 1), four(shorter, 4);
    REQUIRE(one.code == engine::success);
    CHECK(contents(one.results.path / "history.csv") == contents(four.results.path / "history.csv"));
}

TEST_CASE("released from its equilibrium a beam swings with twice its deflection and back") {
    // Bernoulli: f = 0.5596/L² sqrt(E I/(ρ A)), plane stress.
    const double f = 0.5596 * std::sqrt(1e7 * 0.1 * 0.1 / 12 / 1000) * 0.987;  // less shear and rotation of sections
    std::string scene = with(bar_2d, "[[solid.clamp]]\nset = \"bottom\"\nfixed = [\"y\"]\n", "");
    scene = with(scene, "fixed = [\"x\"]\n", "");
    scene = with(scene, "plane = \"stress\"", "plane = \"stress\"\nstatic_start = true");
    scene = with(scene, "name = \"static\"", "alpha = -0.05\nstep = " + std::to_string(1 / f / 200));
    scene = with(scene, "end = 1.0", "end = " + std::to_string(1 / f));
    const Finished run(with(scene, "value = [1.0e4, 0.0]\n", "value = [0.0, 1.0]\nfactor = \"t > 0 ? 0 : 1\"\n"));
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    const auto tip = history.column("tip_y");
    CHECK(tip[0] == doctest::Approx(0.1 / (3 * 1e7 * 0.001 / 12)).epsilon(0.02));
    CHECK(tip[100] < -0.9 * tip[0]);
    CHECK(tip[200] > 0.9 * tip[0]);
    CHECK(std::abs(tip[50]) < 0.15 * tip[0]);
}

TEST_CASE("parts of a mesh file of other materials: springs in a row, by a Gmsh file and by a deck") {
    // Two unit squares side by side, the second one twice as stiff; pulled at the right.
    const std::string nodes = "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n";
    const std::string gmsh =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"left\"\n1 2 \"right\"\n1 3 "
        "\"bottom\"\n2 4 \"soft\"\n2 5 \"stiff\"\n$EndPhysicalNames\n$Nodes\n6\n" +
        nodes +
        "$EndNodes\n$Elements\n6\n1 1 2 1 1 1 4\n2 1 2 2 2 3 6\n3 1 2 3 3 1 2\n4 1 2 3 3 2 3\n5 3 2 "
        "4 1 1 2 5 4\n6 3 2 5 2 2 3 6 5\n$EndElements\n";
    const std::string deck =
        "*NODE\n1,0,0\n2,1,0\n3,2,0\n4,0,1\n5,1,1\n6,2,1\n*ELEMENT,TYPE=CPS4,ELSET=soft\n1,1,2,5,4\n"
        "*ELEMENT,TYPE=CPS4,ELSET=stiff\n2,2,3,6,5\n*NSET,NSET=left\n1,4\n*NSET,NSET=bottom\n1,2,3\n"
        "*SURFACE,NAME=right\nstiff,S2\n";
    std::string scene = without(bar_2d, "[solid.box]\nmin = [0.0, 0.0]\nmax = [1.0, 0.1]\nelements = [4, 1]\n");
    scene +=
        "[[solid.part]]\nset = \"stiff\"\nlaw = \"linear\"\ndensity = 1000.0\nyoungs_modulus = 2.0e7\n"
        "poissons_ratio = 0.3\n[[solid.track]]\nname = \"end\"\npoint = [2.0, 0.0]\n";
    scene = with(scene, "poissons_ratio = 0.3\n[solid.scheme]", "poissons_ratio = 0.0\n[solid.scheme]");
    scene = with(scene, "youngs_modulus = 2.0e7\npoissons_ratio = 0.3", "youngs_modulus = 2.0e7\npoissons_ratio = 0.0");
    for (const char* name : {"body.msh", "body.inp"}) {
        CAPTURE(name);
        const Finished run(with(scene, "[solid]\n", "[solid]\nmesh = \"" + std::string(name) + "\"\n"), 1,
                           {{"body.msh", gmsh}, {"body.inp", deck}});
        REQUIRE(run.code == engine::success);
        CHECK(run.results.column("end_x").back() == doctest::Approx(1e-3 * 1.5).epsilon(1e-9));
    }
}

TEST_CASE("a body that loses its balance is said so, and what was computed is kept") {
    const Finished run(without(bar_2d, "[[solid.clamp]]\nset = \"bottom\"\nfixed = [\"y\"]\n"));
    CHECK(run.code == engine::run_failed);
    CHECK(run.err.str().find("clamps leave the body free to move") != std::string::npos);
    CHECK(run.err.str().find("coupling") == std::string::npos);
    CHECK(run.results.summary()["outcome"] == "failed");
    CHECK(run.results.history().rows() == 1);
}

TEST_CASE("sets and factors that are not there are refused with their place") {
    CHECK_THROWS_WITH_AS(Finished(with(bar_2d, "value = [1.0e4, 0.0]\n", "value = [1.0e4, 0.0]\nfactor = \"2*tt\"\n")),
                         doctest::Contains("\"2*tt\" is no formula"), io::SceneError);
    CHECK_THROWS_WITH_AS(Finished(with(bar_3d, "surface = \"right\"", "surface = \"frnt\"")),
                         doctest::Contains("did you mean \"front\"?"), io::SceneError);
}

TEST_CASE(
    "equal steps and an interval of their length: a frame and a row for each, though sums of tenths are rounded") {
    const Finished run(with(bar_2d, "name = \"static\"", "name = \"static\"\nstep = 0.1") +
                       "[output]\nframe_interval = 0.1\nhistory_interval = 0.1\n");
    REQUIRE(run.code == engine::success);
    CHECK(run.results.frames("solid").size() == 11);
    CHECK(run.results.history().rows() == 11);
}
