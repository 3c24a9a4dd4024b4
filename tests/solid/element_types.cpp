// Every type of element with every law: slopes, patch test, mass, rigid motions; parts of other materials.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/solid/elements/dispatch.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

// A small box of each type, its inner and outer nodes moved a little at random.
template <class Type>
Mesh<Type::dimension> shaken(double amount) {
    constexpr int D = Type::dimension;
    Mesh<D> mesh;
    if constexpr (D == 2) {
        mesh = box_mesh({0, 0}, {1.5, 1}, 3, 2);
    } else if constexpr (std::is_same_v<Type, Tet10>) {
        mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
        const auto tetrahedron = [&](std::array<int, 4> corner) {
            Element& element = mesh.elements.emplace_back();
            for (const int a : corner) element.push_back(a);
            for (const auto& [p, q] : Tet10::edges) {
                std::array<double, 3> middle;
                for (std::size_t d = 0; d < 3; ++d)
                    middle[d] = 0.5 * (mesh.nodes[std::size_t(corner[p])][d] + mesh.nodes[std::size_t(corner[q])][d]);
                auto found = std::find(mesh.nodes.begin(), mesh.nodes.end(), middle);
                if (found == mesh.nodes.end()) found = mesh.nodes.insert(found, middle);
                element.push_back(int(found - mesh.nodes.begin()));
            }
        };
        tetrahedron({0, 1, 2, 3});
        tetrahedron({1, 2, 3, 4});
    } else {
        mesh = box_mesh({0, 0, 0}, {1.5, 1, 1.2}, {3, 2, 2});
    }
    if constexpr (Type::node_count == Type::corner_count) mesh = without_mid_side_nodes(mesh);
    Random random;
    for (auto& X : mesh.nodes)
        for (double& x : X) x += amount * random();
    check(mesh);
    return mesh;
}

template <int D>
Options<D> options_of(MaterialLaw law) {
    Options<D> options;
    options.material = material(law, 2, 3, 0.3, 0.4, 0.2, 5);
    return options;
}

constexpr std::array all_laws{MaterialLaw::saint_venant_kirchhoff, MaterialLaw::linear, MaterialLaw::neo_hookean,
                              MaterialLaw::mooney_rivlin};

}  // namespace

TEST_CASE_TEMPLATE("every element and law: forces are the slope of the energy, the tangent that of the forces", Type,
                   Quad4, Quad8, Hex8, Hex20, Tet10) {
    constexpr int D = Type::dimension;
    const Mesh<D> mesh = shaken<Type>(0.04);
    Random random;
    std::vector<double> u(D * mesh.nodes.size()), f(u.size()), above(u.size()), below(u.size());
    for (double& x : u) x = 0.06 * random();
    for (const MaterialLaw law : all_laws)
        for (const LinearElements kind : {LinearElements::enhanced, LinearElements::displacement}) {
            if (kind == LinearElements::displacement && Type::node_count != Type::corner_count) continue;
            Options<D> options = options_of<D>(law);
            options.linear_elements = kind;
            Assembly<D> assembly(mesh, options);
            std::vector<double> values(assembly.rows().size());
            CHECK(assembly.internal_forces(u, f, serial_loop) > 0.2);
            assembly.system_matrix(u, 1, 0, values, serial_loop);
            constexpr double h = 1e-6;
            for (std::size_t c = 0; c < u.size(); c += 5) {
                std::vector<double> moved = u;
                moved[c] += h;
                const double energy_above = assembly.energy(moved);
                assembly.internal_forces(moved, above, serial_loop);
                moved[c] -= 2 * h;
                CHECK(std::abs(f[c] - (energy_above - assembly.energy(moved)) / (2 * h)) < 1e-8);
                assembly.internal_forces(moved, below, serial_loop);
                for (int k = assembly.column_starts()[c]; k < assembly.column_starts()[c + 1]; ++k) {
                    const auto row = std::size_t(assembly.rows()[std::size_t(k)]);
                    CHECK(std::abs(values[std::size_t(k)] - (above[row] - below[row]) / (2 * h)) < 3e-8);
                }
            }
        }
}

