// Prescribed motions and rigid bodies: against a clamped body in the frame that moves, closed forms, balances.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/solid/wheels.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

Options<2> rubber() {
    Options<2> options = soft_rubber<2>();
    options.residual_tolerance = 1e-11;
    options.increment_tolerance = 1e-9;
    return options;
}

// A beam whose root is shaken, and its twin with a clamped root under the forces of inertia of the shaken frame:
// largest difference of their displacements, in terms of the largest displacement, and of their reactions likewise.
std::array<double, 2> frames_differ_by(double alpha, double dt) {
    Options<2> moving = rubber(), clamped = rubber();
    moving.alpha = clamped.alpha = alpha;
    const std::array<TimeFunction, 2> root{law(Harmonic{0.004, 12, 0, {0.05}}), law(ConstantRate{0.3, {0.05}})};
    moving.motions = {{"left", {root[0], root[1]}}};
    clamped.clamps = {{"left", {true, true}}};
    Assembly<2> free(slender_beam(), rubber());
    const std::size_t size = 2 * slender_beam().nodes.size();
    std::vector<double> acceleration(size), force(size);
    Solver<2> shaken(slender_beam(), moving), still(slender_beam(), clamped);
    double largest = 0, worst = 0, largest_reaction = 0, worst_reaction = 0;
    for (double t = dt; t < 0.1; t += dt) {
        for (std::size_t f = 0; f < size; ++f) acceleration[f] = -root[f % 2].at(t).acceleration;
        free.multiply_mass(acceleration, force, serial_loop);
        shaken.advance(dt, no_load(slender_beam()), serial_loop);
        still.advance(dt, force, serial_loop);
        for (std::size_t f = 0; f < size; ++f) {
            const double u = still.displacements()[f];
            largest = std::max(largest, std::abs(u));
            worst = std::max(worst, std::abs(shaken.displacements()[f] - root[f % 2].at(t).value - u));
        }
        for (std::size_t i = 0; i < 2; ++i) {
            const double R = still.reaction("left")[i];
            largest_reaction = std::max(largest_reaction, std::abs(R));
            worst_reaction = std::max(worst_reaction, std::abs(shaken.reaction("left")[i] - R));
        }
    }
    CHECK(largest > 0.005);
    return {worst / largest, worst_reaction / largest_reaction};
}

}  // namespace

TEST_CASE("a body whose root is shaken is a clamped body under the forces of inertia, to second order in time") {
    for (const double alpha : {0.0, -0.1}) {
        const auto coarse = frames_differ_by(alpha, 4e-4), fine = frames_differ_by(alpha, 2e-4);
        CHECK(fine[0] < 1e-3);
        CHECK(std::log2(coarse[0] / fine[0]) > 1.8);
        CHECK(fine[1] < 1e-2);
    }
}

TEST_CASE("prescribed displacements in a static solve: a bar is stretched to twice its length") {
    Options<2> options = rubber();
    const double E = 1e6, nu = 0.3, mu = E / (2 * (1 + nu)), kappa = E / (3 * (1 - 2 * nu));
    options.clamps = {{"left", {true, false}}, {"bottom", {false, true}}};
    options.motions = {{"right", {TimeFunction::constant(0.1), {}}}};
    Solver<2> solver(slender_beam(), options);
    solver.solve_static(no_load(slender_beam()), serial_loop);
    // W = μ/2 (J^(-2/3) (a² + b² + 1) - 3) + κ/2 (J - 1)², a = 2 along; ∂W/∂b = 0 gives the stretch b across.
    const auto stress = [&](double of, double other) {
        const double J = of * other, I = of * of + other * other + 1;
        return mu * std::pow(J, -2.0 / 3) * (of - I / (3 * of)) + kappa * (J - 1) * other;
    };
    double low = 0.3, high = 1;
    for (int k = 0; k < 60; ++k) (stress(0.5 * (low + high), 2) < 0 ? low : high) = 0.5 * (low + high);
    const double b = low, P = stress(2, b);
    CHECK(solver.displacements()[2 * nearest_node(slender_beam(), 0.1, 0.01) + 1] ==
          doctest::Approx(0.01 * (b - 1)).epsilon(1e-7));
    CHECK(solver.reaction("right")[0] == doctest::Approx(P * 0.01).epsilon(1e-7));
    CHECK(solver.reaction("left")[0] == doctest::Approx(-P * 0.01).epsilon(1e-7));
    // And on: released in time it is held at another place.
    CHECK_THROWS_AS((void)solver.reaction("roof"), std::invalid_argument);
}

