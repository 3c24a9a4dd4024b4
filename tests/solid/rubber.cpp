// Laws that are given by data: a measured curve, cords in rubber.
#include <doctest/doctest.h>

#include <cmath>

#include "physics/solid/cord_directions.hpp"
#include "physics/solid/materials/cords.hpp"
#include "physics/solid/materials/neo_hookean.hpp"
#include "physics/solid/materials/uniaxial_curve.hpp"
#include "physics/solid/solver.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;

namespace {

// An S-shaped curve like that of filled rubber.
double force(double strain) {
    return 1e6 * (2.4 * std::tanh(1.7 * strain) + 0.5 * strain + 0.8 * strain * strain * strain);
}
std::vector<std::array<double, 2>> curve(int points, double end) {
    std::vector<std::array<double, 2>> values;
    for (int k = 1; k <= points; ++k) values.push_back({end * k / points, force(end * k / points)});
    return values;
}

// A cube under uniaxial pull of `strain` on its right, free to contract; returns the force per reference area.
double pulled_cube(const Material& material, double strain) {
    Mesh<3> mesh = without_mid_side_nodes(box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
    Options<3> options;
    options.material = material;
    options.clamps = {
        {"left", {true, false, false}}, {"front", {false, true, false}}, {"bottom", {false, false, true}}};
    Solver<3> solver(mesh, options);
    // The force that gives this strain, by secants on the end's displacement.
    const auto stretch_under = [&](double T) {
        std::vector<double> loads(3 * mesh.nodes.size(), 0.0);
        for (const Facet& facet : mesh.surface("right"))
            for (const NodeIndex node : facet) loads[3 * std::size_t(node)] += T / 4 / 4;
        solver.solve_static(loads, serial_loop);
        return solver.displacements()[3 * std::size_t(mesh.node_set("right")[0])];
    };
    double T0 = 0.9 * force(strain), T1 = force(strain), e0 = stretch_under(T0), e1 = stretch_under(T1);
    for (int k = 0; k < 30 && std::abs(e1 - strain) > 1e-10; ++k) {
        const double T2 = T1 + (strain - e1) * (T1 - T0) / (e1 - e0);
        T0 = T1, e0 = e1;
        e1 = stretch_under(T1 = T2);
    }
    return T1;
}

}  // namespace

TEST_CASE("a measured curve is reproduced, between its points too") {
    Material material;
    material.law = MaterialLaw::uniaxial_curve;
    material.density = 1100;
    material.poissons_ratio = 0.49999;
    material.curve = curve(16, 1.6);
    for (const double strain : {0.05, 0.2, 0.35, 0.8, 1.25, 1.6})
        CHECK(pulled_cube(material, strain) == doctest::Approx(force(strain)).epsilon(strain < 0.1 ? 0.01 : 0.002));
    CHECK(FirstInvariantTable(curve(200, 1.6)).youngs_modulus() ==
          doctest::Approx(1e6 * (2.4 * 1.7 + 0.5)).epsilon(0.01));
}

TEST_CASE("a neo-Hookean curve gives the neo-Hookean law") {
    std::vector<std::array<double, 2>> points;
    constexpr double mu = 0.6e6;
    for (int k = 1; k <= 400; ++k) {
        const double stretch = 1 + 0.005 * k;
        points.push_back({stretch - 1, mu * (stretch - 1 / (stretch * stretch))});
    }
    const auto law = UniaxialCurve<3>::solid(points, 0.45);
    const NeoHookean<3> expected{mu, law.kappa};
    Tensor<3, double> H{{{0.3, 0.2, -0.1}, {0.05, -0.2, 0.3}, {0.1, 0.2, 0.15}}};
    const auto k = kinematics<NeoHookean<3>, 3, double>(H);
    const auto P = first_piola(law, k), Q = first_piola(expected, k);
    for (std::size_t q = 0; q < 9; ++q) CHECK(std::abs(P(q / 3, q % 3) - Q(q / 3, q % 3)) < 1e-4 * mu);
    CHECK(law.energy(k) == doctest::Approx(expected.energy(k)).epsilon(1e-4));
}

TEST_CASE("stress and tangent of the curve are derivatives, also beyond its end") {
    const auto law = UniaxialCurve<3>::solid(curve(12, 0.6), 0.45);
    constexpr double h = 1e-6, modulus = 5e6;
    for (const double size : {0.02, 0.3, 1.2}) {
        Tensor<3, double> H{
            {{0.9 * size, 0.2 * size, -0.1 * size}, {0.1 * size, -0.3 * size, 0.3 * size}, {0, 0.2 * size, 0.1}}};
        const auto at = [&](const Tensor<3, double>& gradient) {
            return kinematics<UniaxialCurve<3>, 3, double>(gradient);
        };
        const auto P = first_piola(law, at(H));
        const auto A = full_tangent(law, at(H));
        for (std::size_t q = 0; q < 9; ++q) {
            auto above = H, below = H;
            above(q / 3, q % 3) += h;
            below(q / 3, q % 3) -= h;
            CHECK(std::abs(P(q / 3, q % 3) - (law.energy(at(above)) - law.energy(at(below))) / (2 * h)) <
                  1e-6 * modulus);
            const auto Pa = first_piola(law, at(above)), Pb = first_piola(law, at(below));
            for (std::size_t p = 0; p < 9; ++p)
                CHECK(std::abs(A.c[p][q] - (Pa(p / 3, p % 3) - Pb(p / 3, p % 3)) / (2 * h)) < 2e-3 * modulus);
        }
    }
}

TEST_CASE("a curve that does not grow is refused, with the point") {
    CHECK_THROWS_WITH_AS(FirstInvariantTable({{0.1, 1}, {0.2, 0.9}}), doctest::Contains("point 2"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(FirstInvariantTable({{0, 0}, {0.2, 0.9}}), doctest::Contains("point 1"),
                         std::invalid_argument);
    CHECK_THROWS_AS(FirstInvariantTable({}), std::invalid_argument);
}

TEST_CASE("cords: stress and tangent are derivatives; pulled they bear, pushed they do not") {
    const NeoHookean<3> rubber = NeoHookean<3>::solid(3, 0.4);
    const CordDirection<double> cords[2] = {{20, {0.6, 0.8, 0}}, {35, {0, 0.28, -0.96}}};
    const CordReinforcedPack<NeoHookean<3>, double> law{rubber, cords, 2};
    using Law = CordReinforcedPack<NeoHookean<3>, double>;
    constexpr double h = 1e-6;
    for (const double sign : {1.0, -1.0}) {
        Tensor<3, double> H{{{0.2 * sign, 0.1, 0.05}, {-0.1, 0.15 * sign, 0.1}, {0.1, -0.2 * sign, 0.1}}};
        const auto at = [&](const Tensor<3, double>& gradient) { return kinematics<Law, 3, double>(gradient); };
        const auto P = first_piola(law, at(H));
        const auto A = full_tangent(law, at(H));
        for (std::size_t q = 0; q < 9; ++q) {
            auto above = H, below = H;
            above(q / 3, q % 3) += h;
            below(q / 3, q % 3) -= h;
            CHECK(std::abs(P(q / 3, q % 3) - (law.energy(at(above)) - law.energy(at(below))) / (2 * h)) < 1e-7);
            const auto Pa = first_piola(law, at(above)), Pb = first_piola(law, at(below));
            for (std::size_t p = 0; p < 9; ++p)
                CHECK(std::abs(A.c[p][q] - (Pa(p / 3, p % 3) - Pb(p / 3, p % 3)) / (2 * h)) < 1e-7);
        }
    }
    Tensor<3, double> squeezed{{{-0.1, 0, 0}, {0, -0.1, 0}, {0, 0, -0.1}}};
    const auto k = kinematics<Law, 3, double>(squeezed);
    CHECK(law.energy(k) == rubber.energy(k));
}

TEST_CASE("a layer of cords along the pull adds its stiffness, one across it or pushed adds none") {
    Material material;
    material.law = MaterialLaw::neo_hookean;
    material.density = 1100;
    material.youngs_modulus = 3e6;
    material.poissons_ratio = 0.3;
    Mesh<3> mesh = without_mid_side_nodes(box_mesh({0, 0, 0}, {1, 1, 0.1}, {2, 2, 1}));
    const auto pull = [&](double angle, double T) {
        Options<3> options;
        options.material = material;
        options.material.cords = {{1e9, 1e-6, 2e-3, 5e-3, angle}};  // k = 100 MPa
        options.clamps = {
            {"left", {true, false, false}}, {"front", {false, true, false}}, {"bottom", {false, false, true}}};
        Solver<3> solver(mesh, options);
        std::vector<double> loads(3 * mesh.nodes.size(), 0.0);
        for (const Facet& facet : mesh.surface("right"))
            for (const NodeIndex node : facet) loads[3 * std::size_t(node)] += T * 0.1 / 2 / 4;
        solver.solve_static(loads, serial_loop);
        return solver.displacements()[3 * std::size_t(mesh.node_set("right")[0])];
    };
    constexpr double T = 1e3;  // small: linear
    CHECK(pull(0, T) == doctest::Approx(T / (3e6 + 100e6)).epsilon(1e-3));
    CHECK(pull(0, -T) == doctest::Approx(-T / 3e6).epsilon(2e-3));
    CHECK(pull(M_PI / 2, T) == doctest::Approx(T / 3e6).epsilon(2e-3));  // contracting, the cords are pushed
}

TEST_CASE("cords run around the axis of a ring, at their angle") {
    Mesh<3> mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {12, 2, 1});
    for (auto& X : mesh.nodes) {  // x: round the y axis; y: width; z: thickness
        const double angle = 1.5 * X[0], radius = 0.3 + 0.02 * X[2], width = 0.2 * X[1];
        X = {radius * std::sin(angle), width, radius * std::cos(angle)};
    }
    check(mesh);
    LayerFrame layer;
    layer.around_axis = true;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
        double x = 0, z = 0;
        for (const NodeIndex n : mesh.elements[e]) {
            x += mesh.nodes[std::size_t(n)][0];
            z += mesh.nodes[std::size_t(n)][2];
        }
        const double r = std::hypot(x, z);
        const auto belt = cord_direction(mesh, int(e), layer, 0), ply = cord_direction(mesh, int(e), layer, M_PI / 2);
        CHECK(belt[0] == doctest::Approx(z / r).epsilon(1e-6));  // axis × radial
        CHECK(belt[2] == doctest::Approx(-x / r).epsilon(1e-6));
        CHECK(std::abs(belt[1]) < 1e-12);
        CHECK(std::abs(ply[1]) == doctest::Approx(1).epsilon(1e-12));
    }
}
