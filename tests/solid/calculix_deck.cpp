// Input decks of Abaqus and CalculiX: what is read, and one test for each thing that is refused.
#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "physics/solid/readers/calculix.hpp"
#include "tests/solid/fixtures.hpp"
#include "tests/text.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using aquagraph::test::with;

namespace {

// [0, 2] × [0, 1] in two quadrilaterals of four nodes.
const std::string plane = R"(*HEADING
A plate
** a comment
*Node, nset=Nall
1, 0., 0.
2, 1., 0., 0.
3, 2., 0.
11, 0., 1.
12, 1., 1.
13, 2., 1e0
*ELEMENT, TYPE=CPE4, ELSET=Body
 5, 1, 2, 12, 11
 6, 2, 3, 13, 12
*NSET, NSET=Clamp
1, 11,
*NSET, NSET=Floor, GENERATE
1, 3, 1
*NSET, NSET=Both
CLAMP, floor
*ELSET, ELSET=Tip
6
*SURFACE, NAME=Wet, TYPE=ELEMENT
Body, S1
6, S2
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e11, 0.3
*SOLID SECTION, ELSET=Body, MATERIAL=STEEL
*STEP
*STATIC
*BOUNDARY
Clamp, 1, 2
*END STEP
)";

// One hexahedron of twenty nodes, its line broken, and a skin as mesh generators write it.
const std::string space = R"(*NODE, NSET=ALL
1, 0, 0, 0
2, 2, 0, 0
3, 2, 1, 0
4, 0, 1, 0
5, 0, 0, 0.5
6, 2, 0, 0.5
7, 2, 1, 0.5
8, 0, 1, 0.5
9, 1, 0, 0
10, 2, 0.5, 0
11, 1, 1, 0
12, 0, 0.5, 0
13, 1, 0, 0.5
14, 2, 0.5, 0.5
15, 1, 1, 0.5
16, 0, 0.5, 0.5
17, 0, 0, 0.25
18, 2, 0, 0.25
19, 2, 1, 0.25
20, 0, 1, 0.25
*ELEMENT, TYPE=CPS8, ELSET=Skin
7, 2, 3, 7, 6, 10, 19, 14, 18
*ELEMENT, TYPE=C3D20R, ELSET=Body
1, 1, 2, 3, 4, 5, 6, 7, 8, 9,
10, 11, 12, 13, 14, 15, 16,
17, 18, 19, 20
*SURFACE, NAME=Sides
Body, S3
Body, S4
Body, S5
Body, S6
)";

template <int D>
Mesh<D> read(const std::string& text) {
    std::istringstream input(text);
    return read_calculix<D>(input, "plate.inp");
}

template <int D = 2>
void refused(const std::string& text, const std::string& part) {
    CAPTURE(part);
    CHECK_THROWS_WITH_AS(read<D>(text), doctest::Contains(part.c_str()), MeshError);
}

}  // namespace

TEST_CASE("a plane deck: nodes, elements, sets by list, name and GENERATE, surfaces") {
    const Mesh<2> mesh = read<2>(plane);
    CHECK(mesh.nodes.size() == 6);
    CHECK(mesh.elements.size() == 2);
    CHECK(mesh.elements[0].size() == 4);
    CHECK(mesh.node_set("Nall").size() == 6);
    CHECK(mesh.node_set("Clamp") == std::vector<NodeIndex>{0, 3});
    CHECK(mesh.node_set("Floor") == std::vector<NodeIndex>{0, 1, 2});
    CHECK(mesh.node_set("Both") == std::vector<NodeIndex>{0, 1, 2, 3});
    CHECK(mesh.element_set("Body") == std::vector<ElementIndex>{0, 1});
    CHECK(mesh.element_set("Tip") == std::vector<ElementIndex>{1});
    CHECK(mesh.surface("Wet") == std::vector<Facet>{{0, 1}, {1, 2}, {2, 5}});
    CHECK(mesh.node_set("Wet") == std::vector<NodeIndex>{0, 1, 2, 5});
}

