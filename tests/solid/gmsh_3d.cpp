// Gmsh files in space: its own order of nodes, both formats, and Gmsh itself where it is installed.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "physics/solid/elements/dispatch.hpp"
#include "physics/solid/readers/gmsh.hpp"
#include "tests/solid/fixtures.hpp"
#include "tests/text.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using aquagraph::test::with;

namespace {

// A hexahedron of 20 nodes, 2 × 1 × 0.5, as Gmsh 4.11 writes it in format 2.2.
const std::string hexahedron = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 4 "edge"
2 2 "floor"
2 3 "end"
3 1 "body"
$EndPhysicalNames
$Nodes
20
1 0 0 0
2 2 0 0
3 2 1 0
4 0 1 0
5 0 0 0.5
6 2 0 0.5
7 2 1 0.5
8 0 1 0.5
9 1 0 0
10 2 0.5 0
11 1 1 0
12 0 0.5 0
13 1 0 0.5
14 2 0.5 0.5
15 1 1 0.5
16 0 0.5 0.5
17 0 0 0.25
18 2 0 0.25
19 2 1 0.25
20 0 1 0.25
$EndNodes
$Elements
4
1 8 2 4 4 4 1 12
2 16 2 2 1 1 2 3 4 9 10 11 12
3 16 2 3 17 2 3 7 6 10 19 14 18
4 17 2 1 1 1 2 3 4 5 6 7 8 9 12 17 10 18 11 19 20 13 16 14 15
$EndElements
)";

Mesh<3> read(const std::string& text, MeshOrder order = MeshOrder::quadratic) {
    std::istringstream input(text);
    return read_gmsh<3>(input, "body.msh", order);
}

void refused(const std::string& text, const std::string& part) {
    CAPTURE(part);
    CHECK_THROWS_WITH_AS(read(text), doctest::Contains(part.c_str()), MeshError);
}

template <int D>
double size(const Mesh<D>& mesh) {
    double sum = 0;
    for (const Element& element : mesh.elements)
        with_element_type<D>(element.size(), [&]<class Type>(Type) {
            for (const auto& point : Type::mass_rule())
                sum += point.weight *
                       reference_gradients(Type::shape(point.xi), coordinates<Type>(mesh, element)).jacobian;
        });
    return sum;
}

double area(const Mesh<3>& mesh, const std::string& surface) {
    double sum = 0;
    for (const Facet& facet : mesh.surface(surface)) {  // plane facets, by their corners
        std::array<double, 3> twice{};
        const std::size_t n = corner_count<3>(facet);
        for (std::size_t k = 0; k < n; ++k) {
            const auto &a = mesh.nodes[std::size_t(facet[k])], &b = mesh.nodes[std::size_t(facet[(k + 1) % n])];
            for (std::size_t i = 0; i < 3; ++i)
                twice[i] += a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        }
        sum += 0.5 * std::hypot(twice[0], twice[1], twice[2]);
    }
    return sum;
}

// Every node on an edge lies in the middle of it: what a wrong order of nodes would break.
void check_middles(const Mesh<3>& mesh) {
    for (const Element& element : mesh.elements)
        for (const Facet& side : sides<3>(element)) {
            const std::size_t n = corner_count<3>(side);
            REQUIRE(side.size() == 2 * n);
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t i = 0; i < 3; ++i) {
                    const auto x = [&](std::size_t local) { return mesh.nodes[std::size_t(side[local])][i]; };
                    CHECK(x(n + k) == doctest::Approx(0.5 * (x(k) + x((k + 1) % n))).epsilon(1e-9));
                }
        }
}

}  // namespace

TEST_CASE("a hexahedron of twenty nodes in Gmsh's order") {
    const Mesh<3> mesh = read(hexahedron);
    REQUIRE(mesh.elements.size() == 1);
    check_middles(mesh);
    CHECK(size(mesh) == doctest::Approx(1).epsilon(1e-12));
    CHECK(mesh.node_set("body").size() == 20);
    CHECK(mesh.element_set("body").size() == 1);
    CHECK(area(mesh, "floor") == doctest::Approx(2));
    CHECK(area(mesh, "end") == doctest::Approx(0.5));
    CHECK(mesh.node_set("edge").size() == 3);
    CHECK_FALSE(mesh.surfaces.contains("edge"));
    CHECK_FALSE(mesh.surfaces.contains("body"));
}

