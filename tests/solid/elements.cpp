// The element and its assembly: shape functions, patch test, rigid motions, tangent, and a slow twin of all of it.
#include "physics/solid/assembly.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "physics/solid/elements/dispatch.hpp"
#include "physics/solid/materials/mooney_rivlin.hpp"
#include "physics/solid/materials/neo_hookean.hpp"
#include "physics/solid/materials/saint_venant_kirchhoff.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

// A box mesh whose inner corners are moved at random; mid-side nodes stay in the middle, so that a linear field is in
// it.
Mesh<2> distorted_patch(int columns, int rows, double amount) {
    Mesh<2> mesh = box_mesh({0, 0}, {2, 1}, columns, rows);
    std::vector<bool> fixed(mesh.nodes.size(), false);
    for (const auto& [name, set] : mesh.node_sets)
        for (const NodeIndex node : set) fixed[static_cast<std::size_t>(node)] = true;
    Random random;
    std::vector<bool> moved(mesh.nodes.size(), false);
    for (const Element& element : mesh.elements)
        for (std::size_t a = 0; a < 4; ++a) {
            const auto n = static_cast<std::size_t>(element[a]);
            if (fixed[n] || moved[n]) continue;
            moved[n] = true;
            for (double& x : mesh.nodes[n]) x += amount * random();
        }
    for (const Element& element : mesh.elements)
        for (std::size_t s = 0; s < 4; ++s) {
            const auto &A = mesh.nodes[static_cast<std::size_t>(element[s])],
                       &B = mesh.nodes[static_cast<std::size_t>(element[(s + 1) % 4])];
            mesh.nodes[static_cast<std::size_t>(element[4 + s])] = {0.5 * (A[0] + B[0]), 0.5 * (A[1] + B[1])};
        }
    return mesh;
}

Options<2> steel_like() {
    Options<2> options;
    options.material.youngs_modulus = 3;
    options.material.poissons_ratio = 0.3;
    options.material.density = 2;
    return options;
}

// F_int, straight from the formula: one element, one point, one component at a time.
template <class Type, class Law, int D = Type::dimension>
std::vector<double> slow_internal_forces(const Mesh<D>& mesh, const Law& law, const std::vector<double>& u) {
    std::vector<double> f(u.size(), 0.0);
    for (const Element& nodes : mesh.elements)
        for (const auto& point : Type::stiffness_rule()) {
            const auto s = Type::shape(point.xi);
            const auto at = [&](std::size_t a) { return static_cast<std::size_t>(nodes[a]); };
            Eigen::Matrix<double, D, D> dX, dU;  // ∂X/∂ξ, ∂u/∂ξ
            dX.setZero();
            dU.setZero();
            for (std::size_t a = 0; a < nodes.size(); ++a)
                for (std::size_t i = 0; i < D; ++i)
                    for (std::size_t k = 0; k < D; ++k) {
                        dX(int(i), int(k)) += mesh.nodes[at(a)][i] * s.dN[a][k];
                        dU(int(i), int(k)) += u[D * at(a) + i] * s.dN[a][k];
                    }
            const Eigen::Matrix<double, D, D> inverse = dX.inverse(), gradient = dU * inverse;
            Tensor<D, double> H;
            for (std::size_t i = 0; i < D; ++i)
                for (std::size_t j = 0; j < D; ++j) H(i, j) = gradient(int(i), int(j));
            const auto P = first_piola(law, kinematics<Law, D, double>(H));
            for (std::size_t a = 0; a < nodes.size(); ++a)
                for (std::size_t i = 0; i < D; ++i)
                    for (std::size_t j = 0; j < D; ++j)
                        for (std::size_t k = 0; k < D; ++k)
                            f[D * at(a) + i] +=
                                point.weight * dX.determinant() * P(i, j) * s.dN[a][k] * inverse(int(k), int(j));
        }
    return f;
}

std::vector<double> random_displacements(const Mesh<2>& mesh, double amount) {
    Random random;
    std::vector<double> u(2 * mesh.nodes.size());
    for (double& x : u) x = amount * random();
    return u;
}

}  // namespace

TEST_CASE_TEMPLATE("shape functions are one at their node, sum to one, and their derivatives are derivatives", Type,
                   Quad4, Quad8, Hex8, Hex20, Tet10) {
    constexpr std::size_t n = Type::node_count, D = Type::dimension;
    for (std::size_t a = 0; a < n; ++a) {
        const auto s = Type::shape(Type::parent_nodes[a]);
        for (std::size_t b = 0; b < n; ++b) CHECK(s.N[b] == doctest::Approx(a == b ? 1 : 0));
    }
    std::array<double, D> xi{0.3, 0.2};
    if (D == 3) xi[D - 1] = 0.15;
    constexpr double h = 1e-6;
    const auto s = Type::shape(xi);
    double sum = 0;
    for (std::size_t a = 0; a < n; ++a) {
        sum += s.N[a];
        for (std::size_t d = 0; d < D; ++d) {
            auto above = xi, below = xi;
            above[d] += h;
            below[d] -= h;
            CHECK(s.dN[a][d] ==
                  doctest::Approx((Type::shape(above).N[a] - Type::shape(below).N[a]) / (2 * h)).epsilon(1e-8));
        }
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-15));
}

