// Natural frequencies and shapes: published values, closed forms, rigid motions, prestress.
#include <doctest/doctest.h>

#include <cmath>

#include "physics/solid/eigenmodes.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

template <int D>
Options<D> elastic(double E, double nu, double density) {
    Options<D> options;
    options.material.youngs_modulus = E;
    options.material.poissons_ratio = nu;
    options.material.density = density;
    return options;
}

std::vector<double> frequencies(const std::vector<NaturalMode>& modes) {
    std::vector<double> list;
    for (const NaturalMode& mode : modes) list.push_back(mode.frequency);
    return list;
}

}  // namespace

TEST_CASE("eigenpairs of a chain of masses, simple and double") {
    // K of n springs in a row, M = identity: λ = 4 sin²(k π / (2 (n + 1))). A second chain beside it doubles every λ.
    constexpr int n = 40;
    for (const int chains : {1, 2}) {
        std::vector<int> starts{0}, rows;
        std::vector<double> K, M;
        for (int c = 0; c < chains; ++c)
            for (int i = 0; i < n; ++i) {
                rows.push_back(c * n + i), K.push_back(2), M.push_back(1);
                if (i + 1 < n) rows.push_back(c * n + i + 1), K.push_back(-1), M.push_back(0);
                starts.push_back(int(rows.size()));
            }
        const auto modes = lowest_eigenmodes(starts, rows, K, M, 8);
        REQUIRE(modes.size() == 8);
        for (int k = 0; k < 8; ++k) {
            const double s = std::sin((k / chains + 1) * M_PI / (2 * (n + 1)));
            CHECK(modes[std::size_t(k)].eigenvalue == doctest::Approx(4 * s * s).epsilon(1e-9));
            for (int j = 0; j <= k; ++j) {
                double dot = 0;
                for (std::size_t i = 0; i < std::size_t(chains * n); ++i)
                    dot += modes[std::size_t(k)].vector[i] * modes[std::size_t(j)].vector[i];
                CHECK(std::abs(dot - (j == k ? 1 : 0)) < 1e-7);
            }
        }
        CHECK_THROWS_AS(lowest_eigenmodes(starts, rows, K, M, 0), std::invalid_argument);
        CHECK_THROWS_AS(lowest_eigenmodes(starts, rows, K, M, chains * n), std::invalid_argument);
    }
}

TEST_CASE("the impact beam, clamped at both ends: 573, 1520, 2844 Hz") {
    Options<2> options = elastic<2>(67.5e9, 0.34, 2700);
    options.clamps = {{"left", {true, true}}, {"right", {true, true}}};
    Solver<2> solver(box_mesh({0, 0}, {0.60925, 0.04}, 120, 8), options);
    const auto modes = solver.natural_modes(3, serial_loop);
    CHECK(modes[0].frequency == doctest::Approx(573).epsilon(0.001));
    CHECK(modes[1].frequency == doctest::Approx(1520).epsilon(0.001));
    CHECK(modes[2].frequency == doctest::Approx(2844).epsilon(0.001));
    CHECK(modes[0].mass_fraction[1] == doctest::Approx(0.69).epsilon(0.02));  // of a clamped beam in bending
    CHECK(modes[1].mass_fraction[1] < 1e-6);                                  // antisymmetric
    CHECK(modes[0].mass_fraction[0] < 1e-6);
    // The shape: half a wave up, largest in the middle, nothing at the ends.
    CHECK(std::abs(modes[0].shape[2 * nearest_node(solver.mesh(), 0.60925 / 2, 0.02) + 1]) ==
          doctest::Approx(1).epsilon(1e-3));
    CHECK(modes[0].shape[2 * nearest_node(solver.mesh(), 0, 0.02) + 1] == 0);
}

TEST_CASE("the gate of rubber: 14.7 Hz") {
    Options<2> options = elastic<2>(11.96e6, 0.4, 1100);
    options.clamps = {{"top", {true, true}}};
    Solver<2> solver(box_mesh({0, 0}, {0.005, 0.079}, 4, 60), options);
    const auto modes = solver.natural_modes(1, serial_loop);
    CHECK(modes[0].frequency == doctest::Approx(14.7).epsilon(0.003));
    // What inverse iteration finds
    CHECK(modes[0].frequency == doctest::Approx(lowest_mode(solver.mesh(), options).frequency).epsilon(1e-6));
}

