// Gmsh files: two elements side by side in the formats that are read, and one test for each thing that is refused.
#include "physics/solid/readers/gmsh.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "tests/solid/fixtures.hpp"
#include "tests/text.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using aquagraph::test::with;

namespace {

const std::string head = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "clamp"
1 2 "wet"
2 3 "body of rubber"
$EndPhysicalNames
$Entities
1 3 1 0
1 0 0 0 0
1 0 0 0 0 1 0 1 1 0
2 0 0 0 2 0 0 1 2 0
3 1 0 0 1 1 0 0 0
1 0 0 0 2 1 0 1 3 3 1 2 3
$EndEntities
)";

// [0, 2] × [0, 1] in two 4-node quadrilaterals; the wet line runs against the boundary's direction; node 7 is a
// geometry point that no element uses.
const std::string linear = head + R"($Nodes
2 7 1 7
0 1 0 1
7
0.5 0.5 0
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
4 6 1 6
1 1 1 1
1 4 1
1 2 1 2
2 3 2
3 2 1
1 3 1 1
4 2 5
2 1 3 2
5 1 2 5 4
6 2 3 6 5
$EndElements
)";

const std::string quadratic = head + R"($Nodes
1 13 1 13
2 1 0 13
1
2
3
4
5
6
7
8
9
10
11
12
13
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
0.5 -0.1 0
1.5 0 0
2 0.5 0
1.5 1 0
0.5 1 0
0 0.5 0
1 0.5 0
$EndNodes
$Elements
3 5 1 5
1 1 8 1
1 4 1 12
1 2 8 2
2 1 2 7
3 2 3 8
2 1 16 2
5 1 2 5 4 7 13 11 12
6 2 3 6 5 8 9 10 13
$EndElements
)";

Mesh<2> read(const std::string& text) {
    std::istringstream input(text);
    return read_gmsh<2>(input, "plate.msh");
}

void refused(const std::string& text, const std::string& part) {
    std::string message;
    try {
        read(text);
    } catch (const MeshError& error) {
        message = error.what();
    }
    CHECK_MESSAGE(message.find(part) != std::string::npos, "message: ", message);
    CHECK(message.find("plate.msh") == 0);
}

}  // namespace

TEST_CASE("4-node quadrilaterals become 8-node ones with shared straight sides") {
    const Mesh<2> mesh = read(linear);
    CHECK(mesh.elements.size() == 2);
    CHECK(mesh.nodes.size() == 13);
    CHECK(mesh.elements[0][5] == mesh.elements[1][7]);  // the side between them
    CHECK(mesh.node_set("clamp").size() == 3);
    CHECK(mesh.node_set("wet").size() == 5);
    CHECK(mesh.node_set("body of rubber").size() == 13);
    const auto& wet = mesh.surface("wet");
    REQUIRE(wet.size() == 2);
    CHECK(mesh.nodes[static_cast<std::size_t>(wet[0][0])] == std::array<double, 2>{0, 0});
    CHECK(mesh.nodes[static_cast<std::size_t>(wet[0][2])] == std::array<double, 2>{0.5, 0});
    CHECK(mesh.nodes[static_cast<std::size_t>(wet[1][1])] == std::array<double, 2>{2, 0});
    CHECK(mesh.surface("clamp").size() == 1);
    CHECK_THROWS_AS(mesh.surface("body of rubber"), std::invalid_argument);
}

TEST_CASE("4-node quadrilaterals stay so where linear elements are asked for") {
    std::istringstream input(linear);
    const Mesh<2> mesh = read_gmsh<2>(input, "plate.msh", MeshOrder::linear);
    CHECK(mesh.nodes.size() == 6);
    CHECK(mesh.elements[0].size() == 4);
    CHECK(mesh.surface("wet").size() == 2);
    CHECK(mesh.element_set("body of rubber") == std::vector<ElementIndex>{0, 1});
    std::istringstream curved(quadratic);
    CHECK_THROWS_WITH_AS(read_gmsh<2>(curved, "plate.msh", MeshOrder::linear),
                         doctest::Contains("leave `order = 1` out"), MeshError);
}

TEST_CASE("8-node quadrilaterals keep their curved sides") {
    const Mesh<2> mesh = read(quadratic);
    CHECK(mesh.nodes.size() == 13);
    const auto& wet = mesh.surface("wet");
    REQUIRE(wet.size() == 2);
    CHECK(mesh.nodes[static_cast<std::size_t>(wet[0][2])] == std::array<double, 2>{0.5, -0.1});
}

