// What elements cost in accuracy where the wrong ones lock: bending, and ν → ½.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;

namespace {

// Tip deflection of a cantilever along x under an end load, over that of beam theory with shear (Timoshenko).
template <int D>
double cantilever(const Mesh<D>& mesh, LinearElements kind, double nu, MaterialLaw law) {
    constexpr double L = 10, h = 1, E = 1e4, P = 1e-3;
    Options<D> options;
    options.material = test::material(law, 1, E, nu);
    options.linear_elements = kind;
    options.clamps = {{"left", {}}};
    options.clamps[0].fixed.fill(true);
    if (D == 3) {
        Clamp<D> front{"front", {}}, back{"back", {}};  // plane strain
        front.fixed[1] = back.fixed[1] = true;
        options.clamps.push_back(front);
        options.clamps.push_back(back);
    }
    Solver<D> solver(mesh, options);
    const auto& tip = mesh.node_set("right");
    std::vector<double> loads(D * mesh.nodes.size(), 0.0);
    for (const NodeIndex n : tip) loads[D * std::size_t(n) + D - 1] = P / double(tip.size());
    solver.solve_static(loads, serial_loop);
    double mean = 0;
    for (const NodeIndex n : tip) mean += solver.displacements()[D * std::size_t(n) + D - 1] / double(tip.size());
    const double I = h * h * h / 12, plane_E = E / (1 - nu * nu), G = E / (2 * (1 + nu));
    return mean / (P * L * L * L / (3 * plane_E * I) + P * L / (5.0 / 6 * G * h));
}

Mesh<2> plane_beam(int along, int across) {
    return without_mid_side_nodes(box_mesh({0, 0}, {10, 1}, along, across));
}
Mesh<3> deep_beam(int along, int across) {
    return without_mid_side_nodes(box_mesh({0, 0, 0}, {10, 1, 1}, {along, 1, across}));
}

}  // namespace

TEST_CASE("linear elements with enhanced strains bend, those without lock") {
    constexpr auto svk = MaterialLaw::saint_venant_kirchhoff;
    CHECK(cantilever(plane_beam(20, 4), LinearElements::enhanced, 0.3, svk) == doctest::Approx(1).epsilon(0.01));
    CHECK(cantilever(deep_beam(20, 4), LinearElements::enhanced, 0.3, svk) == doctest::Approx(1).epsilon(0.01));
    CHECK(cantilever(plane_beam(20, 1), LinearElements::enhanced, 0.3, svk) == doctest::Approx(1).epsilon(0.03));
    CHECK(cantilever(plane_beam(20, 1), LinearElements::displacement, 0.3, svk) < 0.8);
    CHECK(cantilever(deep_beam(20, 1), LinearElements::displacement, 0.3, svk) < 0.8);
}

TEST_CASE("linear elements with enhanced strains do not lock as ν approaches ½, four through the thickness") {
    for (const MaterialLaw law : {MaterialLaw::linear, MaterialLaw::neo_hookean}) {
        // The clamp hinders the change of section, which beam theory does not know: against quadratic elements.
        const double expected = cantilever(box_mesh({0, 0}, {10, 1}, 80, 16), LinearElements::enhanced, 0.4999, law);
        CHECK(cantilever(plane_beam(20, 4), LinearElements::enhanced, 0.4999, law) ==
              doctest::Approx(expected).epsilon(0.02));
        CHECK(cantilever(deep_beam(20, 4), LinearElements::enhanced, 0.4999, law) ==
              doctest::Approx(expected).epsilon(0.02));
        CHECK(cantilever(plane_beam(20, 4), LinearElements::displacement, 0.4999, law) < 0.5 * expected);
    }
}

// Cook's membrane, plane strain, E 1, ν 0.4999, unit shear; at its upper corner, where quadratic elements converge to
// 7.72 × 250 / 100 (static_benchmarks.cpp).
TEST_CASE("Cook's membrane, nearly incompressible, in four-node quadrilaterals") {
    const auto tip = [](int n, LinearElements kind) {
        Mesh<2> mesh = without_mid_side_nodes(box_mesh({0, 0}, {1, 1}, n, n));
        for (auto& [x, y] : mesh.nodes) {
            const double s = x, t = y;
            x = 48 * s;
            y = 44 * s + t * (44 - 28 * s);
        }
        Options<2> options;
        options.material = test::material(MaterialLaw::linear, 1, 1, 0.4999);
        options.linear_elements = kind;
        options.clamps = {{"left", {true, true}}};
        Solver<2> solver(mesh, options);
        std::vector<double> loads(2 * mesh.nodes.size(), 0.0);
        for (const Facet& edge : mesh.surface("right"))
            for (const NodeIndex node : edge) loads[2 * std::size_t(node) + 1] += 0.5 / n;
        solver.solve_static(loads, serial_loop);
        return solver.displacements()[2 * std::size_t(mesh.node_set("right").back()) + 1];
    };
    const double coarse = tip(8, LinearElements::enhanced), fine = tip(32, LinearElements::enhanced);
    CHECK(fine == doctest::Approx(19.3).epsilon(0.01));
    CHECK(coarse == doctest::Approx(19.3).epsilon(0.05));
    CHECK(tip(32, LinearElements::displacement) < 0.4 * fine);
}
