// Every scheme, kernel, integration, viscosity and transport from a scene file to its results: it runs, is the same on
// any number of threads, says what it is, and its energy balance closes. What does not go together is refused.
#include <doctest/doctest.h>

#include <cmath>

#include "engine/check.hpp"
#include "io/scene_reader.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

const std::string collapse = R"(schema_version = 1
title = "Collapse"
[time]
end = 0.03
[domain]
min = [-0.2, -0.2]
max = [2, 2]
[fluid]
spacing = 0.02
sound_speed = 20
#fluid
[[fluid.box]]
min = [0, 0]
max = [0.2, 0.3]
[[wall]]
name = "tank"
points = [[0, 1], [0, 0], [1, 0], [1, 1]]
slip = "none"
[output]
frame_interval = 0.03
#output
)";

struct Variant {
    const char* fluid;
    bool ledger;
    const char* says;  // in what check prints
};
constexpr Variant variants[] = {
    {"integration = \"verlet\"\n", true, "Verlet"},
    {"integration = \"rk3\"\nkernel = \"cubic_spline\"\n", true, "cubic spline, RK3"},
    {"scheme = { name = \"delta_sph\" }\nviscosity = { dynamic = 0.5 }\n", true, "δ-SPH"},
    {"scheme = { name = \"artificial_viscosity\" }\ntransport = { name = \"x_sph\" }\n", true, "artificial viscosity"},
    {"scheme = { riemann_solver = \"exact\", reconstruction = \"none\" }\n", true, "first order, exact solver"},
    {"scheme = { riemann_solver = \"low_dissipation\" }\nviscosity = { dynamic = 0.5, operator = \"morris\" }\n", true,
     "Morris"},
    {"scheme = { name = \"riemann_ale\" }\ntransport = { name = \"shifting\" }\n", false, "shifting"},
    {"scheme = { name = \"riemann_ale\" }\nintegration = \"verlet\"\n", false, "ALE"},
};

std::string scene_of(const Variant& variant) {
    return with(with(collapse, "#fluid\n", variant.fluid), "#output\n", variant.ledger ? "energy_ledger = true\n" : "");
}

std::string refused(const std::string& fluid, const std::string& output = "") {
    return refusal(with(with(collapse, "#fluid\n", fluid), "#output\n", output));
}

}  // namespace

TEST_CASE("every scheme runs from its scene, the same on any number of threads") {
    for (const Variant& variant : variants) {
        CAPTURE(variant.fluid);
        const std::string text = scene_of(variant);
        const Finished one(text, 1), two(text, 2);
        REQUIRE(one.code == engine::success);
        REQUIRE(two.code == engine::success);
        CHECK(contents(one.results.path / "history.csv") == contents(two.results.path / "history.csv"));
        const io::History history = one.results.history();
        CHECK(history.column("fluid_kinetic_energy").back() > 0);
        if (variant.ledger) {
            const double kinetic = history.column("fluid_kinetic_energy").back();
            CHECK(history.column("fluid_dissipated_energy").back() > 0);
            CHECK(std::fabs(history.column("fluid_energy_residual").back()) < 1e-3 * kinetic);
        }
        ScratchFolder folder;
        std::ostringstream out;
        engine::check(io::read_scene(folder.write("scene.toml", text)), 1, out);
        CHECK(out.str().find(variant.says) != std::string::npos);
    }
}

TEST_CASE("the work of single walls is the work of all, and a piston's is what the water gains") {
    const std::string piston =
        with(with(collapse, "[[wall]]\nname = \"tank\"\npoints = [[0, 1], [0, 0], [1, 0], [1, 1]]",
                  "[[wall]]\nname = \"piston\"\npoints = [[0, 1], [0, -0.1]]\nforce = true\n"
                  "motion = { translation = { velocity = [0.5, 0] } }\n"
                  "[[wall]]\nname = \"floor\"\npoints = [[-0.1, 0], [1, 0]]\nforce = true"),
             "#output\n", "energy_ledger = true\n");
    const Finished run(piston, 2);
    REQUIRE(run.code == engine::success);
    const io::History history = run.results.history();
    const double piston_work = history.column("piston_work").back(), floor_work = history.column("floor_work").back(),
                 all = history.column("fluid_wall_work").back();
    CHECK(std::fabs(piston_work + floor_work - all) < 1e-9 * std::fabs(all));
    // Of the order of ∫ ½ ρ g H² v dt = 6.6 J/m, and positive.
    CHECK(piston_work > 2);
    CHECK(std::fabs(floor_work) < 0.2 * piston_work);
    CHECK(std::fabs(history.column("fluid_energy_residual").back()) < 1e-3 * piston_work);
}

TEST_CASE("what does not go together is refused with its line") {
    CHECK(refused("scheme = { riemann_solver = \"exact\" }\npolytropic_exponent = 1.4\n")
              .find("polytropic_exponent = 7") != std::string::npos);
    CHECK(refused("transport = { name = \"shifting\" }\n").find("riemann_ale") != std::string::npos);
    CHECK(refused("scheme = { name = \"delta_sph\", riemann_solver = \"exact\" }\n").find("Riemann schemes") !=
          std::string::npos);
    CHECK(refused("scheme = { delta = 0.2 }\n").find("does nothing") != std::string::npos);
    CHECK(refused("scheme = { name = \"riemann_ale\" }\n", "energy_ledger = true\n").find("ledger") !=
          std::string::npos);
    CHECK(refused("").empty());
}
