// The solver as the coupling sees it: same bits on any number of threads and after a restart, no allocation, clear
// errors.
#include "physics/solid/solver.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/solid/allocation_count.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

Options<2> gate_options() {
    Options<2> options;
    options.material.law = MaterialLaw::neo_hookean;
    options.material.youngs_modulus = 11.96e6;
    options.material.poissons_ratio = 0.4;
    options.material.density = 1100;
    options.gravity = {0, -9.81};
    options.clamps = {{"top", {true, true}}};
    return options;
}

Mesh<2> gate_mesh() {
    return box_mesh({0, 0}, {0.005, 0.079}, 4, 40);
}

template <class Check>
void with_message(const std::string& part, const Check& check) {
    std::string message;
    try {
        check();
    } catch (const std::exception& error) {
        message = error.what();
    }
    CHECK_MESSAGE(message.find(part) != std::string::npos, "message: ", message);
}

}  // namespace

TEST_CASE("bitwise the same on 1, 2 and 4 threads") {
    const Mesh<2> mesh = box_mesh({0, 0}, {0.02, 0.08}, 24, 96);  // 2304 elements: several blocks of everything
    const Options<2> options = gate_options();
    std::vector<double> serial;
    for (const unsigned threads : {0u, 1u, 2u, 4u}) {
        Solver<2> solver(mesh, options);
        const ThreadedLoop threaded{threads};
        const BlockLoop loop = threads == 0 ? BlockLoop(serial_loop) : BlockLoop(threaded);
        const auto load = traction(mesh, "left", {2000, 0});
        solver.solve_static(no_load(mesh), loop);
        for (int k = 0; k < 4; ++k) solver.advance(1e-4, load, loop);
        std::vector<double> result = copy(solver.positions());
        const auto v = copy(solver.velocities()), a = copy(solver.accelerations());
        result.insert(result.end(), v.begin(), v.end());
        result.insert(result.end(), a.begin(), a.end());
        if (threads == 0) serial = result;
        CHECK(result == serial);
    }
}

TEST_CASE("a restart continues with the same bits, through other step sizes and loads") {
    const Mesh<2> mesh = gate_mesh();
    const auto load = traction(mesh, "left", {700, 0});
    const auto go = [&](Solver<2>& solver, int first, int last) {
        std::vector<double> now(load.size());
        for (int k = first; k < last; ++k) {
            for (std::size_t f = 0; f < now.size(); ++f) now[f] = load[f] * (1 + 0.3 * std::sin(0.7 * k));
            solver.advance(1e-4 * (1 + 0.1 * (k % 5)), now, serial_loop);
        }
    };
    Solver<2> straight(mesh, gate_options());
    State state;
    go(straight, 0, 37);
    straight.save(state);
    Solver<2> restarted(mesh, gate_options());
    go(restarted, 0, 3);  // whatever it did before must not matter
    restarted.restore(state);
    CHECK(copy(straight.positions()) == copy(restarted.positions()));
    go(straight, 37, 120);
    go(restarted, 37, 120);
    CHECK(copy(straight.positions()) == copy(restarted.positions()));
    CHECK(copy(straight.velocities()) == copy(restarted.velocities()));
    CHECK(copy(straight.accelerations()) == copy(restarted.accelerations()));
    CHECK(straight.statistics().newton_iterations == restarted.statistics().newton_iterations);
    CHECK(straight.statistics().factorisations == restarted.statistics().factorisations);
    CHECK(straight.energies().external_work == restarted.energies().external_work);

    // Back to the same state where the factorisation is in use, and where another one is.
    State later;
    straight.save(later);
    for (Solver<2>* solver : {&straight, &restarted}) {
        solver->restore(state);
        go(*solver, 37, 120);
        State again;
        solver->save(again);
        CHECK(again.displacements == later.displacements);
        CHECK(again.accelerations == later.accelerations);
        CHECK(again.statistics.factorisations == later.statistics.factorisations);
        solver->restore(later);
    }

    State wrong = state;
    wrong.velocities.pop_back();
    CHECK_THROWS_AS(restarted.restore(wrong), std::invalid_argument);
}