TEST_CASE("a deck in space: quadratic hexahedra over several lines, sides by number and by a skin of elements") {
    const Mesh<3> mesh = read<3>(space);
    REQUIRE(mesh.elements.size() == 1);
    CHECK(mesh.elements[0].size() == 20);
    CHECK(mesh.surface("Sides").size() == 4);
    REQUIRE(mesh.surface("Skin").size() == 1);
    for (const NodeIndex n : mesh.surface("Skin")[0]) CHECK(mesh.nodes[std::size_t(n)][0] == 2);
    CHECK(mesh.node_set("Skin").size() == 8);
    // S3 … S6 are y = 0, x = 2, y = 1, x = 0
    const std::array<std::array<double, 2>, 4> planes{{{1, 0}, {0, 2}, {1, 1}, {0, 0}}};
    for (std::size_t s = 0; s < 4; ++s)
        for (const NodeIndex n : mesh.surface("Sides")[s])
            CHECK(mesh.nodes[std::size_t(n)][std::size_t(planes[s][0])] == planes[s][1]);
}

TEST_CASE("a mesh of a deck is solved as the same box made here") {
    Options<2> options;
    options.material.youngs_modulus = 1e6;
    options.material.poissons_ratio = 0.3;
    options.material.density = 1000;
    options.gravity = {0, -9.81};
    options.clamps = {{"Clamp", {true, true}}};
    Solver<2> from_deck(read<2>(plane), options);
    options.clamps = {{"left", {true, true}}};
    Solver<2> made(without_mid_side_nodes(box_mesh({0, 0}, {2, 1}, 2, 1)), options);
    from_deck.solve_static(solid::test::no_load(from_deck.mesh()), serial_loop);
    made.solve_static(solid::test::no_load(made.mesh()), serial_loop);
    const double a = from_deck.displacements()[2 * solid::test::nearest_node(from_deck.mesh(), 2, 1) + 1],
                 b = made.displacements()[2 * solid::test::nearest_node(made.mesh(), 2, 1) + 1];
    CHECK(a < -1e-3);
    CHECK(a == doctest::Approx(b).epsilon(1e-10));
}

TEST_CASE("what a deck must not hold is refused with the line") {
    refused(with(plane, "** a comment", "*INCLUDE, INPUT=mesh.inp"), "line 3: *INCLUDE is not followed");
    refused(with(plane, "** a comment", "*EQUATION"), "line 3: *EQUATION is not known here");
    refused(with(plane, "** a comment", "*PART, NAME=A"), "write a flat deck");
    refused(with(plane, "CPE4", "CAX4"), "elements of type CAX4 cannot be used in 2 dimensions");
    refused<3>(with(space, "C3D20R", "C3D15"), "elements of type C3D15 cannot be used in 3 dimensions");
    refused<2>(space, "cannot be used in 2 dimensions");
    refused(with(plane, "6, 2, 3, 13, 12", "6, 2, 3, 13"), "line 13: element 6 has 3 nodes, CPE4 takes 4");
    refused(with(plane, "6, 2, 3, 13, 12", "6, 2, 3, 14, 12"), "line 13: element 6 has node 14");
    refused(with(plane, "6, 2, 3, 13, 12", "5, 2, 3, 13, 12"), "line 13: element 5 is there twice");
    refused(with(plane, "6, 2, 3, 13, 12", "6, 2, 12, 13, 3"), "element 6 is numbered clockwise");
    refused(with(plane, "13, 2., 1e0", "12, 2., 1e0"), "line 10: node 12 is there twice");
    refused(with(plane, "13, 2., 1e0", "13, 2., one"), "line 10: a number is needed in *NODE, found \"one\"");
    refused(with(plane, "13, 2., 1e0", "13, 2., 1., 0.5"), "node 13 lies off the plane");
    refused(with(plane, "13, 2., 1e0", "13, 2., 1.\n99, 3, 3"), "node 99 is dangling");
    refused(with(plane, "CLAMP, floor", "CLAMP, flor"), "there is no node set 'flor' before this line");
    refused(with(plane, "1, 11,", "1, 44"), "set 'Clamp' has node 44");
    refused(with(plane, "1, 3, 1", "3, 1"), "GENERATE runs backwards");
    refused(with(plane, "6, S2", "6, S5"), "element 6 has no side S5");
    refused(with(plane, "6, S2", "6, S4"), "surface 'Wet'");  // inside
    refused(with(plane, "Body, S1", "Bdy, S1"), "there is no element set 'Bdy'");
    refused(plane.substr(0, plane.find("*ELEMENT")), "no elements");
    refused(with(plane, ", TYPE=CPE4", ""), "*ELEMENT has no TYPE=");
}