TEST_CASE("a hexahedron of eight nodes gets nodes on its edges, or stays as it is") {
    std::string text =
        with(hexahedron, "17 2 1 1 1 2 3 4 5 6 7 8 9 12 17 10 18 11 19 20 13 16 14 15", "5 2 1 1 1 2 3 4 5 6 7 8");
    text = with(with(text, "3 16 2 3 17 2 3 7 6 10 19 14 18", "3 3 2 3 17 2 3 7 6"), "2 16 2 2 1 1 2 3 4 9 10 11 12",
                "2 3 2 2 1 1 2 3 4");
    text = with(text, "1 8 2 4 4 4 1 12", "1 1 2 4 4 4 1");
    text = with(text, text.substr(text.find("9 1 0 0"), text.find("$EndNodes") - text.find("9 1 0 0")), "");
    text = with(text, "$Nodes\n20", "$Nodes\n8");
    const Mesh<3> quadratic = read(text);
    CHECK(quadratic.nodes.size() == 20);
    check_middles(quadratic);
    CHECK(quadratic.node_set("end").size() == 8);
    CHECK(quadratic.surface("end")[0].size() == 8);
    const Mesh<3> linear = read(text, MeshOrder::linear);
    CHECK(linear.nodes.size() == 8);
    CHECK(linear.node_set("end").size() == 4);
    CHECK(size(linear) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a tetrahedron of ten nodes in Gmsh's order") {
    const std::string text = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "floor"
3 2 "body"
$EndPhysicalNames
$Nodes
10
1 0 0 0
2 2 0 0
3 0 3 0
4 0 0 1
5 1 0 0
6 1 1.5 0
7 0 1.5 0
8 0 0 0.5
9 0 1.5 0.5
10 1 0 0.5
$EndNodes
$Elements
2
1 9 2 1 1 1 2 3 5 6 7
2 11 2 2 1 1 2 3 4 5 6 7 8 9 10
$EndElements
)";
    const Mesh<3> mesh = read(text);
    check_middles(mesh);
    CHECK(size(mesh) == doctest::Approx(1).epsilon(1e-12));
    CHECK(area(mesh, "floor") == doctest::Approx(3));
    const std::string corners = with(
        with(with(text, "11 2 2 1 1 2 3 4 5 6 7 8 9 10", "4 2 2 1 1 2 3 4"), "9 2 1 1 1 2 3 5 6 7", "2 2 1 1 1 2 3"),
        text.substr(text.find("5 1 0 0"), text.find("$EndNodes") - text.find("5 1 0 0")), "");
    const Mesh<3> made = read(with(corners, "$Nodes\n10", "$Nodes\n4"));
    check_middles(made);
    CHECK(made.node_set("floor").size() == 6);
}

TEST_CASE("an element of two groups stands twice in format 2.2, and is one element") {
    std::string text = with(hexahedron, "3 1 \"body\"", "3 1 \"body\"\n3 9 \"rubber\"");
    text = with(with(text, "$PhysicalNames\n4", "$PhysicalNames\n5"), "$Elements\n4", "$Elements\n5");
    const std::string element = "4 17 2 1 1 1 2 3 4 5 6 7 8 9 12 17 10 18 11 19 20 13 16 14 15\n";
    const Mesh<3> mesh = read(with(text, element, element + with(element, "4 17 2 1", "5 17 2 9")));
    CHECK(mesh.elements.size() == 1);
    CHECK(mesh.element_set("rubber") == mesh.element_set("body"));
}