TEST_CASE("saved before the first step and after a static solve, it also continues with the same bits") {
    const Mesh<2> mesh = gate_mesh();
    const auto load = traction(mesh, "left", {700, 0});
    Solver<2> straight(mesh, gate_options()), restarted(mesh, gate_options());
    straight.solve_static(no_load(mesh), serial_loop);
    State state;
    straight.save(state);
    restarted.restore(state);
    for (Solver<2>* solver : {&straight, &restarted})
        for (int k = 0; k < 5; ++k) solver->advance(1e-4, load, serial_loop);
    CHECK(copy(straight.accelerations()) == copy(restarted.accelerations()));
}

TEST_CASE("a step allocates nothing while its factorisation is reused, CHOLMOD included") {
    const CountCholmodToo counting;
    const Mesh<2> mesh = gate_mesh();
    Solver<2> solver(mesh, gate_options());
    const auto load = traction(mesh, "left", {50, 0});
    for (int k = 0; k < 20; ++k) solver.advance(2e-5, load, serial_loop);
    const Statistics before = solver.statistics();
    const long counted = allocations();
    for (int k = 0; k < 20; ++k) solver.advance(2e-5, load, serial_loop);
    const long made = allocations() - counted;
    CHECK(solver.statistics().factorisations == before.factorisations);
    CHECK(solver.statistics().newton_iterations > before.newton_iterations);
    CHECK(made == 0);
}

TEST_CASE("an explicit step of a wheel on the ground, damped, allocates nothing") {
    const CountCholmodToo counting;
    const Mesh<2> mesh = box_mesh({0, 0}, {0.2, 0.1}, 4, 2);
    Options<2> options = gate_options();
    options.clamps = {};
    options.scheme = Scheme::central_difference;
    options.mass_damping = 1;
    options.stiffness_damping = 1e-7;
    options.rigid_bodies = {{.set = "top", .mass = 1}};
    options.contacts = {{"bottom", {.point = {0, 0}, .direction = {0, 1}}, 0.5}};
    Solver<2> solver(mesh, options);
    const double dt = solver.largest_stable_step();
    for (int k = 0; k < 5; ++k) solver.advance(dt, no_load(mesh), serial_loop);
    const auto load = no_load(mesh);
    const long counted = allocations();
    for (int k = 0; k < 20; ++k) solver.advance(dt, load, serial_loop);
    CHECK(allocations() - counted == 0);
}

TEST_CASE("the factorisation is reused, also when the step changes a little, and renewed when it changes much") {
    const Mesh<2> mesh = gate_mesh();
    const auto load = traction(mesh, "left", {50, 0});
    Solver<2> constant(mesh, gate_options()), changing(mesh, gate_options());
    for (int k = 0; k < 40; ++k) {
        constant.advance(2e-5, load, serial_loop);
        changing.advance(2e-5 * (1 + 0.01 * (k % 3)), load, serial_loop);
    }
    CHECK(constant.statistics().factorisations == 2);  // the mass for the first acceleration, then the step
    CHECK(changing.statistics().factorisations <= 3);
    constant.advance(6e-5, load, serial_loop);
    CHECK(constant.statistics().factorisations == 3);
    CHECK(constant.statistics().last_residual < 1e-8);
}

