// A run that goes on from a checkpoint has the bits of one that never stopped, and one that writes checkpoints those of
// one that does not: the whole state, every column of the history, every frame; on another number of threads too.
#include <doctest/doctest.h>

#include <random>

#include "tests/engine/session.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

template <int D>
void check_restarts(const std::string& text, unsigned seed, int restarts = 2) {
    const ScratchFolder folder;
    const auto scene = folder.write("scene.toml", text);
    std::string state;
    long cycles = 0;
    {  // in a block: the fewest threads of those alive at the same time count
        Session<D> whole(scene, folder / "whole", 2);
        whole.run();
        state = whole.state();
        cycles = whole.cycles;
    }
    const std::string results = results_of({folder / "whole"});
    REQUIRE(cycles >= 4);

    std::mt19937 random(seed);
    for (int k = 0; k < restarts; ++k) {
        const long at = std::uniform_int_distribution<long>(1, cycles - 1)(random);
        CAPTURE(at);
        const auto parts = folder / "parts";
        std::filesystem::remove_all(parts);
        std::ostringstream said;
        {
            Session<D> first(scene, parts, 1);
            first.run(at);
            first.checkpoints.write({});
            // It goes on, as if it were killed some time later: its later rows and frames must go.
            first.run();
            CHECK(first.state() == state);  // the checkpoint has changed nothing
            CHECK(results_of({parts}) == results);
        }
        const auto from = engine::find_restart_point(io::read_scene(scene), parts, "auto", said);
        REQUIRE(from);
        Session<D> second(scene, parts, 3, from);
        second.run();
        CHECK(second.cycles == cycles - at);
        CHECK(second.state() == state);
        CHECK(results_of({parts}) == results);
    }
}

// A row each cycle: a difference shows where it begins.
std::string every_cycle(const std::string& text) {
    return with(text, "history_interval = 0.001\n", "");
}

const std::string basin = R"(schema_version = 1
title = "Basin"
[time]
end = 0.04
[domain]
min = [-0.4, -0.2]
max = [2, 2]
[fluid]
spacing = 0.02
sound_speed = 20
#fluid
[[fluid.box]]
min = [0, 0]
max = [0.2, 0.3]
[[wall]]
name = "floor"
points = [[-0.3, 0], [1, 0], [1, 1]]
force = true
[[wall]]
name = "piston"
points = [[0, 1], [0, -0.1]]
force = true
motion = { translation = { velocity = [0.8, 0], ramp = 0.01 } }
[[probe]]
name = "foot"
quantity = "pressure"
point = [0, 0.05]
wall = "piston"
[output]
frame_interval = 0.006
#output
)";

std::string variant(const std::string& fluid, const std::string& output = "") {
    return with(with(basin, "#fluid\n", fluid), "#output\n", output);
}

// Water between two plates that shear it, periodic along x, no gravity across it.
const std::string channel = R"(schema_version = 1
title = "Channel"
gravity = [0, 0]
[time]
end = 0.05
[domain]
min = [0, -0.2]
max = [0.4, 0.6]
periodic = ["x"]
[fluid]
spacing = 0.02
sound_speed = 10
initial_pressure = "zero"
driving_force = [5, 0]
scheme = { name = "riemann_ale" }
transport = { name = "shifting" }
viscosity = { dynamic = 1.0 }
[[fluid.box]]
min = [0, 0]
max = [0.4, 0.3]
velocity = [3, 0]
[[wall]]
name = "low"
points = [[0, 0], [0.4, 0]]
slip = "none"
[[wall]]
name = "high"
points = [[0.4, 0.3], [0, 0.3]]
slip = "none"
[output]
frame_interval = 0.02
)";

// A column of water in space that collapses onto a floor and towards a wall that moves into it.
const std::string space = R"(schema_version = 1
title = "Space"
[time]
end = 0.03
[domain]
min = [-0.5, -0.5, -0.5]
max = [1.5, 1.5, 1.5]
edge = "open"
[fluid]
spacing = 0.05
sound_speed = 25
support_ratio = 2.6
#fluid
[[fluid.box]]
min = [0, 0, 0]
max = [0.3, 0.25, 0.5]
[[wall]]
name = "floor"
points = [[-0.2, 0, 0], [0.8, 0, 0], [0.8, 0.25, 0], [-0.2, 0.25, 0]]
force = true
[[wall]]
name = "south"
points = [[-0.2, 0, 0], [-0.2, 0, 0.8], [0.8, 0, 0.8], [0.8, 0, 0]]
[[wall]]
name = "north"
points = [[-0.2, 0.25, 0], [0.8, 0.25, 0], [0.8, 0.25, 0.8], [-0.2, 0.25, 0.8]]
[[wall]]
name = "west"
points = [[0, 0, 0], [0, 0.25, 0], [0, 0.25, 0.8], [0, 0, 0.8]]
#motion
[output]
frame_interval = 0.01
)";

}  // namespace

TEST_CASE("the gate goes on with the same bits, CPS and CSS") {
    unsigned seed = 1;
    for (const char* algorithm : {"cps", "css"})
        for (const int p : {1, 3}) {
            CAPTURE(algorithm);
            CAPTURE(p);
            check_restarts<2>(every_cycle(with_coupling(gate, algorithm, p)), seed++);
        }
}

