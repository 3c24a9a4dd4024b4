// Nodal forces of tractions: resultant and moment are those of the surface, whatever its facets.
#include "physics/solid/dead_loads.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace aquagraph::solid;

namespace {

// Σ f_i, and Σ X_j f_i.
template <int D>
struct Resultant {
    std::array<double, D> force{};
    std::array<std::array<double, D>, D> moment{};
};

template <int D>
Resultant<D> resultant(const Mesh<D>& mesh, const std::vector<double>& forces) {
    Resultant<D> sum;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
        for (std::size_t i = 0; i < D; ++i) {
            sum.force[i] += forces[D * n + i];
            for (std::size_t j = 0; j < D; ++j) sum.moment[j][i] += mesh.nodes[n][j] * forces[D * n + i];
        }
    return sum;
}

}  // namespace

TEST_CASE("a traction on a plane side is its area, acting in its middle") {
    for (const bool quadratic : {true, false}) {
        CAPTURE(quadratic);
        const Mesh<2> full = box_mesh({1, 2}, {4, 6}, 2, 3);
        const Mesh<2> plane = quadratic ? full : without_mid_side_nodes(full);
        const auto edge = resultant(plane, traction_forces(plane, "right", {5, -2}, 0.1));
        CHECK(edge.force[0] == doctest::Approx(5 * 4 * 0.1).epsilon(1e-13));
        CHECK(edge.force[1] == doctest::Approx(-2 * 4 * 0.1).epsilon(1e-13));
        CHECK(edge.moment[1][0] == doctest::Approx(4 * 5 * 4 * 0.1).epsilon(1e-13));

        const Mesh<3> box = box_mesh({1, 2, 3}, {4, 6, 8}, {2, 1, 2});
        const Mesh<3> space = quadratic ? box : without_mid_side_nodes(box);
        const auto face = resultant(space, traction_forces(space, "top", {0, 1, -3}));
        CHECK(face.force[0] == 0);
        CHECK(face.force[2] == doctest::Approx(-3 * 12).epsilon(1e-13));
        CHECK(face.moment[0][2] == doctest::Approx(2.5 * -36).epsilon(1e-13));
        CHECK(face.moment[1][1] == doctest::Approx(4 * 12).epsilon(1e-13));
        CHECK(face.moment[2][1] == doctest::Approx(8 * 12).epsilon(1e-13));
    }
}

TEST_CASE("a traction on the round side of a quarter tube") {  // quadratic facets follow it to 1e-4 and better
    Mesh<3> mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {1, 6, 1});
    for (auto& X : mesh.nodes) {
        const double R = 2 + X[0], angle = X[1] * M_PI / 2;
        X = {R * std::cos(angle), R * std::sin(angle), X[2]};
    }
    const auto round = resultant(mesh, traction_forces(mesh, "right", {0, 0, 1}));
    CHECK(round.force[2] == doctest::Approx(3 * M_PI / 2).epsilon(2e-5));
    CHECK(round.moment[0][2] == doctest::Approx(9).epsilon(2e-5));  // ∫ R cos φ R dφ
}

TEST_CASE("a traction on the side of a tetrahedron: the middles of the edges bear a third each, the corners nothing") {
    Mesh<3> mesh;
    mesh.nodes = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}};
    const std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
    for (const auto& [p, q] : edges)
        mesh.nodes.push_back({0.5 * (mesh.nodes[p][0] + mesh.nodes[q][0]), 0.5 * (mesh.nodes[p][1] + mesh.nodes[q][1]),
                              0.5 * (mesh.nodes[p][2] + mesh.nodes[q][2])});
    mesh.elements.push_back({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    mesh.surfaces["floor"] = {sides<3>(mesh.elements[0])[0]};
    const std::vector<double> forces = traction_forces(mesh, "floor", {0, 0, 7});
    for (const std::size_t corner : {0u, 1u, 2u, 3u}) CHECK(std::abs(forces[3 * corner + 2]) < 1e-12);
    for (const std::size_t middle : {4u, 5u, 6u})
        CHECK(forces[3 * middle + 2] == doctest::Approx(7 * 3.0 / 3).epsilon(1e-12));
}

TEST_CASE("loads add up with their factors; one that is no number is refused") {
    std::vector<DeadLoad> loads{{{1, 2}, {}}, {{10, 20}, [](double t) { return t * t; }}};
    std::vector<double> sum(2, 99.0);
    sum_at(loads, 3, sum);
    CHECK(sum == std::vector<double>{91, 182});
    loads.push_back({{1, 1}, [](double t) { return 1 / (t - 2); }});
    CHECK_THROWS_WITH_AS(sum_at(loads, 2, sum), doctest::Contains("no finite number at t = 2"), std::domain_error);
}
