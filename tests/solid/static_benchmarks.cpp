// Static solutions that others have published or that have a closed form.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

struct Deflections {
    double middle, corner;
};

// Cook's membrane (Cook 1974): a tapered panel clamped at its left, total shear force F on its right. Small
// displacements: the load is a millionth.
Deflections cooks_membrane(int n, double E, double nu, double F, PlaneCondition plane) {
    const Mesh<2> mesh = mapped(box_mesh({0, 0}, {1, 1}, n, n), [](std::array<double, 2> X) {
        return std::array<double, 2>{48 * X[0], 44 * X[0] + (44 - 28 * X[0]) * X[1]};
    });
    Options<2> options;
    options.material.youngs_modulus = E;
    options.material.poissons_ratio = nu;
    options.material.density = 1;
    options.plane = plane;
    options.clamps = {{"left", {true, true}}};
    Solver<2> solver(mesh, options);
    constexpr double small = 1e-6;
    solver.solve_static(traction(mesh, "right", {0, small * F / 16}), serial_loop);
    const auto up = [&](double y) { return solver.displacements()[2 * nearest_node(mesh, 48, y) + 1] / small; };
    return {up(52), up(60)};
}

Solver<2> bent_cantilever(double load, MaterialLaw law) {  // load: P L²/(E I)
    constexpr double L = 1, h = 0.01, E = 1e9;
    const Mesh<2> mesh = box_mesh({0, 0}, {L, h}, 40, 1);
    Options<2> options;
    options.material.law = law;
    options.material.youngs_modulus = E;
    options.material.poissons_ratio = 0;
    options.material.density = 1;
    options.clamps = {{"left", {true, true}}};
    Solver<2> solver(mesh, options);
    solver.solve_static(traction(mesh, "right", {0, load * E * h * h * h / 12 / (L * L) / h}), serial_loop);
    return solver;
}

}  // namespace

TEST_CASE("Cook's membrane, plane stress: 23.96 in the middle of the free edge") {
    const Deflections coarse = cooks_membrane(4, 1, 1.0 / 3, 1, PlaneCondition::stress);
    const Deflections fine = cooks_membrane(32, 1, 1.0 / 3, 1, PlaneCondition::stress);
    CHECK(fine.middle == doctest::Approx(23.96).epsilon(0.001));
    CHECK(fine.corner == doctest::Approx(25.16).epsilon(0.001));
    CHECK(coarse.middle == doctest::Approx(23.96).epsilon(0.011));  // four elements each way
}

TEST_CASE("Cook's membrane, plane strain") {
    const Deflections fine = cooks_membrane(32, 70, 1.0 / 3, 100, PlaneCondition::strain);
    CHECK(fine.middle == doctest::Approx(30.74).epsilon(0.001));
    CHECK(fine.corner == doctest::Approx(32.26).epsilon(0.001));
}

TEST_CASE("Cook's membrane, nearly incompressible: it does not lock") {
    const Deflections coarse = cooks_membrane(4, 250, 0.4999, 100, PlaneCondition::strain);
    const Deflections medium = cooks_membrane(16, 250, 0.4999, 100, PlaneCondition::strain);
    const Deflections fine = cooks_membrane(64, 250, 0.4999, 100, PlaneCondition::strain);
    CHECK(fine.middle == doctest::Approx(7.38).epsilon(0.002));
    CHECK(fine.corner == doctest::Approx(7.72).epsilon(0.005));
    CHECK(medium.middle == doctest::Approx(fine.middle).epsilon(0.015));
    CHECK(coarse.middle > 0.92 * fine.middle);
}