TEST_CASE("every load and regulation goes on with the same bits") {
    unsigned seed = 60;
    const std::string ledger = with(every_cycle(gate), "[output]\n", "[output]\nenergy_ledger = true\n");
    for (const char* keys :
         {"algorithm = \"cps\"\nload = \"averaged_pressure\"\nratio_control = true\nratio = 4\n",
          "algorithm = \"css\"\nload = \"energy_conservative\"\nextrapolation = \"quadratic\"\nratio = 3\n",
          "algorithm = \"cps\"\nload = \"energy_conservative\"\nstep_rule = \"predicted\"\nratio = 2\n"}) {
        CAPTURE(keys);
        check_restarts<2>(with(ledger, "algorithm = \"cps\"\nratio = 1\n", keys), seed++);
    }
    check_restarts<2>(with(every_cycle(gate), "sound_speed", "walls = \"normal_flux\"\nsound_speed"), seed++);
    check_restarts<2>(with(with(ledger, "sound_speed", "walls = \"normal_flux\"\nsound_speed"), "ratio = 1\n",
                           "ratio = 2\nload = \"energy_conservative\"\n"),
                      seed);
}

TEST_CASE("cycles that are iterated go on with the same bits") {
    unsigned seed = 70;
    for (const char* relaxation : {"quasi_newton", "aitken"})
        for (const int p : {1, 2}) {
            CAPTURE(relaxation);
            CAPTURE(p);
            const std::string keys = std::string("algorithm = \"iterated\"\nrelaxation = \"") + relaxation +
                                     "\"\nratio = " + std::to_string(p) + "\n";
            check_restarts<2>(with(every_cycle(gate), "algorithm = \"cps\"\nratio = 1\n", keys), seed++);
        }
    const std::string flux =
        with(every_cycle(gate), "sound_speed = 30.0", "sound_speed = 30.0\nwalls = \"normal_flux\"");
    check_restarts<2>(with_coupling(flux, "iterated", 2), seed);
}

TEST_CASE("a body whose factorisation lasts goes on with the same bits") {
    // Stiff and started from equilibrium: one factorisation serves many steps, and is in use at the checkpoint.
    check_restarts<2>(with(plate, "end = 0.1", "end = 0.06"), 10, 3);
    check_restarts<2>(with(plate, "end = 0.1", "end = 0.06") + "[coupling]\nalgorithm = \"css\"\nratio = 3\n", 11);
    check_restarts<2>(with(strip, "end = 0.05", "end = 0.01"), 12);
}

TEST_CASE("central differences in water go on with the same bits, iterated as well") {
    const std::string text = with(every_cycle(explicit_gate()), "[output]\n", "[output]\nenergy_ledger = true\n");
    check_restarts<2>(with_coupling(text, "cps", 1), 80);
    check_restarts<2>(with_coupling(text, "css", 2), 81);
    check_restarts<2>(with_coupling(text, "iterated", 1), 82);
}

TEST_CASE("rows and frames at intervals go on without a gap or a repeat") {
    check_restarts<2>(gate, 20, 3);
    check_restarts<2>(column, 21, 3);
}

TEST_CASE("water with moving walls, forces, probes and the energy ledger goes on with the same bits") {
    const std::string ledger = "energy_ledger = true\n";
    check_restarts<2>(variant("", ledger), 30);
    check_restarts<2>(variant("integration = \"rk3\"\n", ledger), 31);
    check_restarts<2>(variant("integration = \"verlet\"\n", ledger), 32);
    check_restarts<2>(variant("scheme = { name = \"delta_sph\" }\ntransport = { name = \"x_sph\" }\n", ledger), 33);
    check_restarts<2>(variant("scheme = { name = \"riemann_ale\" }\ntransport = { name = \"shifting\" }\n"), 34);
    check_restarts<2>(variant("scheme = { name = \"riemann_ale\" }\nintegration = \"verlet\"\n"), 35);
    check_restarts<2>(variant("viscosity = { dynamic = 0.5 }\n"), 36);
}

TEST_CASE("walls of normal fluxes go on with the same bits") {
    check_restarts<2>(variant("walls = \"normal_flux\"\n"), 40);
    check_restarts<2>(variant("walls = \"normal_flux\"\nintegration = \"verlet\"\n", "energy_ledger = true\n"), 41);
}

TEST_CASE("a periodic channel goes on with the same bits") {
    check_restarts<2>(channel, 50, 3);
    check_restarts<2>(with(with(with(channel, "viscosity = { dynamic = 1.0 }",
                                     "viscosity = { dynamic = 1.0, operator = \"morris\" }\nwalls = \"normal_flux\""),
                                "scheme = { name = \"riemann_ale\" }\n", ""),
                           "transport = { name = \"shifting\" }", "transport = { name = \"x_sph\" }"),
                      51, 3);
}

TEST_CASE("water in space goes on with the same bits") {
    check_restarts<3>(space, 60);
    check_restarts<3>(with(space, "#motion\n", "motion = { translation = { velocity = [1, 0, 0], ramp = 0.01 } }\n"),
                      61);
    check_restarts<3>(with(space, "#fluid\n", "walls = \"normal_flux\"\nintegration = \"rk3\"\n"), 62);
}

TEST_CASE("restarts may follow each other") {
    const ScratchFolder folder;
    const auto scene = folder.write("scene.toml", every_cycle(with_coupling(gate, "cps", 3)));
    std::string state;
    long all = 0, cycles = 0;
    {
        Session<2> whole(scene, folder / "whole", 2);
        whole.run();
        state = whole.state();
        all = whole.cycles;
    }
    std::ostringstream said;
    std::optional<engine::RestartPoint> from;
    for (int part = 0; part < 6; ++part) {
        Session<2> session(scene, folder / "parts", 1 + part % 2, from);
        session.run(part == 5 ? all : 3 + part);
        cycles += session.cycles;
        session.checkpoints.write({});
        from = engine::find_restart_point(session.scene, folder / "parts", "auto", said);
        REQUIRE(from);
        CHECK(from->steps == session.model->clock.steps);
        if (part == 5) CHECK(session.state() == state);
    }
    CHECK(cycles == all);
    CHECK(results_of({folder / "parts"}) == results_of({folder / "whole"}));
}