TEST_CASE("held twice, unknown sets: refused") {
    Options<2> options = rubber();
    options.clamps = {{"left", {true, true}}};
    options.motions = {{"left", {TimeFunction::constant(0.1), {}}}};
    CHECK_THROWS_WITH_AS(Solver<2>(slender_beam(), options), doctest::Contains("held twice along x"),
                         std::invalid_argument);
    options.motions = {{"roof", {TimeFunction::constant(0.1), {}}}};
    CHECK_THROWS_WITH_AS(Solver<2>(slender_beam(), options), doctest::Contains("bottom, left"), std::invalid_argument);
    options.motions.clear();
    options.rigid_bodies = {{.set = "left"}};
    CHECK_THROWS_WITH_AS(Solver<2>(slender_beam(), options), doctest::Contains("rigid body 'left'"),
                         std::invalid_argument);
}

TEST_CASE("a rigid body that is fixed is a clamp") {
    Options<2> clamped = rubber(), fixed = rubber();
    clamped.clamps = {{"left", {true, true}}};
    fixed.rigid_bodies = {{.set = "left", .motion = {TimeFunction{}, TimeFunction{}, TimeFunction{}}}};
    Solver<2> one(slender_beam(), clamped), other(slender_beam(), fixed);
    const auto load = traction(slender_beam(), "top", {3, -50});
    for (Solver<2>* solver : {&one, &other}) {
        solver->solve_static(load, serial_loop);
        for (int k = 0; k < 20; ++k) solver->advance(1e-3, no_load(slender_beam()), serial_loop);
    }
    for (std::size_t f = 0; f < load.size(); ++f)
        CHECK(one.displacements()[f] == doctest::Approx(other.displacements()[f]).epsilon(1e-12));
    CHECK(other.rigid_body(0).reaction[0] == doctest::Approx(one.reaction("left")[0]).epsilon(1e-9));
}

TEST_CASE("a stiff lever: force and moment on a rigid end bend a beam as theory says") {
    Options<2> options = rubber();
    options.material.law = MaterialLaw::saint_venant_kirchhoff;
    options.material.poissons_ratio = 0;
    options.clamps = {{"left", {true, true}}};
    const double L = 0.1, h = 0.01, EI = 1e6 * h * h * h / 12, P = 1e-6, M = 2e-7;
    options.rigid_bodies = {
        {.set = "right", .load = {TimeFunction{}, TimeFunction::constant(P), TimeFunction::constant(M)}}};
    const Mesh<2> mesh = box_mesh({0, 0}, {L, h}, 20, 2);
    Solver<2> solver(mesh, options);
    solver.solve_static(no_load(mesh), serial_loop);
    const auto end = solver.rigid_body(0);
    const double shear = 1.2 * P * L / (0.5e6 * h);
    CHECK(end.displacement[1] ==
          doctest::Approx(P * L * L * L / (3 * EI) + M * L * L / (2 * EI) + shear).epsilon(2e-3));
    CHECK(end.displacement[2] == doctest::Approx(P * L * L / (2 * EI) + M * L / EI).epsilon(2e-3));
    CHECK(solver.reaction("left")[1] == doctest::Approx(-P).epsilon(1e-6));
}

TEST_CASE("a rigid rim turned in a static solve turns an unloaded ring without strain, and twists one that is held") {
    const Mesh<2> mesh = ring(0.05, 0.1, 24, 2);
    check(mesh);
    Options<2> options = rubber();
    options.rigid_bodies = {
        {.set = "inner", .motion = {TimeFunction::constant(0.3), TimeFunction{}, TimeFunction::constant(0.5)}}};
    Solver<2> solver(mesh, options);
    solver.solve_static(no_load(mesh), serial_loop);
    CHECK(solver.energies().strain < 1e-12);
    CHECK(solver.rigid_body(0).displacement[2] == doctest::Approx(0.5));
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const auto [x, y] = mesh.nodes[n];
        CHECK(solver.positions()[2 * n] == doctest::Approx(0.3 + std::cos(0.5) * x - std::sin(0.5) * y).epsilon(1e-7));
        CHECK(solver.positions()[2 * n + 1] == doctest::Approx(std::sin(0.5) * x + std::cos(0.5) * y).epsilon(1e-7));
    }
    // Held outside, turned inside: plane torsion of a linear ring, M = 4 π μ φ / (1/a² - 1/b²), small angle.
    options.clamps = {{"outer", {true, true}}};
    options.rigid_bodies[0].motion = {TimeFunction{}, TimeFunction{}, TimeFunction::constant(1e-5)};
    const Mesh<2> fine = ring(0.05, 0.1, 64, 8);
    Solver<2> twisted(fine, options);
    twisted.solve_static(no_load(fine), serial_loop);
    const double mu = 1e6 / 2.6;
    CHECK(twisted.rigid_body(0).reaction[2] ==
          doctest::Approx(4 * M_PI * mu * 1e-5 / (1 / 0.0025 - 1 / 0.01)).epsilon(1e-3));
}

