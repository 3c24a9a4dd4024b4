// The same mesh computed by CalculiX (ccx), an independent code, wherever it is installed: whole displacement fields.
// Its results are printed with seven digits.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "physics/solid/calculix_export.hpp"
#include "physics/solid/readers/calculix.hpp"
#include "tests/ccx.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;
using aquagraph::test::ccx_is_missing;

namespace {

// The displacements that ccx prints last.
template <int D>
std::vector<double> by_ccx(const Mesh<D>& mesh, const Options<D>& options, const CalculixRun& run) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("aquagraph_ccx_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    {
        std::ofstream deck(folder / "body.inp");
        write_calculix(deck, mesh, options, run);
    }
    const std::string command = "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 ccx -i body > body.log 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
    std::ifstream results(folder / "body.dat");
    std::vector<double> u(D * mesh.nodes.size(), std::nan(""));
    for (std::string line; std::getline(results, line);) {
        std::istringstream fields(line);
        std::size_t node = 0;
        std::array<double, 3> values{};
        if (!(fields >> node >> values[0] >> values[1] >> values[2])) continue;
        for (std::size_t d = 0; d < D; ++d) u[D * (node - 1) + d] = values[d];
    }
    std::filesystem::remove_all(folder);
    return u;
}

// The largest difference over the largest displacement.
double difference(std::span<const double> u, const std::vector<double>& other) {
    double largest = 0, apart = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
        largest = std::max(largest, std::abs(u[k]));
        apart = std::max(apart, std::isnan(other[k]) ? INFINITY : std::abs(u[k] - other[k]));
    }
    return apart / largest;
}

template <int D>
Options<D> soft() {
    Options<D> options;
    options.material.youngs_modulus = 1e7;
    options.material.poissons_ratio = 0.3;
    options.material.density = 1000;
    Clamp<D> clamp{"left", {}};
    clamp.fixed.fill(true);
    options.clamps = {clamp};
    return options;
}

}  // namespace

TEST_CASE("CalculiX: a cantilever bent by two thirds of its length; *ELASTIC with NLGEOM is Saint Venant-Kirchhoff") {
    if (ccx_is_missing()) return;
    CalculixRun run;
    run.is_static = true;
    run.step = 0.1;
    run.end = 1;
    run.print_every = 10;
    const Mesh<3> space = box_mesh({0, 0, 0}, {1, 0.1, 0.1}, {8, 2, 2});
    run.loads = {{traction_forces(space, "right", {0, 0, 3e4}), {}}};
    Solver<3> solver(space, soft<3>());
    solver.solve_static(run.loads[0].forces, serial_loop);
    CHECK(solver.displacements()[3 * std::size_t(space.node_set("right").back()) + 2] > 0.6);
    CHECK(difference(solver.displacements(), by_ccx(space, soft<3>(), run)) < 1e-6);

    const Mesh<2> plane = box_mesh({0, 0}, {1, 0.1}, 8, 2);
    run.loads = {{traction_forces(plane, "right", {0, 3e4}, 1e-3), {}}};
    for (const PlaneCondition condition : {PlaneCondition::strain, PlaneCondition::stress}) {
        Options<2> options = soft<2>();
        options.plane = condition;
        options.thickness = 1e-3;
        Solver<2> flat(plane, options);
        flat.solve_static(run.loads[0].forces, serial_loop);
        const double apart = difference(flat.displacements(), by_ccx(plane, options, run));
        // ccx makes solid elements of plane ones: their thickness changes along them, which costs energy unless it is
        // small.
        CHECK(apart < (condition == PlaneCondition::strain ? 1e-6 : 1e-4));
    }
}