TEST_CASE("a slender cantilever bends as the elastica does") {
    const std::vector<std::array<double, 3>> elastica{
        {0.5, .16214, .01592}, {1, .30172, .05643}, {2, .49346, .16064}, {5, .71379, .38763}, {10, .81061, .55500}};
    for (const auto& [load, deflection, shortening] : elastica) {
        const Solver<2> solver = bent_cantilever(load, MaterialLaw::saint_venant_kirchhoff);
        const std::size_t tip = nearest_node(solver.mesh(), 1, 0.005);
        CHECK(std::abs(solver.displacements()[2 * tip + 1] - deflection) < 3e-4);
        CHECK(std::abs(-solver.displacements()[2 * tip] - shortening) < 3e-4);
    }
    const Solver<2> rubber = bent_cantilever(2, MaterialLaw::neo_hookean);
    CHECK(std::abs(rubber.displacements()[2 * nearest_node(rubber.mesh(), 1, 0.005) + 1] - .49346) < 3e-4);
}

TEST_CASE("a nearly incompressible thick beam does not lock in bending") {  // four elements through the thickness
    constexpr double L = 1, h = 0.1, E = 1e6, nu = 0.4999, P = 1;
    const Mesh<2> mesh = box_mesh({0, 0}, {L, h}, 20, 4);
    Options<2> options;
    options.material.youngs_modulus = E;
    options.material.poissons_ratio = nu;
    options.material.density = 1;
    options.clamps = {{"left", {true, true}}};
    Solver<2> solver(mesh, options);
    solver.solve_static(traction(mesh, "right", {0, P / h}), serial_loop);
    const double I = h * h * h / 12, G = E / (2 * (1 + nu));
    const double timoshenko = P * L * L * L * (1 - nu * nu) / (3 * E * I) + 1.2 * P * L / (G * h);
    CHECK(solver.displacements()[2 * nearest_node(mesh, L, h / 2) + 1] == doctest::Approx(timoshenko).epsilon(0.01));
}

TEST_CASE("the hydrostatic plate under water and under its own weight") {
    const Mesh<2> mesh = box_mesh({0, 0}, {1, 0.05}, 40, 4);
    Options<2> options;
    options.material.youngs_modulus = 67.5e9;
    options.material.poissons_ratio = 0.34;
    options.material.density = 2700;
    options.clamps = {{"left", {true, true}}, {"right", {true, true}}};
    const std::size_t middle = nearest_node(mesh, 0.5, 0.025);
    Solver<2> wet(mesh, options);
    wet.solve_static(traction(mesh, "top", {0, -1000 * 9.81 * 2}), serial_loop);
    CHECK(wet.displacements()[2 * middle + 1] == doctest::Approx(-6.60e-5).epsilon(0.005));
    options.gravity = {0, -9.81};
    Solver<2> heavy(mesh, options);
    heavy.solve_static(no_load(mesh), serial_loop);
    CHECK(heavy.displacements()[2 * middle + 1] == doctest::Approx(-0.445e-5).epsilon(0.005));
}