TEST_CASE("a reused factorisation leads to the same motion as a new one at every step") {
    const Mesh<2> mesh = gate_mesh();
    const auto load = traction(mesh, "left", {700, 0});
    Solver<2> reusing(mesh, gate_options()), renewing(mesh, gate_options());
    State state;
    for (int k = 0; k < 200; ++k) {
        reusing.advance(2e-4, load, serial_loop);
        renewing.save(state);
        state.factor_valid = false;  // forces a factorisation
        renewing.restore(state);
        renewing.advance(2e-4, load, serial_loop);
    }
    double largest = 0, difference = 0;
    for (std::size_t f = 0; f < load.size(); ++f) {
        largest = std::max(largest, std::abs(renewing.displacements()[f]));
        difference = std::max(difference, std::abs(renewing.displacements()[f] - reusing.displacements()[f]));
    }
    CHECK(largest > 0.02);  // a large motion
    CHECK(difference < 1e-6 * largest);
    CHECK(reusing.statistics().factorisations < renewing.statistics().factorisations / 2);
}

TEST_CASE("the first acceleration balances the first load") {
    Options<2> options = gate_options();
    options.clamps.clear();
    const Mesh<2> mesh = gate_mesh();
    Solver<2> solver(mesh, options);
    solver.advance(1e-6, no_load(mesh), serial_loop);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        CHECK(std::abs(solver.accelerations()[2 * n]) < 1e-8);
        CHECK(solver.accelerations()[2 * n + 1] == doctest::Approx(-9.81).epsilon(1e-9));
    }
}

TEST_CASE("at rest it stays at rest, in equilibrium it stays there") {
    const Mesh<2> mesh = gate_mesh();
    Options<2> options = gate_options();
    Solver<2> hanging(mesh, options);
    hanging.solve_static(no_load(mesh), serial_loop);
    const auto before = copy(hanging.displacements());
    for (int k = 0; k < 50; ++k) hanging.advance(1e-4, no_load(mesh), serial_loop);
    const double stretch = std::abs(before[2 * nearest_node(mesh, 0, 0) + 1]);
    CHECK(stretch > 1e-6);
    for (std::size_t f = 0; f < before.size(); ++f)
        CHECK(std::abs(hanging.displacements()[f] - before[f]) < 1e-6 * stretch);
    options.gravity = {};
    Solver<2> resting(mesh, options);
    resting.advance(1e-4, no_load(mesh), serial_loop);
    for (const double u : resting.displacements()) CHECK(u == 0);
}

TEST_CASE("long steps converge too") {  // far beyond what the predictor stands: the plate takes its water load at once
    Options<2> options;
    options.material.youngs_modulus = 67.5e9;
    options.material.poissons_ratio = 0.34;
    options.material.density = 2700;
    options.clamps = {{"left", {true, true}}, {"right", {true, true}}};
    const Mesh<2> mesh = box_mesh({0, 0}, {1, 0.05}, 40, 4);
    const auto load = traction(mesh, "top", {0, -1000 * 9.81 * 2});
    Solver<2> solver(mesh, options), still(mesh, options);
    for (int k = 0; k < 200; ++k) solver.advance(0.01, load, serial_loop);
    still.solve_static(load, serial_loop);
    const std::size_t middle = 2 * nearest_node(mesh, 0.5, 0.025) + 1;
    CHECK(solver.displacements()[middle] == doctest::Approx(still.displacements()[middle]).epsilon(1e-6));
}

TEST_CASE("a load that cannot be borne is an error, and the solver stays where it was") {
    const Mesh<2> mesh = gate_mesh();
    Solver<2> solver(mesh, gate_options());
    for (int k = 0; k < 5; ++k) solver.advance(1e-4, no_load(mesh), serial_loop);
    const auto u = copy(solver.displacements()), v = copy(solver.velocities()), a = copy(solver.accelerations());
    auto load = traction(mesh, "left", {700, 0});
    load[6] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(solver.advance(1e-4, load, serial_loop), ConvergenceError);
    with_message("in step 6", [&] { solver.advance(1e-4, load, serial_loop); });
    with_message("not finite", [&] { solver.advance(1e-4, load, serial_loop); });
    with_message("Reduce the time step", [&] { solver.advance(1e-4, traction(mesh, "left", {1e12, 0}), serial_loop); });
    with_message("no static equilibrium", [&] {
        solver.solve_static(traction(mesh, "bottom", {0, 1e9}), serial_loop);
    });
    CHECK(copy(solver.displacements()) == u);
    CHECK(copy(solver.velocities()) == v);
    CHECK(copy(solver.accelerations()) == a);
    Solver<2> twin(mesh, gate_options());
    for (int k = 0; k < 5; ++k) twin.advance(1e-4, no_load(mesh), serial_loop);
    State state;
    twin.save(state);
    state.factor_valid = false;  // a step that fails leaves none
    twin.restore(state);
    twin.advance(1e-4, no_load(mesh), serial_loop);
    solver.advance(1e-4, no_load(mesh), serial_loop);
    CHECK(copy(solver.accelerations()) == copy(twin.accelerations()));
}

