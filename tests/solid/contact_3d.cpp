// Contact in three dimensions: slip against differences, Hertz, a wheel against its plane twin, threads.
#include "physics/solid/contact.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/solid/wheels.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

// Where elements end, from the middle outwards; mid-side nodes in the middle.
double placed(double part, const std::vector<double>& ends) {
    const double k = part * double(ends.size() - 1);
    return 0.5 * (ends[std::size_t(k + 1e-9)] + ends[std::size_t(k + 1 - 1e-9)]);
}

// A plane mesh of quadrilaterals drawn along z: hexahedra, with surfaces and node sets of the same names, and the node
// set free: those that are not in inner.
Mesh<3> drawn(const Mesh<2>& plane, double width, int layers) {
    Mesh<3> mesh;
    const int count = int(plane.nodes.size());
    for (int layer = 0; layer <= layers; ++layer)
        for (const auto& X : plane.nodes) {
            mesh.nodes.push_back({X[0], X[1], width * layer / layers});
        }
    for (int layer = 0; layer < layers; ++layer) {
        const int below = layer * count, above = below + count;
        for (const Element& e : plane.elements)
            mesh.elements.push_back({e[0] + below, e[1] + below, e[2] + below, e[3] + below, e[0] + above, e[1] + above,
                                     e[2] + above, e[3] + above});
        for (const auto& [name, facets] : plane.surfaces)
            for (const Facet& f : facets)
                mesh.surfaces[name].push_back({f[0] + below, f[1] + below, f[1] + above, f[0] + above});
    }
    for (const auto& [name, nodes] : plane.node_sets)
        for (int layer = 0; layer <= layers; ++layer)
            for (const NodeIndex n : nodes) mesh.node_sets[name].push_back(n + layer * count);
    for (NodeIndex n = 0; n < NodeIndex(mesh.nodes.size()); ++n)
        if (!std::binary_search(mesh.node_sets["inner"].begin(), mesh.node_sets["inner"].end(), n))
            mesh.node_sets["free"].push_back(n);
    return mesh;
}

}  // namespace

TEST_CASE("the tangent of slip against differences, the pressure kept") {
    // Displacements along the plane: those across it change the pressure, which the tangent leaves out.
    const Mesh<3> mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 1});
    Options<3> options;
    options.material.youngs_modulus = 1;
    GroundContact<3> contact(mesh, options, {"bottom", {.point = {0, 0, 0.1}, .direction = {0, 0, 1}}, 0.2, 50.0});
    const std::size_t size = 3 * mesh.nodes.size();
    std::vector<double> u(size), matrices(contact.matrix_size()), K(size * size, 0.0), plus(size), minus(size);
    for (std::size_t f = 0; f < size; ++f) u[f] = 0.02 * std::sin(3.0 * double(f) + 1) + (f % 3 == 0 ? 0.5 : 0);
    contact.tangents({}, u, contact.history(), matrices, serial_loop);
    const double* entry = matrices.data();
    for (const Facet& facet : mesh.surface("bottom"))
        for (std::size_t r = 0; r < 3 * facet.size(); ++r)
            for (std::size_t c = 0; c <= r; ++c, ++entry) {
                const std::size_t row = 3 * std::size_t(facet[r / 3]) + r % 3,
                                  column = 3 * std::size_t(facet[c / 3]) + c % 3;
                K[row * size + column] += *entry;
                if (c < r) K[column * size + row] += *entry;
            }
    double worst = 0, largest = 0;
    for (std::size_t column = 0; column < size; ++column) {
        if (column % 3 == 2) continue;
        constexpr double h = 1e-6;
        std::vector<double> moved = u;
        std::fill(plus.begin(), plus.end(), 0.0);
        std::fill(minus.begin(), minus.end(), 0.0);
        moved[column] += h;
        contact.add_forces(1, moved, plus, serial_loop);
        moved[column] -= 2 * h;
        contact.add_forces(1, moved, minus, serial_loop);
        for (std::size_t row = 0; row < size; ++row) {
            worst = std::max(worst, std::abs(K[row * size + column] + (plus[row] - minus[row]) / (2 * h)));
            largest = std::max(largest, std::abs(K[row * size + column]));
        }
    }
    CHECK(largest > 1e-3);
    CHECK(worst < 1e-6 * largest);
}

