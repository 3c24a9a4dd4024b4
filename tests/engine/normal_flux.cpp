// Walls of normal fluxes, end to end: from the scene file through the listing of a step.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/model_run.hpp"
#include "tests/io/refusal.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

std::string with_normal_flux(const std::string& scene) {
    return with(scene, "[[fluid.box]]", "walls = \"normal_flux\"\n[[fluid.box]]");
}
const std::string basin = with_normal_flux(with(walled_basin, "end = 0.02", "end = 0.2"));

}  // namespace

TEST_CASE("still water between walls of normal fluxes, whatever kernel and integration, and what the walls bear") {
    const double weight = 1000 * 9.81, root = std::sqrt(9.81);
    const auto check = [&](const std::string& choice, double most) {
        CAPTURE(choice);
        const ModelRun<2> run(with(basin, "walls = \"normal_flux\"", "walls = \"normal_flux\"\n" + choice));
        const double fastest = run.fastest() / root;
        MESSAGE(choice << ": fastest " << fastest);
        CHECK(fastest < most);
        const std::vector<double> row = run.row();
        CHECK(row[0] == Approx(-0.5 * weight).epsilon(0.02));
        CHECK(std::fabs(row[1]) < 1e-9 * weight);
        CHECK(std::fabs(row[2]) < 1e-9 * weight);
        CHECK(row[3] == Approx(-weight).epsilon(0.02));
        CHECK(row[4] == Approx(0.5 * weight).epsilon(0.02));
        CHECK(run.model->fluid->held_back == 0);
        CHECK(run.model->flux_walls->floor_count == 0);
    };
    check("", 0.002);
    check("kernel = \"cubic_spline\"", 0.002);
    check("integration = \"rk3\"", 0.002);
    check("integration = \"verlet\"", 0.002);
    check("scheme.name = \"delta_sph\"\nscheme.alpha = 0.2", 0.002);
    check("scheme.name = \"riemann_ale\"\ntransport.name = \"shifting\"", 0.002);
}

TEST_CASE("schemes that do not keep water still between walls of normal fluxes are refused") {
    const auto said = [](const std::string& choice) {
        return refusal(with(basin, "walls = \"normal_flux\"", "walls = \"normal_flux\"\n" + choice));
    };
    CHECK(said("scheme.name = \"artificial_viscosity\"").find("without diffusion of density") != std::string::npos);
    const std::string weak = said("scheme.name = \"delta_sph\"");
    CHECK(weak.find("with less than delta = 0.1 and alpha = 0.2") != std::string::npos);
    CHECK(weak.find("help: give [fluid.scheme] alpha = 0.2") != std::string::npos);
    CHECK(said("scheme.name = \"delta_sph\"\nscheme.alpha = 0.2\nscheme.delta = 0.05") != "");
    CHECK(said("scheme.name = \"delta_sph\"\nscheme.alpha = 0.2") == "");
}

TEST_CASE("a piston of normal fluxes pushes the water along") {
    const std::string channel = with(piston_channel, "end = 0.6", "end = 0.4");
    const ModelRun<2> run(with_normal_flux(channel)), ghosts(channel);
    const auto level_near_piston = [](const ModelRun<2>& of) {  // momentum and mass centre
        const auto& s = of.model->fluid->particles;
        double momentum = 0, centre = 0, mass = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            momentum += s.mass[i] * s.v[0][i];
            centre += s.mass[i] * s.x[0][i];
            mass += s.mass[i];
        }
        return std::array<double, 2>{momentum, centre / mass};
    };
    const double at = run.model->flux_walls->panels.position[3].x();
    CHECK(at == Approx(0.25 * 0.35).epsilon(1e-6));
    CHECK(run.model->flux_walls->deepest(run.model->fluid->particles).depth < 0.01 * 0.02);
    const auto& s = run.model->fluid->particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        CHECK(s.x[0][i] > at);
        CHECK(s.x[1][i] > 0);
    }
    const auto own = level_near_piston(run), other = level_near_piston(ghosts);
    MESSAGE("momentum " << own[0] << ", ghosts " << other[0] << "; centre " << own[1] << ", ghosts " << other[1]);
    CHECK(own[0] == Approx(other[0]).epsilon(0.03));
    CHECK(own[1] == Approx(other[1]).epsilon(0.002));
}

