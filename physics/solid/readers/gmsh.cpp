#include "physics/solid/readers/gmsh.hpp"

#include <cmath>
#include <set>

#include "physics/solid/readers/gmsh_sections.hpp"

namespace aquagraph::solid {

namespace gmsh {

namespace {

// Gmsh goes round the edges of a hexahedron 01 03 04 12 15 23 26 37 45 47 56 67, of a tetrahedron 01 12 02 03 23 13.
const std::vector<int> hexahedron_20{0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
const std::vector<int> tetrahedron_10{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

}  // namespace

ElementType element_type(int D, int type, int tag, const GmshLines& lines) {
    static const std::map<int, ElementType> known{{15, {0, 1}},
                                                  {1, {1, 2}},
                                                  {8, {1, 3}},
                                                  {2, {2, 3}},
                                                  {9, {2, 6}},
                                                  {3, {2, 4}},
                                                  {16, {2, 8}},
                                                  {4, {3, 4}},
                                                  {11, {3, 10, &tetrahedron_10}},
                                                  {5, {3, 8}},
                                                  {17, {3, 20, &hexahedron_20}}};
    const std::string who = "element " + std::to_string(tag) + " ";
    if (D == 2 && (type == 2 || type == 9))
        lines.fail(who +
                   "is a triangle, quadrilaterals are needed: mesh with Mesh.RecombineAll=1 and, where triangles "
                   "remain, Mesh.SubdivisionAlgorithm=1");
    if (const auto found = known.find(type); found != known.end()) {
        if (found->second.dimension > D)
            lines.fail(who +
                       "fills a volume, and the scene is two-dimensional: put the surface alone in a physical "
                       "group");
        return found->second;
    }
    if (type == 10 || type == 12)
        lines.fail(who +
                   (type == 10 ? "is a 9-node quadrilateral, 8 nodes are needed"
                               : "is a 27-node hexahedron, 20 nodes are needed") +
                   ": mesh with Mesh.SecondOrderIncomplete=1");
    if (type == 6 || type == 7 || type == 13 || type == 14 || type == 18 || type == 19)
        lines.fail(who +
                   "is a prism or pyramid, hexahedra or tetrahedra alone are needed: extrude recombined surfaces, "
                   "or mesh the whole volume with tetrahedra");
    lines.fail(
        who + "has the unknown type " + std::to_string(type) +
        "; lines (1, 8), triangles (2, 9), quadrilaterals of 4 or 8 nodes (3, 16), tetrahedra of 4 or 10 (4, 11) "
        "and hexahedra of 8 or 20 (5, 17) can be read");
}

const std::string& name_of(const Contents& contents, int dimension, int group, const GmshLines& lines) {
    const auto name = contents.names.find({dimension, std::abs(group)});
    if (name == contents.names.end())
        lines.fail("physical group " + std::to_string(group) + " of dimension " + std::to_string(dimension) +
                   " has no name in $PhysicalNames; give it one");
    return name->second;
}

void add_node(Contents& contents, int tag, const std::array<double, 3>& x, bool may_be_unused, const GmshLines& lines) {
    RawMesh& mesh = contents.mesh;
    for (const double c : x)
        if (!std::isfinite(c)) lines.fail("node " + std::to_string(tag) + " has no finite coordinates");
    if (!mesh.index.emplace(tag, NodeIndex(mesh.nodes.size())).second)
        lines.fail("node " + std::to_string(tag) + " is there twice");
    mesh.nodes.push_back(x);
    mesh.node_tags.push_back(tag);
    mesh.may_be_unused.push_back(may_be_unused);
}

void add_element(Contents& contents, const ElementType& type, int tag, std::istringstream& rest,
                 std::vector<std::string> groups, const GmshLines& lines) {
    std::array<NodeIndex, 20> read{};
    for (std::size_t a = 0; a < type.nodes; ++a) {
        int node = 0;
        if (!(rest >> node)) lines.fail("element " + std::to_string(tag) + " lacks nodes");
        const auto found = contents.mesh.index.find(node);
        if (found == contents.mesh.index.end())
            lines.fail("element " + std::to_string(tag) + " has node " + std::to_string(node) +
                       ", which the file does not define");
        read[a] = found->second;
    }
    RawElement& element = contents.mesh.elements.emplace_back();
    element.tag = tag;
    element.dimension = type.dimension;
    element.groups = std::move(groups);
    for (std::size_t a = 0; a < type.nodes; ++a)
        element.nodes.push_back(read[type.order ? std::size_t((*type.order)[a]) : a]);
}

namespace {

// 4 or 2.
int read_format(GmshLines& lines) {
    double version = 0;
    int binary = 0, size = 0;
    lines.read("the version", version, binary, size);
    const bool four = std::abs(version - 4.1) < 1e-9, two = std::abs(version - 2.2) < 1e-9;
    if (!four && !two)
        lines.fail("this is version " + std::to_string(version) +
                   ", 4.1 or 2.2 is needed: save with Mesh.MshFileVersion=4.1");
    if (binary != 0) lines.fail("this file is binary, ASCII is needed: save with Mesh.Binary=0");
    lines.end("MeshFormat");
    return four ? 4 : 2;
}

void read_names(GmshLines& lines, Contents& contents) {
    int count = 0;
    lines.read("the number of physical names", count);
    for (int k = 0; k < count; ++k) {
        int dimension = 0, tag = 0;
        std::istringstream line = lines.read("a physical name", dimension, tag);
        std::string rest;
        std::getline(line, rest);
        const auto open = rest.find('"'), close = rest.rfind('"');
        if (open == std::string::npos || close <= open) lines.fail("the physical name is not in quotes");
        contents.names[{dimension, tag}] = rest.substr(open + 1, close - open - 1);
    }
    lines.end("PhysicalNames");
}

}  // namespace

}  // namespace gmsh

template <int D>
Mesh<D> read_gmsh(std::istream& input, const std::string& source, MeshOrder order) {
    using namespace gmsh;
    GmshLines lines(input, source);
    Contents contents;
    std::set<std::string> seen;
    std::string line;
    int version = 4;
    while (lines.next(line)) {
        if (line.front() != '$') lines.fail("a section ($Name) is expected here");
        const std::string section = line.substr(1, line.find_last_not_of(" \t"));
        if (section != "MeshFormat" && !seen.contains("MeshFormat"))
            lines.fail("$MeshFormat must come first: this is not a Gmsh file");
        if (section == "MeshFormat") {
            version = read_format(lines);
        } else if (section == "PhysicalNames") {
            read_names(lines, contents);
        } else if (section == "Entities" && version == 4) {
            read_entities_4(lines, contents);
        } else if (section == "Nodes") {
            version == 4 ? read_nodes_4(lines, contents) : read_nodes_2(lines, contents);
        } else if (section == "Elements") {
            if (!seen.contains("Nodes")) lines.fail("$Elements comes before $Nodes");
            version == 4 ? read_elements_4(D, lines, contents) : read_elements_2(D, lines, contents);
        } else {  // of no use here
            std::string skipped;
            do {
                if (!lines.next(skipped)) lines.fail("the file ends inside $" + section + ": it is truncated");
            } while (skipped.rfind("$End" + section, 0) != 0);
        }
        seen.insert(section);
    }
    for (const char* section : {"MeshFormat", "PhysicalNames", "Entities", "Nodes", "Elements"})
        if (!seen.contains(section) && (version == 4 || section != std::string("Entities")))
            lines.fail(std::string("the file has no $") + section +
                       (section == std::string("PhysicalNames")
                            ? ": it has no physical group; name the clamped and wet " +
                                  std::string(D == 2 ? "curves as physical curves" : "surfaces as physical surfaces")
                            : ": it is truncated or not a mesh"));
    return make_mesh<D>(std::move(contents.mesh), order, source);
}

template Mesh<2> read_gmsh(std::istream&, const std::string&, MeshOrder);
template Mesh<3> read_gmsh(std::istream&, const std::string&, MeshOrder);

}  // namespace aquagraph::solid