// ∫ ξ^p η^q ζ^r over the parent domain, up to the degree that each rule is exact for.
TEST_CASE_TEMPLATE("Gauss rules integrate the polynomials that they are made for", Type, Quad4, Quad8, Hex8, Hex20,
                   Tet10) {
    constexpr int D = Type::dimension;
    constexpr bool tetrahedron = std::is_same_v<Type, Tet10>;
    const auto exact = [](const std::array<int, 3>& p) {
        if (tetrahedron)  // p! q! r! / (p + q + r + 3)!
            return std::tgamma(p[0] + 1) * std::tgamma(p[1] + 1) * std::tgamma(p[2] + 1) /
                   std::tgamma(p[0] + p[1] + p[2] + 4);
        double product = 1;
        for (int d = 0; d < D; ++d) product *= p[std::size_t(d)] % 2 == 1 ? 0 : 2.0 / (p[std::size_t(d)] + 1);
        return product;
    };
    const auto check_rule = [&](const auto& rule, int degree) {
        for (int p = 0; p <= degree; ++p)
            for (int q = 0; q <= degree; ++q)
                for (int r = 0; r <= (D == 3 ? degree : 0); ++r) {
                    if (tetrahedron && p + q + r > degree) continue;
                    double sum = 0;
                    for (const auto& point : rule)
                        sum += point.weight * std::pow(point.xi[0], p) * std::pow(point.xi[1], q) *
                               (D == 3 ? std::pow(point.xi[D - 1], r) : 1);
                    CHECK(sum == doctest::Approx(exact({p, q, r})).epsilon(1e-12).scale(1));
                }
    };
    check_rule(Type::stiffness_rule(), tetrahedron ? 2 : 3);
    check_rule(Type::mass_rule(), Type::node_count == Type::corner_count ? 3 : 5);
}

TEST_CASE("patch test: a distorted patch under a linear boundary displacement deforms linearly, stress constant") {
    for (const MaterialLaw law : {MaterialLaw::saint_venant_kirchhoff, MaterialLaw::neo_hookean}) {
        Options<2> options = steel_like();
        options.material.law = law;
        Mesh<2> mesh = distorted_patch(4, 3, 0.06);
        const Solver<2> undeformed(mesh, options);
        // Displacement u = H X everywhere must be in equilibrium inside: forces at the inner nodes vanish.
        const double H[2][2] = {{0.2, 0.15}, {-0.1, -0.12}};
        std::vector<double> u(2 * mesh.nodes.size()), f(u.size());
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            const auto [X, Y] = mesh.nodes[n];
            u[2 * n] = H[0][0] * X + H[0][1] * Y;
            u[2 * n + 1] = H[1][0] * X + H[1][1] * Y;
        }
        Assembly<2> assembly(mesh, options);
        assembly.internal_forces(u, f, serial_loop);
        std::vector<bool> boundary(mesh.nodes.size(), false);
        for (const Facet& edge : boundary_facets(mesh))
            for (const NodeIndex n : edge) boundary[static_cast<std::size_t>(n)] = true;
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            if (!boundary[n]) CHECK(std::hypot(f[2 * n], f[2 * n + 1]) < 1e-14);

        // And solved for: pulled by the tractions P·N of a uniaxial state the body takes that state.
        options.clamps = {{"left", {true, false}}, {"bottom", {false, true}}};
        Solver<2> solver(mesh, options);
        solver.solve_static(traction(mesh, "right", {0.5, 0}), serial_loop);
        const std::size_t corner = nearest_node(mesh, 2, 1);
        const auto solved = solver.displacements();
        const double stretch_x = solved[2 * corner] / 2, stretch_y = solved[2 * corner + 1];
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            CHECK(std::abs(solved[2 * n] - stretch_x * mesh.nodes[n][0]) < 1e-9);
            CHECK(std::abs(solved[2 * n + 1] - stretch_y * mesh.nodes[n][1]) < 1e-9);
        }
        std::vector<double> stress(mesh.elements.size());
        solver.element_stress(stress);
        for (const double s : stress) CHECK(s == doctest::Approx(stress[0]).epsilon(1e-8));
    }
}