TEST_CASE("a body that nothing holds has no static equilibrium") {
    Options<2> options = gate_options();
    options.clamps.clear();
    const Mesh<2> mesh = gate_mesh();
    Solver<2> solver(mesh, options);
    with_message("clamp", [&] { solver.solve_static(no_load(mesh), serial_loop); });
    with_message("not positive definite", [&] { solver.solve_static(no_load(mesh), serial_loop); });
}

TEST_CASE("options out of range are refused") {
    const Mesh<2> mesh = gate_mesh();
    const auto refused = [&](const std::string& part, const auto& change) {
        Options<2> options = gate_options();
        change(options);
        CHECK_THROWS_AS(Solver<2>(mesh, options), std::invalid_argument);
        with_message(part, [&] { Solver<2>(mesh, options); });
    };
    refused("Young", [](Options<2>& o) { o.material.youngs_modulus = 0; });
    refused("Poisson", [](Options<2>& o) { o.material.poissons_ratio = 0.5; });
    refused("density", [](Options<2>& o) { o.material.density = -1; });
    refused("thickness", [](Options<2>& o) { o.thickness = 0; });
    refused("alpha", [](Options<2>& o) { o.alpha = 0.1; });
    refused("alpha", [](Options<2>& o) { o.alpha = -1.0 / 3; });
    refused("it has: bottom, left, right, top", [](Options<2>& o) { o.clamps = {{"roof", {true, true}}}; });
    refused("plane strain only", [](Options<2>& o) { o.plane = PlaneCondition::stress; });
    Solver<2> solver(mesh, gate_options());
    CHECK_THROWS_AS(solver.advance(0, no_load(mesh), serial_loop), std::invalid_argument);
    CHECK_THROWS_AS(solver.advance(1e-4, std::vector<double>(3), serial_loop), std::invalid_argument);
    CHECK_THROWS_AS(solver.solve_static(std::vector<double>(3), serial_loop), std::invalid_argument);
    std::vector<double> stress(3);
    CHECK_THROWS_AS(solver.element_stress(stress), std::invalid_argument);
    CHECK(solver.largest_stable_step() == std::numeric_limits<double>::infinity());
}

TEST_CASE("von Mises stress of a cantilever is that of beam theory") {
    Options<2> options = gate_options();
    options.material.law = MaterialLaw::saint_venant_kirchhoff;
    options.material.poissons_ratio = 0;
    options.gravity = {};
    options.clamps = {{"left", {true, true}}};
    constexpr double L = 1, h = 0.1, P = 1e-3;
    const Mesh<2> mesh = box_mesh({0, 0}, {L, h}, 40, 8);
    Solver<2> solver(mesh, options);
    solver.solve_static(traction(mesh, "right", {0, P / h}), serial_loop);
    std::vector<double> stress(mesh.elements.size());
    solver.element_stress(stress);
    const double x = 0.5 / 40, y = h / 2 - h / 16;  // centre of the lowest element at the clamp: σ = P (L - x) y / I
    const double expected = P * (L - x) * y / (h * h * h / 12);
    CHECK(stress[8] == doctest::Approx(expected * (L - 1.5 / 40) / (L - x)).epsilon(0.03));
}