TEST_CASE("friction on a floor of normal fluxes slows a sliding layer down as theory has it") {
    // Water slides at U over a floor that it sticks to, under a lid of free slip at h:
    // v = U Σ 2/k sin(k y/h) exp(-ν k² t/h²), k = (n + ½) π.
    const double U = 0.5, h = 0.2, nu = 0.02, t = 0.4;
    const std::string scene = R"(schema_version = 1
gravity = [0, 0]
[time]
end = 0.4
[domain]
min = [-0.5, -0.5]
max = [2.0, 0.5]
[fluid]
spacing = 0.02
sound_speed = 10
walls = "normal_flux"
[fluid.viscosity]
dynamic = 20
operator = "morris"
[[fluid.box]]
min = [0, 0]
max = [1.2, 0.2]
[fluid.initial]
velocity = ["0.5", "0"]
[[wall]]
name = "floor"
points = [[-0.3, 0], [1.8, 0]]
slip = "none"
force = true
[[wall]]
name = "lid"
points = [[1.8, 0.2], [-0.3, 0.2]]
)";
    const auto series = [&](auto&& of_mode) {
        double sum = 0;
        for (int n = 0; n < 30; ++n) {
            const double k = (n + 0.5) * 3.14159265358979324;
            sum += of_mode(k) * std::exp(-nu * k * k * t / (h * h));
        }
        return sum;
    };
    const double expected = series([&](double) { return 1000 * nu * U * 2 / h; }) * 1.2;
    struct Errors {
        double velocity, friction;
    };
    const auto errors = [&](const std::string& spacing) -> Errors {
        const ModelRun<2> run(with(scene, "spacing = 0.02", "spacing = " + spacing));
        const auto& s = run.model->fluid->particles;
        double error2 = 0, scale2 = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            if (s.x[0][i] < 0.4 || s.x[0][i] > 1.0) continue;  // away from the ends, which are free surfaces
            const double v = series([&](double k) { return U * 2 / k * std::sin(k * s.x[1][i] / h); });
            error2 += (s.v[0][i] - v) * (s.v[0][i] - v);
            scale2 += v * v;
        }
        return {std::sqrt(error2 / scale2), run.row()[0] / expected - 1};
    };
    const Errors coarse = errors("0.02"), fine = errors("0.01");  // 10 and 20 particles across
    MESSAGE("velocity " << coarse.velocity << ", " << fine.velocity << "; friction " << coarse.friction << ", "
                        << fine.friction);
    CHECK(fine.velocity < 0.6 * coarse.velocity);
    CHECK(std::fabs(fine.friction) < 0.6 * std::fabs(coarse.friction));
    CHECK(std::fabs(fine.friction) < 0.03);
}

namespace {

const std::string plates_of_fluxes = with(plates, "[fluid]\n", "[fluid]\nwalls = \"normal_flux\"\n");

}  // namespace

TEST_CASE("Poiseuille's flow between walls of normal fluxes in a periodic domain") {
    const double F = 0.8, nu = 0.1, t = 1, pi = 3.14159265358979324;
    const auto exact = [&](double y) {
        double v = F / (2 * nu) * y * (1 - y);
        for (int n = 1; n < 40; n += 2)
            v -= 4 * F / (nu * std::pow(n * pi, 3)) * std::sin(n * pi * y) * std::exp(-std::pow(n * pi, 2) * nu * t);
        return v;
    };
    const std::string driven =
        with(plates_of_fluxes, "sound_speed = 10\n", "sound_speed = 10\ndriving_force = [0.8, 0]\n");
    struct Errors {
        double velocity, friction;
    };
    const auto errors = [&](const std::string& form, const std::string& spacing) -> Errors {
        const ModelRun<2> run(with(with(driven, "spacing = 0.05", "spacing = " + spacing), "morris", form));
        const auto& s = run.model->fluid->particles;
        double error2 = 0, scale2 = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            const double v = exact(s.x[1][i]);
            error2 += (s.v[0][i] - v) * (s.v[0][i] - v);
            scale2 += v * v;
        }
        const double dy = 1e-6, friction = 1000 * nu * exact(dy) / dy;  // of the lower plate, µ dv/dy
        return {std::sqrt(error2 / scale2), run.row()[0] / friction - 1};
    };
    for (const std::string form : {"morris", "monaghan_gingold"}) {
        const Errors coarse = errors(form, "0.05"), fine = errors(form, "0.025");
        MESSAGE(form << ": velocity " << coarse.velocity << ", " << fine.velocity << "; friction " << coarse.friction
                     << ", " << fine.friction);
        CHECK(fine.velocity < 0.5 * coarse.velocity);
        CHECK(fine.velocity < 0.02);
        CHECK(std::fabs(coarse.friction) < 0.03);
        CHECK(std::fabs(fine.friction) < 0.022);
    }
}

TEST_CASE("Couette's flow next to both plates, and where viscosity limits the step, by both operators") {
    // The upper plate at U: U y. ν = 2 m²/s: after 0.5 s nothing is left of the start, and the step is that of
    // viscosity.
    const double U = 0.001;
    const std::string scene = with_upper_plate_at(
        with(with(plates_of_fluxes, "dynamic = 100", "dynamic = 2000"), "end = 1.0", "end = 0.5"), "0.001");
    for (const std::string form : {"morris", "monaghan_gingold"}) {
        const ModelRun<2> run(with(scene, "morris", form));
        const auto& s = run.model->fluid->particles;
        double worst = 0;
        for (std::size_t i = 0; i < s.count; ++i) worst = std::max(worst, std::fabs(s.v[0][i] - U * s.x[1][i]) / U);
        MESSAGE(form << ": velocity off by " << worst << " of the plate's");
        CHECK(worst < 0.01);
        const double friction = run.row()[0] / (2000 * U) - 1;  // µ U/H on the lower plate, 1 m long
        MESSAGE("friction off by " << friction);
        CHECK(std::fabs(friction) < 0.03);
    }
}