TEST_CASE("one element held as a rigid body has a mode without energy, two elements have none") {
    const auto held = [](Mesh<2> mesh) {
        mesh.node_sets["pin"] = {static_cast<NodeIndex>(nearest_node(mesh, 0, 0))};
        mesh.node_sets["roller"] = {static_cast<NodeIndex>(nearest_node(mesh, 2, 0))};
        Options<2> options = steel_like();
        options.clamps = {{"pin", {true, true}}, {"roller", {false, true}}};
        return Solver<2>(mesh, options);
    };
    const auto pull = [&](const Mesh<2>& mesh) {
        Solver<2> solver = held(mesh);
        const auto load = traction(mesh, "right", {0.01, 0});
        std::vector<double> balanced = load;  // pulled at both ends
        const auto left = traction(mesh, "left", {-0.01, 0});
        for (std::size_t f = 0; f < load.size(); ++f) balanced[f] += left[f];
        solver.solve_static(balanced, serial_loop);
        // Uniaxial, plane strain: E_xx = (1 - ν²)/E of a stress so small that it is linear to a percent.
        const double expected = 2 * 0.01 * (1 - 0.09) / steel_like().material.youngs_modulus;
        CHECK(solver.displacements()[2 * nearest_node(mesh, 2, 1)] -
                  solver.displacements()[2 * nearest_node(mesh, 0, 1)] ==
              doctest::Approx(expected).epsilon(0.01));
    };
    pull(box_mesh({0, 0}, {2, 1}, 2, 1));
    pull(box_mesh({0, 0}, {2, 1}, 1, 2));
    pull(distorted_patch(3, 2, 0.05));
    Solver<2> single = held(box_mesh({0, 0}, {2, 1}, 1, 1));
    CHECK_THROWS_AS(single.solve_static(traction(single.mesh(), "right", {0.01, 0.003}), serial_loop),
                    ConvergenceError);
}

TEST_CASE("a rigid motion gives neither force nor stress nor energy") {
    const Mesh<2> mesh = distorted_patch(4, 3, 0.06);
    for (const MaterialLaw law : {MaterialLaw::saint_venant_kirchhoff, MaterialLaw::neo_hookean}) {
        Options<2> options = steel_like();
        options.material.law = law;
        Assembly<2> assembly(mesh, options);
        std::vector<double> u(2 * mesh.nodes.size()), f(u.size()), stress(mesh.elements.size());
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            const auto [X, Y] = mesh.nodes[n];
            u[2 * n] = std::cos(2.5) * X - std::sin(2.5) * Y - X + 3;
            u[2 * n + 1] = std::sin(2.5) * X + std::cos(2.5) * Y - Y - 1;
        }
        CHECK(assembly.internal_forces(u, f, serial_loop) == doctest::Approx(1).epsilon(1e-13));
        for (const double x : f) CHECK(std::abs(x) < 1e-13);
        CHECK(std::abs(assembly.energy(u)) < 1e-15 * options.material.youngs_modulus);  // rounding
        assembly.von_mises(u, stress);
        for (const double s : stress) CHECK(std::abs(s) < 1e-12);
    }
}

TEST_CASE("the vectorised forces are those of the formula; the forces are the slope of the energy") {
    const Mesh<2> mesh = distorted_patch(5, 3, 0.05);  // 15 elements: the last pack is not full
    const std::vector<double> u = random_displacements(mesh, 0.02);
    Options<2> options = steel_like();
    std::vector<double> f(u.size());
    const auto compare = [&](const auto& material) {
        Assembly<2> assembly(mesh, options);
        assembly.internal_forces(u, f, serial_loop);
        const std::vector<double> slow = slow_internal_forces<Quad8>(mesh, material, u);
        for (std::size_t k = 0; k < f.size(); ++k)
            CHECK(std::abs(f[k] - slow[k]) < 1e-14 * options.material.youngs_modulus);
        constexpr double h = 1e-6;
        for (std::size_t k = 0; k < u.size(); k += 7) {
            std::vector<double> above = u, below = u;
            above[k] += h;
            below[k] -= h;
            const double slope = (assembly.energy(above) - assembly.energy(below)) / (2 * h);
            CHECK(std::abs(f[k] - slope) < 1e-8);
        }
    };
    const double E = options.material.youngs_modulus, nu = options.material.poissons_ratio;
    compare(SaintVenantKirchhoff<2>::solid(E, nu));
    options.plane = PlaneCondition::stress;
    compare(SaintVenantKirchhoff<2>::plane_stress(E, nu));
    options.plane = PlaneCondition::strain;
    options.material.law = MaterialLaw::linear;
    compare(LinearElastic<2>::solid(E, nu));
    options.material.law = MaterialLaw::neo_hookean;
    compare(NeoHookean<2>::solid(E, nu));
    options.material.law = MaterialLaw::mooney_rivlin;
    options.material.c10 = 0.4;
    options.material.c01 = 0.2;
    options.material.bulk_modulus = 5;
    compare(MooneyRivlin<2>{0.4, 0.2, 5});
}