TEST_CASE("a free wheel keeps its linear and angular momentum; its energy balances") {
    const Mesh<2> mesh = ring(0.05, 0.1, 24, 2);
    Options<2> options = rubber();
    options.alpha = -0.05;
    options.rigid_bodies = {{.set = "inner", .mass = 3, .inertia = {0.02}}};
    Solver<2> solver(mesh, options);
    State state;
    solver.save(state);
    const double omega = 20, V = 2;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        state.velocities[2 * n] = V - omega * mesh.nodes[n][1];
        state.velocities[2 * n + 1] = omega * mesh.nodes[n][0];
    }
    state.rigid_bodies[3] = V;
    state.rigid_bodies[5] = 0.05 * omega;
    solver.restore(state);
    Assembly<2> all(mesh, rubber());
    std::vector<double> momentum(2 * mesh.nodes.size());
    const auto totals = [&] {
        all.multiply_mass(solver.velocities(), momentum, serial_loop);
        const auto body = solver.rigid_body(0);
        std::array<double, 3> sum{3 * body.velocity[0], 3 * body.velocity[1], 0.02 * body.velocity[2]};
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            const double x = solver.positions()[2 * n], y = solver.positions()[2 * n + 1];
            sum[0] += momentum[2 * n];
            sum[1] += momentum[2 * n + 1];
            sum[2] += x * momentum[2 * n + 1] - y * momentum[2 * n];
        }
        sum[2] += 3 * (body.displacement[0] * body.velocity[1] - body.displacement[1] * body.velocity[0]);
        return sum;
    };
    const auto before = totals();
    const double dt = 1e-3;
    const double error = imbalance<2>(solver, 400, [&](int) { solver.advance(dt, no_load(mesh), serial_loop); });
    const auto after = totals();
    CHECK(after[0] == doctest::Approx(before[0]).epsilon(1e-6));
    CHECK(std::abs(after[1]) < 1e-6 * before[0]);
    CHECK(after[2] == doctest::Approx(before[2]).epsilon(1e-3));
    CHECK(solver.rigid_body(0).displacement[2] == doctest::Approx(omega * 400 * dt).epsilon(2e-3));
    CHECK(error < 1e-3);
}

TEST_CASE("a driven wheel: the work of the prescribed rotation and of loads becomes energy") {
    const Mesh<2> mesh = ring(0.05, 0.1, 24, 2);
    Options<2> options = rubber();
    options.alpha = -0.1;
    options.gravity = {0, -9.81};
    options.rigid_bodies = {{.set = "inner",
                             .motion = {{{}, TimeFunction{}, law(Harmonic{0.4, 8, 0, {0.1}})}},
                             .load = {{TimeFunction::constant(30), {}, {}}},
                             .mass = 2,
                             .inertia = {0.01}}};
    double errors[2];
    for (const int refinement : {1, 2}) {
        Solver<2> solver(mesh, options);
        errors[refinement - 1] = imbalance<2>(
            solver, 150 * refinement, [&](int) { solver.advance(2e-3 / refinement, no_load(mesh), serial_loop); });
        // All momentum along x is that of the load.
        Assembly<2> all(mesh, rubber());
        std::vector<double> momentum(2 * mesh.nodes.size());
        all.multiply_mass(solver.velocities(), momentum, serial_loop);
        double p = 2 * solver.rigid_body(0).velocity[0];
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) p += momentum[2 * n];
        CHECK(p == doctest::Approx(30 * 0.3).epsilon(1e-3));
    }
    CHECK(errors[1] < 1e-3);
    CHECK(errors[1] < 0.4 * errors[0]);
}