TEST_CASE("the energy ledger of a piston of normal fluxes closes, and works of walls add up") {
    const std::string ledger = with(with_normal_flux(with(piston_channel, "end = 0.6", "end = 0.1")), "[[fluid.box]]",
                                    "[output]\nenergy_ledger = true\n[[fluid.box]]");
    const std::string measured = with(with(ledger, "name = \"channel\"\n", "name = \"channel\"\nforce = true\n"),
                                      "name = \"piston\"\n", "name = \"piston\"\nforce = true\n");
    const auto residual = [&](const std::string& scene) {
        const ModelRun<2> run(scene);
        const auto& model = *run.model;
        const auto& sum = model.fluid->ledger.sum;
        REQUIRE(model.wall_works.size() == 2);
        CHECK(model.wall_works[0].ledger.sum.walls == 0);
        CHECK(model.wall_works[1].ledger.sum.walls == Approx(sum.walls).epsilon(1e-12));
        CHECK(sum.walls > 0);
        CHECK(std::fabs(sum.defect) < 0.1 * sum.walls);
        const ModelRun<2> start(with(scene, "end = 0.1", "end = 1e-9"));
        const auto now = total_energies(*model.fluid), before = total_energies(*start.model->fluid);
        const double gained = now.kinetic + now.potential - before.kinetic - before.potential;
        return std::fabs(gained + sum.compression + sum.dissipation + sum.defect + model.fluid->ledger.lost -
                         sum.walls) /
               sum.walls;
    };
    const double coarse = residual(measured),
                 fine = residual(with(measured, "sound_speed = 20.0", "sound_speed = 20.0\ncfl = 0.1"));
    MESSAGE("residual over the piston's work " << coarse << ", " << fine);
    CHECK(coarse < 0.01);
    CHECK(fine < 0.2 * coarse);
}

TEST_CASE("the balance of water and a body with walls of normal fluxes closes with the time step") {
    const auto peak = [](std::span<const double> values) {
        double largest = 0;
        for (const double v : values) largest = std::max(largest, std::fabs(v));
        return largest;
    };
    const auto finished = [&](const std::string& load, const std::string& cfl) {
        std::string scene =
            with(gate, "sound_speed = 30.0",
                 "sound_speed = 30.0\nwalls = \"normal_flux\"\ncfl = " + cfl + "\nscheme.reconstruction = \"none\"");
        scene = with(scene, "[coupling]\n", "[coupling]\nstep_fraction = 1.0\nload = \"" + load + "\"\n");
        const Finished run(with(scene, "[output]\n", "[output]\nenergy_ledger = true\n"));
        REQUIRE(run.code == engine::success);
        return run.results.history();
    };
    const io::History coarse = finished("force_conservative", "0.375"), fine = finished("force_conservative", "0.1");
    const double residual = peak(coarse.column("total_energy_residual")),
                 finer = peak(fine.column("total_energy_residual")),
                 dissipated = peak(fine.column("fluid_dissipated_energy"));
    MESSAGE("residual " << residual << " and " << finer << " J/m of " << dissipated << " J/m dissipated, defect "
                        << fine.column("flux_wall_defect").back());
    CHECK(finer < 0.1 * residual);
    CHECK(finer < 1e-3 * dissipated);
    // Work on the water, seen from either side.
    const double force =
        std::fabs(coarse.column("interface_energy").back() / coarse.column("interface_from_body_energy").back());
    const io::History corrected = finished("energy_conservative", "0.375");
    const double energy =
        std::fabs(corrected.column("interface_energy").back() / corrected.column("interface_from_body_energy").back());
    MESSAGE("E_Interface over what the body gives: force " << force << ", energy " << energy);
    CHECK(energy < 0.5 * force);
    CHECK(force < 0.2);
}

TEST_CASE("what walls of normal fluxes do not go with is said, with what to do") {
    const auto expect = [](const std::string& old, const std::string& replacement, const std::string& message) {
        CAPTURE(message);
        const std::string error = refusal(with(basin, old, replacement));
        CHECK(error.find(message) != std::string::npos);
        CHECK(error.find("ghosts") != std::string::npos);
        CHECK(error.find("scene.toml:10:") != std::string::npos);
    };
    expect("[[fluid.box]]", "[fluid.scheme]\nname = \"artificial_viscosity\"\n[[fluid.box]]", "without diffusion");
    expect("[[fluid.box]]", "[fluid.scheme]\nname = \"delta_sph\"\n[[fluid.box]]", "alpha = 0.2");
    const std::string coupled = with(gate, "sound_speed = 30.0", "sound_speed = 30.0\nwalls = \"normal_flux\"");
    CHECK(refusal(coupled).empty());
    CHECK(refusal(with(coupled, "\"cps\"", "\"iterated\"")).empty());
}