TEST_CASE("a bar in space along its length, and a simply supported square plate") {
    // ν = 0: f = (2k - 1) c / 4L, without bending since its sides are guided
    Options<3> bar = elastic<3>(1e9, 0, 1000);
    bar.clamps = {{"left", {true, true, true}},
                  {"front", {false, true, false}},
                  {"back", {false, true, false}},
                  {"bottom", {false, false, true}},
                  {"top", {false, false, true}}};
    Solver<3> rod(box_mesh({0, 0, 0}, {2, 0.1, 0.1}, {16, 1, 1}), bar);
    const auto along = frequencies(rod.natural_modes(3, serial_loop));
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(along[k] == doctest::Approx((2.0 * double(k) + 1) * 1000 / (4 * 2)).epsilon(2e-4));

    // Thin: f = π/2 (m² + n²)/a² sqrt(D / ρh), 11, 12 and 21 (double), 22; Reissner–Mindlin is 1 to 3 % lower at h/a
    // 1/50
    constexpr double a = 1, h = 0.02, E = 1e9, nu = 0.3, density = 1000;
    Options<3> options = elastic<3>(E, nu, density);
    options.clamps = {{"left", {false, true, true}},
                      {"right", {false, true, true}},
                      {"front", {true, false, true}},
                      {"back", {true, false, true}}};
    Mesh<3> mesh = box_mesh({0, 0, 0}, {a, a, h}, {10, 10, 1});
    for (const char* side : {"left", "right", "front", "back"}) {  // held along the middle of its edge alone
        auto& set = mesh.node_sets[side];
        std::erase_if(set, [&](NodeIndex n) { return std::abs(mesh.nodes[std::size_t(n)][2] - h / 2) > 1e-9; });
    }
    Solver<3> plate(mesh, options);
    const double unit = M_PI / 2 / (a * a) * std::sqrt(E * h * h * h / (12 * (1 - nu * nu)) / (density * h));
    const auto bent = frequencies(plate.natural_modes(4, serial_loop));
    CHECK(bent[0] == doctest::Approx(2 * unit).epsilon(0.01));
    CHECK(bent[1] == doctest::Approx(5 * unit).epsilon(0.02));
    CHECK(bent[2] == doctest::Approx(bent[1]).epsilon(1e-6));
    CHECK(bent[3] == doctest::Approx(8 * unit).epsilon(0.03));
}

TEST_CASE("a free body has three rigid motions in the plane and six in space, and the modes of a free beam") {
    Solver<2> plane(box_mesh({0, 0}, {1, 0.05}, 40, 2), elastic<2>(1e9, 0, 1000));
    const auto flat = frequencies(plane.natural_modes(5, serial_loop));
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(flat[k]) < 1e-3 * flat[3]);
    const double bending = 22.373 / (2 * M_PI) * std::sqrt(1e9 * 0.05 * 0.05 / 12 / 1000);  // free-free, Bernoulli
    CHECK(flat[3] == doctest::Approx(bending).epsilon(0.02));
    Solver<3> space(box_mesh({0, 0, 0}, {1, 0.4, 0.3}, {4, 2, 2}), elastic<3>(1e9, 0.3, 1000));
    const auto solid = space.natural_modes(8, serial_loop);
    for (std::size_t k = 0; k < 6; ++k) CHECK(std::abs(solid[k].frequency) < 1e-3 * solid[6].frequency);
    CHECK(solid[6].frequency > 100);
    std::array<double, 3> rigid{};  // together they move the whole mass
    for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t d = 0; d < 3; ++d) rigid[d] += solid[k].mass_fraction[d];
    for (const double share : rigid) CHECK(share == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("about a static state: a stretched strip swings as a string, a compressed one softens and then buckles") {
    // With a tension N a slender beam on hinges has ω_n² = (nπ/L)² (N + (nπ/L)² E I) / (ρ A).
    constexpr double L = 1, h = 0.01, E = 1e7, density = 1000;
    Mesh<2> mesh = box_mesh({0, 0}, {L, h}, 40, 1);
    for (const char* side : {"left", "right"}) {
        auto& set = mesh.node_sets[side];
        std::erase_if(set, [&](NodeIndex n) { return std::abs(mesh.nodes[std::size_t(n)][1] - h / 2) > 1e-9; });
    }
    Options<2> options = elastic<2>(E, 0, density);
    options.clamps = {{"left", {true, true}}, {"right", {false, true}}};
    const double EI = E * h * h * h / 12, k = M_PI / L, critical = k * k * EI;
    for (const double N : {0.0, 20 * critical, -0.9 * critical}) {
        CAPTURE(N);
        Solver<2> solver(mesh, options);
        std::vector<double> forces = no_load(mesh);
        for (const NodeIndex n : mesh.node_set("right")) forces[2 * std::size_t(n)] = N;
        solver.solve_static(forces, serial_loop);
        const double length = L * (1 + N / (E * h));  // as stretched; the mass per length falls with it
        const auto modes = solver.natural_modes(2, serial_loop);
        for (int n = 1; n <= 2; ++n) {
            const double q = n * M_PI / length;
            const double expected = q * std::sqrt((N + q * q * EI) * length / L / (density * h)) / (2 * M_PI);
            CHECK(modes[std::size_t(n - 1)].frequency == doctest::Approx(expected).epsilon(N < 0 ? 0.03 : 0.01));
        }
    }
}

TEST_CASE("an unstable state says so by a negative eigenvalue") {
    // Two springs against each other: K has a negative eigenvalue.
    const std::vector<int> starts{0, 2, 4, 5}, rows{0, 1, 1, 2, 2};
    const std::vector<double> K{-1, 0, 3, 0, 5}, M{1, 0, 1, 0, 1};
    const auto modes = lowest_eigenmodes(starts, rows, K, M, 2);
    CHECK(modes[0].eigenvalue == doctest::Approx(-1).epsilon(1e-8));
    CHECK(modes[1].eigenvalue == doctest::Approx(3).epsilon(1e-8));
}