TEST_CASE("a tumbling rigid body in three dimensions follows Euler's equations to second order") {
    const Mesh<3> mesh = box_mesh({0, 0, 0}, {0.2, 0.1, 0.05}, {2, 2, 2});
    Options<3> options;
    options.material.youngs_modulus = 1e7;
    options.material.poissons_ratio = 0.3;
    options.material.density = 1;
    options.alpha = 0;
    // The left face carries a heavy body of three different moments of inertia; the mesh hardly matters.
    options.rigid_bodies = {{.set = "left", .point = {{0, 0.05, 0.025}}, .mass = 1e4, .inertia = {300, 500, 700}}};
    const auto tumble = [&](int steps) {
        Solver<3> solver(mesh, options);
        State state;
        solver.save(state);
        const double arm = std::hypot(0.05, 0.025), w[3] = {0.2, 3, 0.3};
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            const double r[3] = {mesh.nodes[n][0], mesh.nodes[n][1] - 0.05, mesh.nodes[n][2] - 0.025};
            for (std::size_t i = 0; i < 3; ++i)
                state.velocities[3 * n + i] = w[(i + 1) % 3] * r[(i + 2) % 3] - w[(i + 2) % 3] * r[(i + 1) % 3];
        }
        for (std::size_t i = 0; i < 3; ++i) state.rigid_bodies[9 + i] = arm * w[i];
        solver.restore(state);
        for (int k = 0; k < steps; ++k)
            solver.advance(1.0 / steps, std::vector<double>(3 * mesh.nodes.size(), 0.0), serial_loop);
        return solver.rigid_body(0).velocity;
    };
    // Euler's equations of the body alone, by Runge–Kutta, turned back into space.
    std::array<double, 3> w{0.2, 3, 0.3};
    double R[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double J[3] = {300, 500, 700};
    constexpr int steps = 20000;
    for (int k = 0; k < steps; ++k) {
        const double h = 1.0 / steps;
        const auto rate = [&](const std::array<double, 3>& x) {
            return std::array<double, 3>{(J[1] - J[2]) * x[1] * x[2] / J[0], (J[2] - J[0]) * x[2] * x[0] / J[1],
                                         (J[0] - J[1]) * x[0] * x[1] / J[2]};
        };
        const auto k1 = rate(w);
        const auto k2 = rate({w[0] + h / 2 * k1[0], w[1] + h / 2 * k1[1], w[2] + h / 2 * k1[2]});
        const std::array<double, 3> middle{w[0] + h / 2 * k1[0], w[1] + h / 2 * k1[1], w[2] + h / 2 * k1[2]};
        for (std::size_t i = 0; i < 3; ++i) w[i] += h * k2[i];
        double next[3][3];  // R exp(h ω×) to second order
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const auto W = [&](std::size_t p, std::size_t q) {
                    return p == q ? 0.0 : ((q + 3 - p) % 3 == 1 ? -1 : 1) * middle[3 - p - q];
                };
                next[i][j] = R[i][j];
                for (std::size_t p = 0; p < 3; ++p) {
                    next[i][j] += h * R[i][p] * W(p, j);
                    for (std::size_t q = 0; q < 3; ++q) next[i][j] += h * h / 2 * R[i][p] * W(p, q) * W(q, j);
                }
            }
        std::copy(&next[0][0], &next[0][0] + 9, &R[0][0]);
    }
    std::array<double, 3> exact{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) exact[i] += R[i][j] * w[j];
    const auto error = [&](int n) {
        const auto velocity = tumble(n);
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += std::pow(velocity[3 + i] - exact[i], 2);
        return std::sqrt(sum);
    };
    const double coarse = error(40), fine = error(80);
    MESSAGE("error of ω ", coarse, " ", fine);
    CHECK(coarse < 0.02);
    CHECK(std::log2(coarse / fine) == doctest::Approx(2).epsilon(0.1));
}

TEST_CASE("a wheel continues with the same bits after a restart and on four threads") {
    const Mesh<2> mesh = ring(0.05, 0.1, 96, 8);
    Options<2> options = rubber();
    options.residual_tolerance = 1e-8;
    options.gravity = {0, -9.81};
    options.rigid_bodies = {
        {.set = "inner", .motion = {law(ConstantRate{1, {}}), {}, {}}, .mass = 2, .inertia = {0.01}}};
    const SixSteps run(mesh, options);
    const Solver<2>& straight = run.straight;
    for (const Solver<2>* other : {&run.threaded, &run.restarted}) {
        CHECK(copy(other->positions()) == copy(straight.positions()));
        CHECK(copy(other->accelerations()) == copy(straight.accelerations()));
        CHECK(other->rigid_body(0).displacement == straight.rigid_body(0).displacement);
        CHECK(other->energies().external_work == straight.energies().external_work);
        CHECK(other->energies().numerical == straight.energies().numerical);
    }
}
