// The box mesh, what check() refuses, surfaces and sets.
#include "physics/solid/mesh.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "physics/solid/elements/dispatch.hpp"

using namespace aquagraph::solid;

namespace {

double area(const Mesh<2>& mesh) {
    double sum = 0;
    for (const Element& element : mesh.elements)
        for (const auto& point : Quad8::mass_rule())
            sum +=
                point.weight * reference_gradients(Quad8::shape(point.xi), coordinates<Quad8>(mesh, element)).jacobian;
    return sum;
}

void refused(const std::string& part, const std::function<void(Mesh<2>&)>& spoil) {
    Mesh<2> mesh = box_mesh({0, 0}, {2, 1}, 4, 3);
    spoil(mesh);
    std::string message;
    try {
        check(mesh);
    } catch (const MeshError& error) {
        message = error.what();
    }
    CHECK_MESSAGE(message.find(part) != std::string::npos, "message: ", message);
}

}  // namespace

TEST_CASE("a box mesh: numbers of nodes and elements, area, sets") {
    const Mesh<2> mesh = box_mesh({-1, 2}, {3, 5}, 4, 3);
    check(mesh);
    CHECK(mesh.elements.size() == 12);
    CHECK(mesh.nodes.size() == 9 * 7 - 12);
    CHECK(area(mesh) == doctest::Approx(12).epsilon(1e-14));
    CHECK(mesh.node_set("left").size() == 7);
    CHECK(mesh.node_set("top").size() == 9);
    CHECK(mesh.surface("right").size() == 3);
    CHECK(boundary_facets(mesh).size() == 14);
    for (const NodeIndex n : mesh.node_set("right")) CHECK(mesh.nodes[static_cast<std::size_t>(n)][0] == 3);
    for (const NodeIndex n : mesh.node_set("bottom")) CHECK(mesh.nodes[static_cast<std::size_t>(n)][1] == 2);
}

TEST_CASE("surfaces run counter-clockwise in a chain, mid-side node in the middle") {
    const Mesh<2> mesh = box_mesh({0, 0}, {2, 1}, 4, 3);
    double closed = 0;  // ½ ∮ x dy - y dx is the area if the solid is on the left
    for (const char* name : {"bottom", "right", "top", "left"}) {
        const auto& edges = mesh.surface(name);
        for (std::size_t k = 0; k < edges.size(); ++k) {
            const auto &A = mesh.nodes[static_cast<std::size_t>(edges[k][0])],
                       &B = mesh.nodes[static_cast<std::size_t>(edges[k][1])],
                       &C = mesh.nodes[static_cast<std::size_t>(edges[k][2])];
            closed += 0.5 * (A[0] * B[1] - A[1] * B[0]);
            CHECK(C[0] == doctest::Approx(0.5 * (A[0] + B[0])));
            CHECK(C[1] == doctest::Approx(0.5 * (A[1] + B[1])));
            if (k > 0) CHECK(edges[k][0] == edges[k - 1][1]);
        }
    }
    CHECK(closed == doctest::Approx(2).epsilon(1e-14));
}

TEST_CASE("an unknown set is refused with those there are") {
    const Mesh<2> mesh = box_mesh({0, 0}, {1, 1}, 1, 1);
    CHECK_THROWS_WITH_AS(mesh.surface("roof"), "the mesh has no surface 'roof'; it has: bottom, left, right, top",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(Mesh<2>{}.node_set("roof"), "the mesh has no node set 'roof'; it has: none",
                         std::invalid_argument);
    CHECK_THROWS_AS(box_mesh({0, 0}, {0, 1}, 1, 1), std::invalid_argument);
    CHECK_THROWS_AS(box_mesh({0, 0}, {1, 1}, 1, 0), std::invalid_argument);
}

TEST_CASE("what cannot be used is refused with the culprit") {
    refused("no element", [](Mesh<2>& mesh) { mesh.elements.clear(); });
    refused("element 5 is numbered clockwise", [](Mesh<2>& mesh) {
        auto& e = mesh.elements[5];
        e = {e[0], e[3], e[2], e[1], e[7], e[6], e[5], e[4]};
    });
    refused("element 5 is inverted", [](Mesh<2>& mesh) {
        auto& e = mesh.elements[5];
        std::swap(e[0], e[1]);
    });
    refused("element 0 is inverted", [](Mesh<2>& mesh) {  // the corner of the first element pulled across it
        mesh.nodes[static_cast<std::size_t>(mesh.elements[0][0])] = {0.6, 0.5};
    });
    refused("element 5 has a node twice", [](Mesh<2>& mesh) { mesh.elements[5][0] = mesh.elements[5][1]; });
    refused("element 5 has node 999", [](Mesh<2>& mesh) { mesh.elements[5][6] = 999; });
    refused("is dangling", [](Mesh<2>& mesh) { mesh.nodes.push_back({0, 0}); });
    refused("element 0", [](Mesh<2>& mesh) { mesh.nodes[0][0] = std::numeric_limits<double>::quiet_NaN(); });
    refused("surface 'top': the edge",
            [](Mesh<2>& mesh) { std::swap(mesh.surfaces["top"][0][0], mesh.surfaces["top"][0][1]); });
    refused("node set 'left' has node -3", [](Mesh<2>& mesh) { mesh.node_sets["left"][0] = -3; });
}

TEST_CASE("edges are put in a chain, branches refused") {
    const std::vector<Facet> shuffled{{3, 4, 13}, {1, 2, 11}, {7, 8, 17}, {2, 3, 12}};
    CHECK(chain(shuffled) == std::vector<Facet>{{1, 2, 11}, {2, 3, 12}, {3, 4, 13}, {7, 8, 17}});
    const std::vector<Facet> ring{{2, 3, 12}, {1, 2, 11}, {3, 1, 13}};
    CHECK(chain(ring) == std::vector<Facet>{{2, 3, 12}, {3, 1, 13}, {1, 2, 11}});
    CHECK_THROWS_AS(chain({{1, 2, 11}, {1, 3, 12}}), MeshError);
}