TEST_CASE("a mesh from a file is solved as the same mesh made here") {
    Options<2> options;
    options.material.youngs_modulus = 1e6;
    options.material.poissons_ratio = 0.3;
    options.material.density = 1000;
    options.clamps = {{"clamp", {true, true}}};
    Solver<2> from_file(read(linear), options);
    options.clamps = {{"left", {true, true}}};
    Solver<2> made(box_mesh({0, 0}, {2, 1}, 2, 1), options);
    from_file.solve_static(solid::test::traction(from_file.mesh(), "wet", {0, 1e4}), serial_loop);
    made.solve_static(solid::test::traction(made.mesh(), "bottom", {0, 1e4}), serial_loop);
    const double a = from_file.displacements()[2 * solid::test::nearest_node(from_file.mesh(), 2, 1) + 1];
    const double b = made.displacements()[2 * solid::test::nearest_node(made.mesh(), 2, 1) + 1];
    CHECK(a > 0.01);
    CHECK(a == doctest::Approx(b).epsilon(1e-12));
}

TEST_CASE("what cannot be read is refused: version, binary, not a mesh") {
    refused(with(linear, "4.1 0 8", "3.0 0 8"), "line 2: this is version 3.0");
    refused(with(linear, "4.1 0 8", "4.1 1 8"), "Mesh.Binary=0");
    refused("hello\n", "line 1: a section");
    refused("$Nodes\n", "$MeshFormat must come first");
    refused("", "no $MeshFormat");
}

TEST_CASE("a truncated file is refused wherever it ends") {
    for (const std::size_t length : {linear.size() - 14, linear.size() - 30, linear.size() / 2, head.size() / 2})
        refused(linear.substr(0, length), "line");
    refused(linear.substr(0, linear.find("$Elements")), "no $Elements");
    refused(linear.substr(0, linear.find("6 2 3 6 5")),
            "the file ends where an element should follow: it is truncated");
}

TEST_CASE("elements that cannot be used are refused, with the remedy") {
    refused(with(quadratic, "2 1 16 2", "2 1 10 2"), "Mesh.SecondOrderIncomplete=1");
    refused(with(linear, "2 1 3 2\n", "2 1 2 2\n"), "Mesh.RecombineAll=1");
    refused(with(linear, "2 1 3 2\n", "2 1 36 2\n"), "element 5 has the unknown type 36");
    refused(with(linear, "5 1 2 5 4", "5 1 4 5 2"), "element 5 is numbered clockwise");
    refused(with(linear, "5 1 2 5 4", "5 2 1 5 4"), "element 5 is inverted");
    refused(with(linear, "5 1 2 5 4", "5 1 2 5 44"), "has node 44, which the file does not define");
    refused(with(linear, "5 1 2 5 4", "5 1 2 5"), "element 5 lacks nodes");
    refused(with(linear, "1 4 1\n", "1 4 2\n"), "line element 1 of 'clamp' is not an edge");
}

TEST_CASE("missing and unused things are refused") {
    const auto names = linear.find("$PhysicalNames"), entities = linear.find("$Entities");
    refused(with(linear, "1 2 \"wet\"\n", "1 7 \"wet\"\n"), "physical group 2 of dimension 1 has no name");
    refused(linear.substr(0, names) + linear.substr(entities), "has no name in $PhysicalNames");
    refused(with(linear, "0 1 0 1\n7\n", "2 1 0 1\n7\n"), "node 7 is dangling");
    refused(with(linear, "2 1 0\n$EndNodes", "2 1 0.5\n$EndNodes"), "lies off the plane");
    refused(with(linear, "2 7 1 7", "2 8 1 8"), "8 are announced");
}

TEST_CASE("without any physical group the file is refused with the remedy") {
    std::string text = linear;
    text = with(text, "$PhysicalNames\n3\n1 1 \"clamp\"\n1 2 \"wet\"\n2 3 \"body of rubber\"\n$EndPhysicalNames\n", "");
    text = with(text, "1 0 0 0 0 1 0 1 1 0\n2 0 0 0 2 0 0 1 2 0", "1 0 0 0 0 1 0 0 0\n2 0 0 0 2 0 0 0 0");
    text = with(text, "1 0 0 0 2 1 0 1 3 3 1 2 3", "1 0 0 0 2 1 0 0 3 1 2 3");
    refused(text, "it has no physical group; name the clamped and wet curves");
}
