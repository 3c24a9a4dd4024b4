// Walls of normal fluxes, end to end: from the scene file through the listing of a step.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/model_run.hpp"

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

TEST_CASE("what walls of normal fluxes do not go with is said, with what to do") {
    const auto expect = [](const std::string& old, const std::string& replacement, const std::string& message) {
        CAPTURE(message);
        const std::string error = refusal(with(basin, old, replacement));
        CHECK(error.find(message) != std::string::npos);
        CHECK(error.find("ghosts") != std::string::npos);
        CHECK(error.find("scene.toml:10:") != std::string::npos);
    };
    expect("[[fluid.box]]", "[fluid.scheme]\nname = \"riemann_ale\"\n[[fluid.box]]", "need Riemann-SPH");
    expect("[[fluid.box]]", "[fluid.scheme]\nname = \"delta_sph\"\n[[fluid.box]]", "need Riemann-SPH");
    expect("[[fluid.box]]", "[output]\nenergy_ledger = true\n[[fluid.box]]", "energy ledger");
    expect("[[fluid.box]]", "[fluid.viscosity]\ndynamic = 1\n[[fluid.box]]", "Monaghan and Gingold");
    CHECK(refusal(with(basin, "[[fluid.box]]", "[fluid.viscosity]\ndynamic = 1\noperator = \"morris\"\n[[fluid.box]]"))
              .empty());
    CHECK(refusal(with(with(basin, "max = [1.5, 1.5]\n[fluid]", "max = [1.5, 1.5]\nperiodic = [\"x\"]\n[fluid]"),
                       "[[fluid.box]]", "[[fluid.box]]"))
              .find("no images in a periodic domain") != std::string::npos);
    const std::string coupled = with(gate, "sound_speed = 30.0", "sound_speed = 30.0\nwalls = \"normal_flux\"");
    CHECK(refusal(coupled).empty());
    CHECK(refusal(with(coupled, "ratio = 1", "load = \"energy_conservative\"")).find("does not know the work") !=
          std::string::npos);
    CHECK(refusal(with(coupled, "\"cps\"", "\"iterated\"")).find("go back to the start") != std::string::npos);
}