TEST_CASE_TEMPLATE("every element: a linear field has constant stress, and forces on the boundary alone", Type, Quad4,
                   Quad8, Hex8, Hex20, Tet10) {
    constexpr int D = Type::dimension;
    Mesh<D> mesh =
        shaken<Type>(Type::node_count == Type::corner_count ? 0.08 : 0);  // mid-side nodes stay in the middle
    std::vector<bool> boundary(mesh.nodes.size(), false);
    for (const Facet& facet : boundary_facets(mesh))
        for (const NodeIndex n : facet) boundary[std::size_t(n)] = true;
    constexpr double H[3][3] = {{0.2, 0.15, -0.1}, {-0.1, -0.12, 0.05}, {0.07, -0.2, 0.1}};
    std::vector<double> u(D * mesh.nodes.size()), f(u.size()), stress(mesh.elements.size());
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t j = 0; j < D; ++j) u[D * n + i] += H[i][j] * mesh.nodes[n][j];
    for (const MaterialLaw law : all_laws) {
        Assembly<D> assembly(mesh, options_of<D>(law));
        assembly.internal_forces(u, f, serial_loop);
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            if (!boundary[n])
                for (std::size_t i = 0; i < D; ++i) CHECK(std::abs(f[D * n + i]) < 1e-13);
        assembly.von_mises(u, stress);
        for (const double s : stress) CHECK(s == doctest::Approx(stress[0]).epsilon(1e-11));
    }
}

TEST_CASE_TEMPLATE("every element: the mass is that of the volume, rigid motions cost nothing", Type, Quad4, Quad8,
                   Hex8, Hex20, Tet10) {
    constexpr int D = Type::dimension;
    const Mesh<D> mesh = shaken<Type>(0.03);
    double volume = 0;
    for (const Element& element : mesh.elements)
        for (const auto& point : Type::mass_rule())
            volume +=
                point.weight * reference_gradients(Type::shape(point.xi), coordinates<Type>(mesh, element)).jacobian;
    std::vector<double> u(D * mesh.nodes.size()), f(u.size());
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const auto& X = mesh.nodes[n];
        u[D * n] = (std::cos(2.5) - 1) * X[0] - std::sin(2.5) * X[1] + 3;
        u[D * n + 1] = std::sin(2.5) * X[0] + (std::cos(2.5) - 1) * X[1] - 1;
    }
    for (const MaterialLaw law :
         {MaterialLaw::saint_venant_kirchhoff, MaterialLaw::neo_hookean, MaterialLaw::mooney_rivlin}) {
        Assembly<D> assembly(mesh, options_of<D>(law));
        CHECK(assembly.mass() == doctest::Approx(2 * volume).epsilon(1e-12));
        CHECK(assembly.internal_forces(u, f, serial_loop) == doctest::Approx(1).epsilon(1e-12));
        for (const double x : f) CHECK(std::abs(x) < 1e-12);
        CHECK(std::abs(assembly.energy(u)) < 1e-13);
    }
}

TEST_CASE("parts of another material: the stiff half of a bar stretches less") {
    Mesh<3> mesh = box_mesh({0, 0, 0}, {2, 0.1, 0.1}, {8, 1, 1});
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        if (mesh.nodes[std::size_t(mesh.elements[e][0])][0] > 0.99) mesh.element_sets["outer"].push_back(int(e));
    Options<3> options;
    options.material = material(MaterialLaw::linear, 2, 3, 0);
    options.parts = {{"outer", material(MaterialLaw::linear, 2, 12, 0)}};
    options.clamps = {{"left", {true, true, true}}};
    std::vector<double> no_force(3 * mesh.nodes.size(), 0.0);
    no_force[3 * std::size_t(mesh.node_set("right")[1]) + 1] = 1e-3;  // one element across has modes without energy
    CHECK_THROWS_WITH_AS(Solver<3>(mesh, options).solve_static(no_force, serial_loop), doctest::Contains("two across"),
                         ConvergenceError);
    options.integration = Integration::full;
    Solver<3> solver(mesh, options);
    std::vector<double> loads(3 * mesh.nodes.size(), 0.0);
    constexpr double share[8] = {-1.0 / 12, -1.0 / 12, -1.0 / 12, -1.0 / 12, 1.0 / 3, 1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (const Facet& facet : mesh.surface("right"))
        for (std::size_t k = 0; k < 8; ++k) loads[3 * std::size_t(facet[k])] += share[k] * 0.01 * 0.3;
    solver.solve_static(loads, serial_loop);
    const auto tip = std::size_t(mesh.node_set("right")[0]);
    CHECK(solver.displacements()[3 * tip] == doctest::Approx(0.3 * (1.0 / 3 + 1.0 / 12)).epsilon(1e-9));
    CHECK(solver.mass() == doctest::Approx(2 * 0.02).epsilon(1e-12));
}