TEST_CASE("Hertz: a rigid sphere pressed into an elastic half-space, force, radius and pressure") {
    constexpr double R = 10, depth = 0.001, E = 1e6, nu = 0.3;
    const std::vector<double> along{0, 0.03, 0.06, 0.09, 0.12, 0.2, 0.5, 1.4, 4}, down{0, 0.04, 0.1, 0.25, 0.7, 1.8, 4};
    Mesh<3> mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {8, 8, 6});
    for (auto& X : mesh.nodes) X = {placed(X[0], along), placed(X[1], along), -placed(1 - X[2], down)};
    Options<3> options;
    options.material = material(MaterialLaw::saint_venant_kirchhoff, 1000, E, nu);
    options.integration = Integration::full;  // columns of thin elements
    options.clamps = {{"left", {true, false, false}}, {"front", {false, true, false}}, {"bottom", {true, true, true}}};
    options.contacts = {{"top",
                         {.shape = GroundShape::sphere,
                          .point = {0, 0, R},
                          .radius = R,
                          .displacement = {TimeFunction{}, TimeFunction{}, law(ConstantRate{-depth, {}})}},
                         0,
                         1e9}};
    Solver<3> solver(mesh, options);
    solver.set_time(1);
    solver.solve_static(std::vector<double>(3 * mesh.nodes.size(), 0.0), serial_loop);
    const double modulus = E / (1 - nu * nu), a = std::sqrt(R * depth), force = 4.0 / 3 * modulus * a * depth,
                 pressure = 1.5 * force / (M_PI * a * a);
    const auto report = solver.contact(0);
    MESSAGE("force ", 4 * -report.force[2] / force, ", radius ", std::sqrt(4 * report.area / M_PI) / a,
            ", largest pressure ", report.largest_pressure / pressure, " of Hertz's");
    // What is clamped at 40 radii would sink by 1 % of the depth in a half-space.
    CHECK(4 * -report.force[2] == doctest::Approx(force).epsilon(0.03));
    CHECK(std::sqrt(4 * report.area / M_PI) == doctest::Approx(a).epsilon(0.03));
    CHECK(report.largest_pressure == doctest::Approx(pressure).epsilon(0.06));

    // At the nodes: p0 √(1 - r²/a²), and nothing beyond.
    std::vector<double> nodal(mesh.nodes.size());
    solver.contact_pressure(nodal);
    for (const NodeIndex node : mesh.node_set("top")) {
        const auto& X = mesh.nodes[std::size_t(node)];
        const double r = std::hypot(X[0], X[1]);
        if (r < 0.6 * a)
            CHECK(nodal[std::size_t(node)] == doctest::Approx(pressure * std::sqrt(1 - r * r / (a * a))).epsilon(0.08));
        if (r > 2 * a) CHECK(nodal[std::size_t(node)] == 0);
    }
}

TEST_CASE("a wheel between planes is its plane twin: rim lowered on the ground, inflated, rolled") {
    // Elements of displacements alone: with enhanced strains hexahedra and quadrilaterals are not the same.
    const Mesh<2> plane = without_mid_side_nodes(ring(0.2, 0.3, 48, 2));
    constexpr double width = 0.1;
    const Mesh<3> solid = drawn(plane, width, 2);
    const TimeFunction down = TimeFunction::table({0, 0.02, 1}, {0, -0.01, -0.01}), roll{0, {ConstantRate{2, {}}}},
                       turn{0, {ConstantRate{-2 / 0.3, {}}}}, pressure = TimeFunction::constant(2e4);
    Options<2> options2 = soft_rubber<2>();
    options2.linear_elements = LinearElements::displacement;
    options2.thickness = width;
    options2.rigid_bodies = {{.set = "inner", .motion = {roll, down, turn}}};
    options2.pressures = {{"inner", pressure}};
    options2.contacts = {{"outer", {.point = {0, -0.3}, .direction = {0, 1}}, 0.6}};
    Options<3> options3 = soft_rubber<3>();
    options3.linear_elements = LinearElements::displacement;
    options3.clamps = {{"free", {false, false, true}}};
    options3.rigid_bodies = {
        {.set = "inner", .motion = {roll, down, TimeFunction{}, TimeFunction{}, TimeFunction{}, turn}}};
    options3.pressures = {{"inner", pressure}};
    options3.contacts = {{"outer", {.point = {0, -0.3, 0}, .direction = {0, 1, 0}}, 0.6}};
    Solver<2> flat(plane, options2);
    Solver<3> deep(solid, options3);
    for (int k = 0; k < 30; ++k) {
        flat.advance(1e-3, std::vector<double>(2 * plane.nodes.size(), 0.0), serial_loop);
        deep.advance(1e-3, std::vector<double>(3 * solid.nodes.size(), 0.0), serial_loop);
    }
    const auto report2 = flat.contact(0);
    const auto report3 = deep.contact(0);
    REQUIRE(report2.force[1] > 10);
    CHECK(report3.force[0] == doctest::Approx(report2.force[0]).epsilon(1e-5));
    CHECK(report3.force[1] == doctest::Approx(report2.force[1]).epsilon(1e-5));
    CHECK(report3.area == doctest::Approx(report2.area).epsilon(1e-5));
    CHECK(deep.rigid_body(0).reaction[1] == doctest::Approx(flat.rigid_body(0).reaction[1]).epsilon(1e-5));
    CHECK(deep.rigid_body(0).reaction[5] == doctest::Approx(flat.rigid_body(0).reaction[2]).epsilon(1e-4));
    double worst = 0;
    for (std::size_t n = 0; n < solid.nodes.size(); ++n)
        for (std::size_t i = 0; i < 2; ++i)
            worst = std::max(worst, std::abs(deep.displacements()[3 * n + i] -
                                             flat.displacements()[2 * (n % plane.nodes.size()) + i]));
    CHECK(worst < 1e-7);  // of 6 cm
}

TEST_CASE("contact over several blocks of facets: the same bits on four threads") {
    const Mesh<2> mesh = box_mesh({0, 0}, {3, 0.05}, 300, 5);
    Options<2> options = soft_rubber<2>();
    options.gravity = {1, -9.81};
    options.contacts = {{"bottom", {.point = {0, 0}, .direction = {0, 1}}, 0.3}};
    const ThreadedLoop threads{4};
    Solver<2> serial(mesh, options), threaded(mesh, options);
    for (int k = 0; k < 8; ++k) {  // half a swing on the springs of the penalty
        serial.advance(1e-4, no_load(mesh), serial_loop);
        threaded.advance(1e-4, no_load(mesh), BlockLoop(threads));
    }
    REQUIRE(serial.contact(0).points.size() > 300);
    CHECK(copy(threaded.positions()) == copy(serial.positions()));
    CHECK(copy(threaded.accelerations()) == copy(serial.accelerations()));
    CHECK(threaded.energies().friction == serial.energies().friction);
    CHECK(threaded.contact(0).force == serial.contact(0).force);
}