TEST_CASE("the assembled tangent is the slope of the assembled forces, without the clamped rows") {
    const Mesh<2> mesh = distorted_patch(3, 3, 0.05);
    const std::vector<double> u = random_displacements(mesh, 0.02);
    Options<2> options = steel_like();
    options.clamps = {{"left", {true, true}}, {"top", {false, true}}};
    for (const MaterialLaw law : {MaterialLaw::saint_venant_kirchhoff, MaterialLaw::neo_hookean}) {
        options.material.law = law;
        Assembly<2> assembly(mesh, options);
        std::vector<double> values(assembly.rows().size()), above(u.size()), below(u.size());
        assembly.system_matrix(u, 1, 0, values, serial_loop);
        const std::size_t n = assembly.equations();
        std::vector<double> K(n * n, 0.0);  // dense
        for (std::size_t c = 0; c < n; ++c)
            for (int k = assembly.column_starts()[c]; k < assembly.column_starts()[c + 1]; ++k) {
                const auto r = static_cast<std::size_t>(assembly.rows()[static_cast<std::size_t>(k)]);
                K[r * n + c] = K[c * n + r] = values[static_cast<std::size_t>(k)];
            }
        constexpr double h = 1e-6;
        double worst = 0;
        for (std::size_t c = 0; c < n; ++c) {
            std::vector<double> moved = u;
            moved[assembly.freedoms()[c]] += h;
            assembly.internal_forces(moved, above, serial_loop);
            moved[assembly.freedoms()[c]] -= 2 * h;
            assembly.internal_forces(moved, below, serial_loop);
            for (std::size_t r = 0; r < n; ++r) {
                const std::size_t f = assembly.freedoms()[r];
                worst = std::max(worst, std::abs(K[r * n + c] - (above[f] - below[f]) / (2 * h)));
            }
        }
        CHECK(worst < 1e-8);
        for (std::size_t c = 0; c < n; ++c) CHECK(assembly.stiffness_diagonal()[c] == K[c * n + c]);
    }
}

TEST_CASE("the mass: total, centre, product with vectors, and the matrix agree") {
    Mesh<2> mesh = distorted_patch(4, 3, 0.05);
    Options<2> options = steel_like();
    options.thickness = 0.5;
    options.gravity = {1.5, -9.81};
    Assembly<2> assembly(mesh, options);
    CHECK(assembly.mass() == doctest::Approx(2 * 0.5 * 2).epsilon(1e-14));  // area × thickness × density
    std::vector<double> x(2 * mesh.nodes.size()), y(x.size());
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) x[2 * n] = mesh.nodes[n][0];
    assembly.multiply_mass(x, y, serial_loop);
    double first_moment = 0, second_moment = 0, weight_x = 0, weight_y = 0;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        first_moment += y[2 * n];
        second_moment += x[2 * n] * y[2 * n];
        weight_x += assembly.gravity_forces()[2 * n];
        weight_y += assembly.gravity_forces()[2 * n + 1];
        CHECK(y[2 * n + 1] == 0);
    }
    CHECK(first_moment == doctest::Approx(assembly.mass() * 1).epsilon(1e-13));
    CHECK(second_moment == doctest::Approx(assembly.mass() * 4.0 / 3).epsilon(1e-13));
    CHECK(weight_x == doctest::Approx(assembly.mass() * 1.5).epsilon(1e-13));
    CHECK(weight_y == doctest::Approx(assembly.mass() * -9.81).epsilon(1e-13));

    std::vector<double> values(assembly.rows().size()), z(x.size(), 0.0);
    const std::vector<double> v = random_displacements(mesh, 1);
    assembly.system_matrix(v, 0, 1, values, serial_loop);
    for (std::size_t c = 0; c < assembly.equations(); ++c)
        for (int k = assembly.column_starts()[c]; k < assembly.column_starts()[c + 1]; ++k) {
            const auto r = static_cast<std::size_t>(assembly.rows()[static_cast<std::size_t>(k)]);
            z[r] += values[static_cast<std::size_t>(k)] * v[c];
            if (r != c) z[c] += values[static_cast<std::size_t>(k)] * v[r];
        }
    assembly.multiply_mass(v, y, serial_loop);
    for (std::size_t k = 0; k < z.size(); ++k) CHECK(std::abs(z[k] - y[k]) < 1e-14);
}