TEST_CASE("Turek & Hron's flag in gravity: CSM1 at rest, CSM2 stiffer, CSM3 swinging") {
    // Benchmark of Turek & Hron (2006): the flag behind the cylinder, root on its arc, Saint Venant–Kirchhoff, plane
    // strain.
    const Mesh<2> mesh = mapped(box_mesh({0, 0}, {1, 1}, 35, 2), [](std::array<double, 2> X) {
        const double y = 0.19 + 0.02 * X[1], root = 0.2 + std::sqrt(0.05 * 0.05 - (y - 0.2) * (y - 0.2));
        return std::array<double, 2>{root + X[0] * (0.6 - root), y};
    });
    Options<2> options;
    options.material.youngs_modulus = 1.4e6;
    options.material.poissons_ratio = 0.4;
    options.material.density = 1000;
    options.gravity = {0, -2};
    options.alpha = 0;
    options.clamps = {{"left", {true, true}}};
    const std::size_t tip = 2 * nearest_node(mesh, 0.6, 0.2);
    Solver<2> first(mesh, options);
    first.solve_static(no_load(mesh), serial_loop);
    CHECK(first.displacements()[tip] == doctest::Approx(-7.188e-3).epsilon(0.003));
    CHECK(first.displacements()[tip + 1] == doctest::Approx(-66.10e-3).epsilon(0.003));

    Solver<2> third(mesh, options);
    double lowest = 0, highest = -1, time_of_lowest = 0;
    constexpr double dt = 0.005;
    for (int k = 1; k <= 200; ++k) {
        third.advance(dt, no_load(mesh), serial_loop);
        const double y = third.displacements()[tip + 1];
        if (y < lowest) lowest = y, time_of_lowest = k * dt;
        if (k > 100) highest = std::max(highest, y);
    }
    CHECK(lowest == doctest::Approx(-(63.78e-3 + 65.34e-3)).epsilon(0.01));
    CHECK(std::abs(highest) < 2e-3);  // it comes back to where it started
    CHECK(time_of_lowest == doctest::Approx(0.5 / 1.094).epsilon(0.02));

    options.material.youngs_modulus = 5.6e6;
    Solver<2> second(mesh, options);
    second.solve_static(no_load(mesh), serial_loop);
    CHECK(second.displacements()[tip] == doctest::Approx(-0.4690e-3).epsilon(0.003));
    CHECK(second.displacements()[tip + 1] == doctest::Approx(-16.974e-3).epsilon(0.003));
}

TEST_CASE("a thick rubber tube under inner pressure is the closed form for an incompressible law") {
    // Plane strain, p = µ/2 [ln(Ro²/ro²) - ln(Ri²/ri²) + A (1/ri² - 1/ro²)] with µ/2 = C10, r² = R² + A. The pressure
    // follows the wall: its nodal forces are found for the deformed shape, again until nothing changes.
    constexpr double inner = 7, outer = 18.625, C10 = 100, mu = 2 * C10, nu = 0.4999;
    const Mesh<2> mesh = mapped(box_mesh({0, 0}, {1, 1}, 12, 12), [](std::array<double, 2> X) {  // a quarter
        const double R = inner + (outer - inner) * X[0], angle = X[1] * M_PI / 2;
        return std::array<double, 2>{R * std::cos(angle), R * std::sin(angle)};
    });
    Options<2> options;
    options.material.law = MaterialLaw::neo_hookean;
    options.material.youngs_modulus = 2 * mu * (1 + nu);
    options.material.poissons_ratio = nu;
    options.material.density = 1;
    options.clamps = {{"bottom", {false, true}}, {"top", {true, false}}};
    Solver<2> solver(mesh, options);
    const std::size_t wall = nearest_node(mesh, inner, 0);
    double u_inner = 0;
    for (int pass = 0; pass < 40; ++pass) {
        std::vector<double> forces = no_load(mesh);
        for (const Facet& edge : mesh.surface("left"))
            for (int g = -1; g <= 1; ++g) {  // three Gauss points on the deformed parabola
                const double s = g * std::sqrt(0.6), weight = g == 0 ? 8.0 / 9 : 5.0 / 9;
                const std::array<double, 3> N{0.5 * s * (s - 1), 0.5 * s * (s + 1), 1 - s * s},
                    dN{s - 0.5, s + 0.5, -2 * s};
                double t_x = 0, t_y = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    t_x += dN[k] * solver.positions()[2 * static_cast<std::size_t>(edge[k])];
                    t_y += dN[k] * solver.positions()[2 * static_cast<std::size_t>(edge[k]) + 1];
                }
                for (std::size_t k = 0; k < 3; ++k) {  // -p times the normal out of the solid, (t_y, -t_x)
                    forces[2 * static_cast<std::size_t>(edge[k])] -= 50 * weight * N[k] * t_y;
                    forces[2 * static_cast<std::size_t>(edge[k]) + 1] += 50 * weight * N[k] * t_x;
                }
            }
        solver.solve_static(forces, serial_loop);
        u_inner = solver.displacements()[2 * wall];
    }
    CHECK(u_inner == doctest::Approx(1.2406).epsilon(0.002));
}
