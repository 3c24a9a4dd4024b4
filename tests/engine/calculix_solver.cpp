// A body computed by CalculiX, step by step, where it is installed: against solid::Solver, on its own and in water.
#include "engine/calculix_solver.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "engine/calculix_command.hpp"
#include "engine/calculix_results.hpp"
#include "physics/solid/dead_loads.hpp"
#include "tests/ccx.hpp"
#include "tests/engine/session.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

template <int D>
solid::Options<D> soft() {
    solid::Options<D> options;
    options.material.youngs_modulus = 1e7;
    options.material.poissons_ratio = 0.3;
    options.material.density = 1000;
    options.integration = solid::Integration::full;  // of the mass too, as in ccx
    options.alpha = 0;
    options.clamps.push_back({"left", {}});
    options.clamps.back().fixed.fill(true);
    return options;
}

template <class Values>
double largest(const Values& values) {
    double most = 0;
    for (const double x : values) most = std::max(most, std::fabs(x));
    return most;
}

double distance(std::span<const double> a, std::span<const double> b) {
    double apart = 0;
    for (std::size_t f = 0; f < a.size(); ++f) apart = std::max(apart, std::fabs(a[f] - b[f]));
    return apart;
}
double difference(std::span<const double> a, std::span<const double> b) {
    return distance(a, b) / largest(a);
}

}  // namespace

TEST_CASE("CalculiX takes a beam through forty steps as solid::Solver does, Newmark without damping") {
    if (ccx_is_missing()) return;
    const auto compare = [](auto mesh, auto options, auto traction, double dt) {
        constexpr int D = int(std::tuple_size_v<decltype(traction)>);
        solid::Solver<D> own(mesh, options);
        solid::Solver<D> shown(mesh, options);
        engine::CalculixSolver<D> other(shown, "ccx");
        const std::vector<double> full = traction_forces(mesh, "right", traction);
        std::vector<double> forces(full.size(), 0.0);
        own.solve_static(forces, serial_loop);
        other.solve_static(forces, serial_loop);
        double apart = 0, way = 0;
        for (int k = 1; k <= 40; ++k) {
            for (std::size_t f = 0; f < full.size(); ++f)
                forces[f] = full[f] * (1 - std::cos(0.1 * std::max(0, k - 1)));
            own.advance(dt, forces, serial_loop);
            other.advance(dt, forces, serial_loop);
            apart = std::max(apart, distance(own.displacements(), other.displacements()));
            way = std::max(way, largest(own.displacements()));
        }
        const solid::Energies a = own.energies(), b = other.energies();
        INFO("apart by ", apart, " m of ", way, " m; work ", a.external_work, " ", b.external_work, ", dissipated ",
             a.numerical, " ", b.numerical);
        CHECK(way > 0.02);
        CHECK(apart < 1e-4 * way);
        CHECK(b.external_work == doctest::Approx(a.external_work).epsilon(1e-4));
        CHECK(std::fabs(b.numerical) < 1e-3 * b.external_work);
        CHECK(other.statistics().steps == 40);
    };
    compare(solid::box_mesh({0, 0}, {1, 0.1}, 8, 2), soft<2>(), std::array<double, 2>{0, 5e3}, 0.005);
    solid::Options<3> heavy = soft<3>();
    heavy.gravity = {0, 0, -9.81};
    compare(solid::box_mesh({0, 0, 0}, {1, 0.1, 0.1}, {6, 1, 1}), heavy, std::array<double, 3>{0, 2e3, 5e3}, 0.005);
}

