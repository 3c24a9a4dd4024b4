// Loads on surfaces: tangents against differences, resultants, Rivlin's cylinder and sphere.
#include "physics/solid/surface_loads.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "physics/solid/elements/dispatch.hpp"
#include "tests/solid/facet_tangents.hpp"
#include "tests/solid/wheels.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

template <int D>
Mesh<D> one_element(std::size_t nodes) {
    if constexpr (D == 2) {
        const Mesh<2> quadratic = box_mesh({0, 0}, {1.2, 0.7}, 1, 1);
        return nodes == 8 ? quadratic : without_mid_side_nodes(quadratic);
    } else {
        if (nodes == 10) {
            Mesh<3> mesh;
            mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1.2, 0}, {0, 0, 0.9}};
            for (const auto& [p, q] : Tet10::edges) {
                auto& middle = mesh.nodes.emplace_back();
                for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * (mesh.nodes[p][i] + mesh.nodes[q][i]);
            }
            mesh.elements = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
            return mesh;
        }
        const Mesh<3> quadratic = box_mesh({0, 0, 0}, {1.2, 0.7, 0.9}, {1, 1, 1});
        return nodes == 20 ? quadratic : without_mid_side_nodes(quadratic);
    }
}

// Largest difference between the matrices of a pressure on the whole boundary and the differences of its forces.
template <int D>
double tangent_error(std::size_t nodes) {
    Mesh<D> mesh = one_element<D>(nodes);
    mesh.surfaces["all"] = boundary_facets(mesh);
    check(mesh);
    Options<D> options;
    options.thickness = 0.3;
    options.pressures = {{"all", TimeFunction::constant(7)}};
    SurfaceLoads<D> loads(mesh, options);
    const std::size_t size = D * mesh.nodes.size();
    std::vector<double> u(size), matrices(loads.matrix_size()), forces(size);
    for (std::size_t f = 0; f < size; ++f) u[f] = 0.1 * std::sin(3.0 * double(f) + 1);
    loads.tangents(0, 1, u, matrices, serial_loop);
    const auto add_forces = [&](const auto& moved, auto& to) { loads.add_forces(0, moved, to, serial_loop); };
    add_forces(u, forces);
    double total[D] = {};
    for (std::size_t f = 0; f < size; ++f) total[f % D] += forces[f];
    for (const double force : total) CHECK(std::abs(force) < 1e-12);  // of a closed surface
    return facet_tangent_error<D>(mesh.surfaces["all"], matrices, u, add_forces).worst;
}

// The eighth of a hollow sphere by three patches; sets x, y, z on the planes of symmetry, surface inner.
Mesh<3> eighth_of_sphere(double inner, double outer, int along, int across) {
    Mesh<3> mesh;
    const auto number = [&](const std::array<double, 3>& X) {
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            if (std::hypot(mesh.nodes[n][0] - X[0], mesh.nodes[n][1] - X[1], mesh.nodes[n][2] - X[2]) < 1e-9 * outer)
                return NodeIndex(n);
        mesh.nodes.push_back(X);
        return NodeIndex(mesh.nodes.size() - 1);
    };
    const Mesh<3> box = box_mesh({0, 0, 0}, {1, 1, 1}, {along, along, across});
    for (std::size_t turn = 0; turn < 3; ++turn) {
        std::vector<NodeIndex> index;
        for (const auto& X : box.nodes) {
            const double s = std::tan(M_PI / 4 * X[0]), t = std::tan(M_PI / 4 * X[1]),
                         length = std::sqrt(1 + s * s + t * t), r = inner + (outer - inner) * X[2];
            std::array<double, 3> place;
            place[turn] = r / length;
            place[(turn + 1) % 3] = r * s / length;
            place[(turn + 2) % 3] = r * t / length;
            for (double& x : place)
                if (std::abs(x) < 1e-12) x = 0;
            index.push_back(number(place));
        }
        for (Element element : box.elements) {
            for (NodeIndex& node : element) node = index[std::size_t(node)];
            mesh.elements.push_back(element);
        }
        for (Facet facet : box.surfaces.at("bottom")) {
            for (NodeIndex& node : facet) node = index[std::size_t(node)];
            mesh.surfaces["inner"].push_back(facet);
        }
    }
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        for (std::size_t i = 0; i < 3; ++i)
            if (mesh.nodes[n][i] == 0) mesh.node_sets[std::string(1, "xyz"[i])].push_back(NodeIndex(n));
    return mesh;
}

}  // namespace