TEST_CASE("what cannot be used in space is refused, with the element and the remedy") {
    refused(with(hexahedron, "4 17 2", "4 12 2"), "element 4 is a 27-node hexahedron, 20 nodes are needed");
    refused(with(hexahedron, "4 17 2", "4 6 2"), "element 4 is a prism or pyramid");
    refused(with(hexahedron, "4 17 2", "4 99 2"), "element 4 has the unknown type 99");
    refused(with(hexahedron, "1 2 3 4 5 6 7 8 9 12", "5 6 7 8 1 2 3 4 9 12"), "element 4 is ");
    refused(with(hexahedron, "1 2 3 4 5 6 7 8 9 12", "1 2 3 4 5 6 7 8 12 9"), "element 4 is inverted");
    refused(with(hexahedron, "2 3 7 6 10 19 14 18", "2 3 7 5 10 19 14 18"),
            "quadrilateral 3 of 'end' is not a side of an element");
    refused(with(hexahedron, "2 16 2 2 1", "2 16 2 7 1"), "line 37: physical group 7 of dimension 2 has no name");
    refused(with(hexahedron, "20\n1 0 0 0", "21\n77 5 5 5\n1 0 0 0"), "node 77 is dangling");
    refused(with(hexahedron, "20 0 1 0.25", "20 0 1 nan"), "line 32: cannot read a node");
    refused(hexahedron.substr(0, hexahedron.find("4 17 2 1")), "line 38: the file ends where an element should follow");
    std::istringstream input(hexahedron);
    CHECK_THROWS_WITH_AS(read_gmsh<2>(input, "body.msh"), doctest::Contains("the scene is two-dimensional"), MeshError);
}

TEST_CASE("what Gmsh itself writes, in both formats") {
    if (std::system("command -v gmsh > /dev/null 2>&1") != 0) {
        MESSAGE("skipped: gmsh is not installed");
        return;
    }
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("aquagraph_gmsh_" + std::to_string(std::rand()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "box.geo") << R"(SetFactory("Built-in");
Mesh.SecondOrderIncomplete = 1;
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 4; Transfinite Curve {2, 4} = 3; Transfinite Surface {1}; Recombine Surface {1};
e[] = Extrude {0, 0, 0.5} { Surface{1}; Layers{2}; Recombine; };
Physical Volume("body") = {e[1]}; Physical Surface("floor") = {1}; Physical Surface("end") = {e[3]};
Physical Curve("edge") = {4}; Physical Point("corner") = {1};
)";
    std::ofstream(folder / "ball.geo") << R"(SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 0.5;
Physical Volume("ball") = {1}; Physical Surface("skin") = {1};
)";
    std::ofstream(folder / "plate.geo") << R"(SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 0.3; Mesh.RecombineAll = 1; Mesh.SubdivisionAlgorithm = 1;
Mesh.SecondOrderIncomplete = 1;
Physical Surface("plate") = {1}; Physical Curve("rim") = {1};
)";
    const auto meshed = [&](const std::string& geometry, int dimension, const std::string& format, int order) {
        const std::string base = (folder / geometry).string(), file = base + "_" + format + ".msh";
        const std::string command = "gmsh -" + std::to_string(dimension) + " -order " + std::to_string(order) +
                                    " -format " + format + " -o " + file + " " + base + ".geo > /dev/null 2>&1";
        REQUIRE(std::system(command.c_str()) == 0);
        return std::ifstream(file);
    };
    for (const char* format : {"msh41", "msh22"}) {
        CAPTURE(format);
        for (const int order : {1, 2}) {
            std::ifstream file = meshed("box", 3, format, order);
            const Mesh<3> box = read_gmsh<3>(file, "box.msh");
            CHECK(box.elements.size() == 12);
            check_middles(box);
            CHECK(size(box) == doctest::Approx(1).epsilon(1e-9));
            CHECK(area(box, "floor") == doctest::Approx(2).epsilon(1e-9));
            CHECK(area(box, "end") == doctest::Approx(0.5).epsilon(1e-9));
            CHECK(box.node_set("edge").size() == (order == 1 ? 3 : 5));
            CHECK(box.node_set("corner").size() == 1);
        }
        std::ifstream ball_file = meshed("ball", 3, format, 2), plate_file = meshed("plate", 2, format, 2);
        const Mesh<3> ball = read_gmsh<3>(ball_file, "ball.msh");
        CHECK(ball.elements[0].size() == 10);
        CHECK(size(ball) == doctest::Approx(4 * M_PI / 3).epsilon(0.005));
        CHECK(ball.surface("skin").size() == boundary_facets(ball).size());
        const Mesh<2> plate = read_gmsh<2>(plate_file, "plate.msh");
        CHECK(plate.elements[0].size() == 8);
        CHECK(size(plate) == doctest::Approx(M_PI).epsilon(1e-4));
        CHECK(plate.surface("rim").size() == boundary_facets(plate).size());
    }
    std::filesystem::remove_all(folder);
}