TEST_CASE("CalculiX starts from the equilibrium that solid::Solver finds, and goes on from what was saved") {
    if (ccx_is_missing()) return;
    const auto mesh = solid::box_mesh({0, 0}, {1, 0.1}, 8, 2);
    solid::Options<2> options = soft<2>();
    options.gravity = {0, -9.81};
    solid::Solver<2> own(mesh, options);
    solid::Solver<2> shown(mesh, options);
    engine::CalculixSolver<2> body(shown, "ccx");
    const std::vector<double> none(2 * mesh.nodes.size(), 0.0), forces = traction_forces(mesh, "right", {0.0, 1e3});
    own.solve_static(none, serial_loop);
    body.solve_static(none, serial_loop);
    CHECK(difference(own.displacements(), body.displacements()) < 1e-6);
    std::vector<double> stress(mesh.elements.size()), same(mesh.elements.size());
    own.element_stress(stress);
    shown.element_stress(same);
    CHECK(difference(stress, same) < 1e-4);

    body.advance(1e-3, forces, serial_loop);
    body.advance(1e-3, forces, serial_loop);
    solid::State saved;
    body.save(saved);
    body.advance(5e-3, none, serial_loop);
    const std::vector<double> u(body.displacements().begin(), body.displacements().end());
    body.restore(saved);
    CHECK(difference(u, body.displacements()) > 1e-3);
    body.advance(5e-3, none, serial_loop);
    CHECK(std::equal(u.begin(), u.end(), body.displacements().begin()));
    solid::Solver<2> also_shown(mesh, options);
    engine::CalculixSolver<2> another(also_shown, "ccx");
    another.restore(saved);
    another.advance(5e-3, none, serial_loop);
    CHECK(std::equal(u.begin(), u.end(), another.displacements().begin()));
}

namespace {

// A period of the plate, a row each cycle.
std::string water_on_plate(const std::string& coupling, const std::string& alpha = "0.0") {
    return with(
        with(with(plate, "end = 0.1", "end = 0.004"), "sound_speed", "cfl = 0.02\nsound_speed"), "[solid.box]",
        "integration = \"full\"\n[solid.scheme]\nalpha = " + alpha + "\n[coupling]\n" + coupling + "[solid.box]");
}
std::string by_calculix(const std::string& scene) {
    return with(scene, "name = \"plate\"\n", "name = \"plate\"\nsolver = \"calculix\"\n");
}

}  // namespace

TEST_CASE("water stands on a plate that CalculiX computes: side by side, one after the other, iterated") {
    if (ccx_is_missing()) return;
    // With α < 0 steps that find their first accelerations anew damp otherwise; CPS with α = 0 swings up.
    struct {
        std::string algorithm, alpha;
        double tolerance;
    } cases[] = {{"css", "0.0", 0.003}, {"cps", "-0.3", 0.05}, {"iterated", "0.0", 0.003}};
    for (const auto& [algorithm, alpha, tolerance] : cases) {
        CAPTURE(algorithm);
        const std::string scene = water_on_plate("algorithm = \"" + algorithm + "\"\n", alpha);
        const Finished own(scene), other(by_calculix(scene));
        INFO(other.err.str());
        REQUIRE(other.code == engine::success);
        const io::History first = own.results.history(), second = other.results.history();
        const auto a = first.column("mid_y"), b = second.column("mid_y");
        REQUIRE(a.size() == b.size());
        const double apart = difference(a, b);
        INFO(a.size(), " rows, deflection ", largest(a), " m, apart ", apart);
        CHECK(largest(a) > 5e-5);
        CHECK(apart < tolerance);
        CHECK(other.results.summary().at("solid").at("steps").get<long>() + 1 >= long(a.size()));
    }
}

TEST_CASE("a run with CalculiX goes on from its checkpoint with the same bits") {
    if (ccx_is_missing()) return;
    const ScratchFolder folder;
    const auto scene = folder.write("scene.toml", by_calculix(water_on_plate("algorithm = \"css\"\n", "-0.3")));
    std::string state;
    {
        Session<2> whole(scene, folder / "whole", 2);
        whole.run(8);
        state = whole.state();
    }
    {
        Session<2> first(scene, folder / "parts", 1);
        first.run(5);
        first.checkpoints.write({});
    }
    std::ostringstream said;
    const auto from = engine::find_restart_point(io::read_scene(scene), folder / "parts", "auto", said);
    REQUIRE(from);
    Session<2> second(scene, folder / "parts", 2, from);
    second.run(3);
    CHECK(second.state() == state);
}