TEST_CASE("CalculiX: a block of Mooney-Rivlin rubber, one of neo-Hookean, a body of two materials under its weight") {
    if (ccx_is_missing()) return;
    CalculixRun run;
    run.is_static = true;
    run.step = 0.1;
    run.end = 1;
    run.print_every = 10;
    Mesh<3> mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
    for (ElementIndex e = 0; e < 9; ++e) mesh.element_sets["foot"].push_back(e);
    Options<3> options = soft<3>();
    options.material.law = MaterialLaw::mooney_rivlin;
    options.material.c10 = 1e6;
    options.material.c01 = 0.3e6;
    options.material.bulk_modulus = 1e8;
    run.loads = {{traction_forces(mesh, "right", {1e6, 0, 5e5}), {}}};
    Solver<3> rubber(mesh, options);
    rubber.solve_static(run.loads[0].forces, serial_loop);
    CHECK(*std::max_element(rubber.displacements().begin(), rubber.displacements().end()) > 0.3);
    CHECK(difference(rubber.displacements(), by_ccx(mesh, options, run)) < 1e-6);

    options.material = soft<3>().material;
    options.material.law = MaterialLaw::neo_hookean;
    options.parts = {{"foot", options.material}};
    options.parts[0].material.youngs_modulus = 4e7;
    options.parts[0].material.density = 3000;
    options.gravity = {0, 3, -9.81};
    Solver<3> parts(mesh, options);
    parts.solve_static(run.loads[0].forces, serial_loop);
    CHECK(difference(parts.displacements(), by_ccx(mesh, options, run)) < 1e-6);
}

TEST_CASE("CalculiX: a beam in motion by Hilber, Hughes and Taylor") {
    if (ccx_is_missing()) return;
    const Mesh<3> mesh = box_mesh({0, 0, 0}, {1, 0.1, 0.1}, {6, 1, 1});
    CalculixRun run;
    run.step = 0.005;
    run.end = 0.25;
    run.print_every = 50;
    // What grows begins after the first step, which takes its loads as constant here.
    run.loads = {
        {traction_forces(mesh, "right", {0, 0, 5e3}), {}},
        {traction_forces(mesh, "right", {0, 2e3, 0}), [](double t) { return std::clamp(8 * (t - 0.005), 0.0, 1.0); }}};
    for (const Integration integration : {Integration::full, Integration::reduced}) {
        Options<3> options = soft<3>();
        options.integration = integration;
        options.alpha = -0.1;
        Solver<3> solver(mesh, options);
        std::vector<double> forces(run.loads[0].forces.size());
        for (int k = 1; k <= 50; ++k) {
            sum_at(run.loads, run.step * k, forces);
            solver.advance(run.step, forces, serial_loop);
        }
        CHECK(solver.displacements()[3 * std::size_t(mesh.node_set("right").back()) + 2] > 0.05);
        const double apart = difference(solver.displacements(), by_ccx(mesh, options, run));
        CAPTURE(apart);
        // The mass of C3D20R is integrated with 2 × 2 × 2 points there, with 3 × 3 × 3 here.
        CHECK(apart < (integration == Integration::full ? 2e-5 : 1e-3));
    }
}

TEST_CASE("a deck that is written is read back as the mesh it came from") {
    const Mesh<3> mesh = box_mesh({0, 0, 0}, {2, 1, 0.5}, {2, 1, 1});
    CalculixRun run;
    run.title = "there and back";
    run.step = run.end = 1;
    std::stringstream deck;
    write_calculix(deck, mesh, soft<3>(), run);
    const Mesh<3> back = read_calculix<3>(deck, "deck.inp");
    REQUIRE(back.nodes.size() == mesh.nodes.size());
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        for (std::size_t d = 0; d < 3; ++d) CHECK(back.nodes[n][d] == doctest::Approx(mesh.nodes[n][d]).epsilon(1e-12));
    CHECK(back.elements == mesh.elements);
    CHECK(back.node_set("CLAMP1") == mesh.node_set("left"));
}

TEST_CASE("what CalculiX has no equal for is refused") {
    CalculixRun run;
    run.step = run.end = 1;
    std::ostringstream deck;
    const Mesh<2> plane = box_mesh({0, 0}, {1, 1}, 1, 1);
    CHECK_THROWS_AS(write_calculix(deck, without_mid_side_nodes(plane), soft<2>(), run), std::invalid_argument);
    Options<2> options = soft<2>();
    options.scheme = Scheme::newmark;
    CHECK_THROWS_AS(write_calculix(deck, plane, options, run), std::invalid_argument);
    options = soft<2>();
    options.material.law = MaterialLaw::uniaxial_curve;
    CHECK_THROWS_AS(write_calculix(deck, plane, options, run), std::invalid_argument);
}