TEST_CASE("the tangent of a pressure on every type of facet against differences") {
    CHECK(tangent_error<2>(4) < 1e-7);
    CHECK(tangent_error<2>(8) < 1e-7);
    CHECK(tangent_error<3>(8) < 1e-7);
    CHECK(tangent_error<3>(20) < 1e-7);
    CHECK(tangent_error<3>(10) < 1e-7);
}

TEST_CASE("Rivlin's thick cylinder of Mooney–Rivlin rubber under inner pressure") {
    const double A = 0.1, B = 0.2, c10 = 3e5, c01 = 1e5, mu = 2 * (c10 + c01);
    Options<2> options;
    options.material.law = MaterialLaw::mooney_rivlin;
    options.material.density = 1000;
    options.material.c10 = c10;
    options.material.c01 = c01;
    options.material.bulk_modulus = 1e4 * mu;
    options.clamps = {{"bottom", {false, true}}, {"top", {true, false}}};
    // r² = R² + k; p = μ (½ ln B²/A² - ln b/a - k/2 (1/b² - 1/a²))
    const double a = 1.5 * A, k = a * a - A * A, b = std::sqrt(B * B + k);
    const double p = mu * (std::log(B / A) - std::log(b / a) - k / 2 * (1 / (b * b) - 1 / (a * a)));
    options.pressures = {{"left", TimeFunction::constant(p)}};
    const Mesh<2> mesh = quarter_ring(A, B, 8, 12);
    Solver<2> solver(mesh, options);
    solver.solve_static(no_load(mesh), serial_loop);
    CHECK(solver.positions()[2 * nearest_node(mesh, A, 0)] == doctest::Approx(a).epsilon(0.002));
    CHECK(solver.positions()[2 * nearest_node(mesh, B, 0)] == doctest::Approx(b).epsilon(0.002));
    // The same pressure again changes nothing.
    solver.solve_static(no_load(mesh), serial_loop);
    CHECK(solver.positions()[2 * nearest_node(mesh, A, 0)] == doctest::Approx(a).epsilon(0.002));
}

TEST_CASE("inflation of a thick sphere of Mooney–Rivlin rubber") {
    const double A = 0.1, B = 0.15, c10 = 3e5, c01 = 1e5;
    // Incompressible, r³ = R³ + k: p = ∫ 2 (σ_θ - σ_r) dr/r, σ_θ - σ_r = 2 (λ² - λ⁻⁴) (C10 + C01 λ²), λ = r/R.
    const double a = 1.3 * A, k = a * a * a - A * A * A, b = std::cbrt(B * B * B + k);
    double p = 0;
    constexpr int steps = 2000;
    for (int n = 0; n < steps; ++n) {
        const double r = a + (b - a) * (n + 0.5) / steps, L = r / std::cbrt(r * r * r - k), L2 = L * L;
        p += 4 * (L2 - 1 / (L2 * L2)) * (c10 + c01 * L2) / r * (b - a) / steps;
    }
    Options<3> options;
    options.material.law = MaterialLaw::mooney_rivlin;
    options.material.density = 1000;
    options.material.c10 = c10;
    options.material.c01 = c01;
    options.material.bulk_modulus = 1000 * 2 * (c10 + c01);
    options.clamps = {{"x", {true, false, false}}, {"y", {false, true, false}}, {"z", {false, false, true}}};
    options.pressures = {{"inner", TimeFunction::constant(p)}};
    const Mesh<3> mesh = eighth_of_sphere(A, B, 3, 2);
    check(mesh);
    Solver<3> solver(mesh, options);
    solver.solve_static(std::vector<double>(3 * mesh.nodes.size(), 0.0), serial_loop);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const auto& X = mesh.nodes[n];
        const double R = std::hypot(X[0], X[1], X[2]);
        if (R > A * 1.001) continue;
        const double r =
            std::hypot(solver.positions()[3 * n], solver.positions()[3 * n + 1], solver.positions()[3 * n + 2]);
        CHECK(r == doctest::Approx(a).epsilon(0.01));
    }
}