TEST_CASE("the loads of a run, given to CalculiX at once, move the body as they did") {
    if (ccx_is_missing()) return;
    for (const char* algorithm : {"cps", "css"}) {
        CAPTURE(algorithm);
        const std::string scene = with(water_on_plate("algorithm = \"" + std::string(algorithm) + "\"\n", "-0.3"),
                                       "end = 0.004", "end = 0.0065") +  // whole steps of both algorithms
                                  "interface_loads = true\n";
        const Finished run(scene);
        REQUIRE(run.code == engine::success);
        const io::History history = run.results.history();
        const auto time = history.time(), mid = history.column("mid_y");
        const ScratchFolder folder;
        std::ostringstream out;
        engine::export_calculix(io::read_scene(folder.write("scene.toml", scene)), folder / "replay.inp",
                                run.results.path / "history.csv", out);
        const std::string place = (folder / ".").string();
        REQUIRE(std::system(("cd '" + place + "' && OMP_NUM_THREADS=1 ccx -i replay > log.txt 2>&1").c_str()) == 0);
        std::ifstream dat(folder / "replay.dat");
        std::vector<double> replayed;
        for (std::string line; std::getline(dat, line);) {
            std::istringstream row(line);
            double node = 0, x = 0, y = 0, z = 0;
            if (row >> node >> x >> y >> z) replayed.push_back(y);
        }
        REQUIRE(replayed.size() == mid.size() - 1);
        // ccx takes equal steps.
        const double step = time.back() / double(mid.size() - 1);
        double apart = 0;
        for (std::size_t k = 1; k < mid.size(); ++k) {
            CHECK(std::fabs(time[k] - step * double(k)) < 0.2 * step);
            const double slope = (mid[k] - mid[k - 1]) / (time[k] - time[k - 1]);
            apart = std::max(apart, std::fabs(mid[k] + slope * (step * double(k) - time[k]) - replayed[k - 1]));
        }
        INFO("apart by ", apart, " m of ", largest(mid), " m, ", mid.size() - 1, " steps");
        CHECK(apart < 2e-3 * largest(mid));
    }
    const ScratchFolder folder;
    std::ostringstream out;
    const auto scene = io::read_scene(folder.write("scene.toml", plate));
    CHECK_THROWS_WITH_AS(
        engine::export_calculix(scene, folder / "x.inp", folder.write("h.csv", "time[s]\n0\n1\n"), out),
        doctest::Contains("interface_loads = true"), std::runtime_error);
}

TEST_CASE("results of ccx that cannot be used are refused, saying why") {
    const auto refused = [](const std::string& text) -> std::string {
        std::istringstream dat(text);
        try {
            engine::read_calculix_results<2>(dat, 2);
        } catch (const engine::CalculixResultsError& error) {
            return error.what();
        }
        return {};
    };
    const std::string u = " displacements (vx,vy,vz) for set ALL and time  0.1E+01\n\n",
                      v = " velocities (vx,vy,vz) for set ALL and time  0.1E+01\n\n",
                      rows = "  1  1.0E-01  2.0E-01  0.0\n  2  3.0E-01 -4.0E+00  0.0\n\n";
    std::istringstream dat(u + "  1  9.  9.  9.\n\n" + u + rows + v + rows + " total internal energy\n\n  3.0\n");
    const engine::CalculixResults results = engine::read_calculix_results<2>(dat, 2);
    CHECK(results.displacements == std::vector<double>{0.1, 0.2, 0.3, -4});
    CHECK(results.velocities == results.displacements);
    CHECK(refused("") == "there is no displacement of any node");
    CHECK(refused(u + rows) == "there is no velocity of any node");
    CHECK(refused(u + rows + v + "  1  1.0  2.0  0.0\n") == "the velocity of node 2 is missing or no number");
    CHECK(refused(u + "  1  NaN  2.0  0.0\n  2  1.0  1.0  0.0\n" + v + rows) ==
          "the displacement of node 1 is missing or no number");
    CHECK(refused(u + "  1  *******  2.0  0.0\n  2  1.0  1.0  0.0\n" + v + rows) ==
          "the displacement of node 1 is missing or no number");
    CHECK(refused(u + rows + "  3  1.0  1.0  0.0\n") == "there is a node 3, the mesh has 2");
}
