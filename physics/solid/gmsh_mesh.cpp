#include "physics/solid/gmsh_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace aquagraph::solid {

namespace {

using EntityKey = std::pair<int, int>;  // dimension, tag

// Lines of the file with their number; every error message carries the number of the line read last.
class Lines {
  public:
    Lines(std::istream& input, std::string source) : input_(input), source_(std::move(source)) {}

    bool next(std::string& line) {
        while (std::getline(input_, line)) {
            ++number_;
            if (!line.empty() && line.back() == '\r') line.pop_back();
            if (line.find_first_not_of(" \t") != std::string::npos) return true;
        }
        return false;
    }
    std::istringstream need(const std::string& what) {
        std::string line;
        if (!next(line)) fail("the file ends where " + what + " should follow: it is truncated");
        if (line.front() == '$') fail("found " + line + " where " + what + " should follow");
        return std::istringstream(line);
    }
    template <class... Values>
    std::istringstream read(const std::string& what, Values&... values) {
        std::istringstream line = need(what);
        (line >> ... >> values);
        if (!line) fail("cannot read " + what);
        return line;
    }
    void end(const std::string& section) {
        std::string line;
        if (!next(line)) fail("the file ends inside $" + section + ": it is truncated");
        if (line.rfind("$End" + section, 0) != 0) fail("$End" + section + " is expected here, found: " + line);
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw MeshError(source_ + ", line " + std::to_string(number_) + ": " + message);
    }

  private:
    std::istream& input_;
    std::string source_;
    long number_ = 0;
};

struct Line {
    int tag = 0, entity = 0;
    NodeIndex first = 0, second = 0;
};

struct Contents {
    std::map<EntityKey, std::string> names;                // physical group -> name
    std::map<EntityKey, std::vector<std::string>> groups;  // entity -> names of its physical groups
    std::map<int, NodeIndex> index;                        // node tag -> index
    std::vector<int> node_tags;
    std::vector<bool> on_unnamed_point;  // of node
    std::vector<std::array<double, 2>> nodes;
    std::vector<Line> lines;
    std::vector<std::pair<int, NodeIndex>> points;  // entity, node
    std::vector<Element> quadrilaterals;            // without mid-side nodes where they are still to be made
    std::vector<int> tags, entities;                // of quadrilaterals
    bool has_linear = false, has_quadratic = false;
};

void read_format(Lines& lines) {
    double version = 0;
    int binary = 0, size = 0;
    lines.read("the version", version, binary, size);
    if (std::abs(version - 4.1) > 1e-9)
        lines.fail("this is version " + std::to_string(version) + ", 4.1 is needed: save with Mesh.MshFileVersion=4.1");
    if (binary != 0) lines.fail("this file is binary, ASCII is needed: save with Mesh.Binary=0");
    lines.end("MeshFormat");
}

void read_names(Lines& lines, Contents& contents) {
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

void read_entities(Lines& lines, Contents& contents) {
    std::array<long, 4> counts{};
    lines.read("the numbers of entities", counts[0], counts[1], counts[2], counts[3]);
    for (int dimension = 0; dimension < 4; ++dimension)
        for (long k = 0; k < counts[static_cast<std::size_t>(dimension)]; ++k) {
            int tag = 0, groups = 0;
            std::istringstream line = lines.read("an entity", tag);
            double coordinate = 0;
            for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c) line >> coordinate;
            line >> groups;
            for (int g = 0; g < groups; ++g) {
                int group = 0;
                line >> group;
                const auto name = contents.names.find({dimension, std::abs(group)});
                if (line && name == contents.names.end())
                    lines.fail("physical group " + std::to_string(group) + " of dimension " +
                               std::to_string(dimension) + " has no name in $PhysicalNames; give it one");
                if (line) contents.groups[{dimension, tag}].push_back(name->second);
            }
            if (!line) lines.fail("cannot read an entity");
        }
    lines.end("Entities");
}

void read_nodes(Lines& lines, Contents& contents) {
    long blocks = 0, total = 0;
    lines.read("the numbers of node blocks and nodes", blocks, total);
    double height = 0;
    for (long b = 0; b < blocks; ++b) {
        int dimension = 0, entity = 0, parametric = 0;
        long count = 0;
        lines.read("a block of nodes", dimension, entity, parametric, count);
        if (count < 0 || count > total) lines.fail("a block holds more nodes than the file announces");
        std::vector<int> tags(static_cast<std::size_t>(count));
        for (int& tag : tags) lines.read("a node tag", tag);
        for (const int tag : tags) {
            double x = 0, y = 0, z = 0;
            lines.read("the coordinates of a node", x, y, z);
            if (contents.nodes.empty()) height = z;
            if (z != height)
                lines.fail("node " + std::to_string(tag) + " lies off the plane of the others (z differs)");
            if (!contents.index.emplace(tag, static_cast<NodeIndex>(contents.nodes.size())).second)
                lines.fail("node " + std::to_string(tag) + " is there twice");
            contents.nodes.push_back({x, y});
            contents.node_tags.push_back(tag);
            contents.on_unnamed_point.push_back(dimension == 0 && !contents.groups.contains({0, entity}));
        }
    }
    if (static_cast<long>(contents.nodes.size()) != total)
        lines.fail("the blocks hold " + std::to_string(contents.nodes.size()) + " nodes, " + std::to_string(total) +
                   " are announced");
    lines.end("Nodes");
}

// Nodes of an element of this type; refuses the types that cannot be used, each with its remedy.
int node_count(int type, int tag, const Lines& lines) {
    switch (type) {
        case 15:
            return 1;
        case 1:
            return 2;
        case 8:
            return 3;
        case 3:
            return 4;
        case 16:
            return 8;
        default:
            break;
    }
    const std::string who = "element " + std::to_string(tag) + " ";
    if (type == 10)
        lines.fail(who + "is a 9-node quadrilateral, 8 nodes are needed: mesh with Mesh.SecondOrderIncomplete=1");
    if (type == 2 || type == 9)
        lines.fail(who +
                   "is a triangle, quadrilaterals are needed: mesh with Mesh.RecombineAll=1 and, where triangles "
                   "remain, Mesh.SubdivisionAlgorithm=1");
    lines.fail(who + "has the unknown type " + std::to_string(type) +
               "; lines (1, 8) and quadrilaterals of 4 or 8 nodes (3, 16) can be read");
}

void read_elements(Lines& lines, Contents& contents) {
    long blocks = 0, total = 0, seen = 0;
    lines.read("the numbers of element blocks and elements", blocks, total);
    for (long b = 0; b < blocks; ++b) {
        int dimension = 0, entity = 0, type = 0;
        long count = 0;
        lines.read("a block of elements", dimension, entity, type, count);
        for (long k = 0; k < count; ++k, ++seen) {
            int tag = 0;
            std::istringstream line = lines.read("an element", tag);
            const int nodes = node_count(type, tag, lines);
            Element node;
            for (int a = 0; a < nodes; ++a) {
                int node_tag = 0;
                if (!(line >> node_tag)) lines.fail("element " + std::to_string(tag) + " lacks nodes");
                const auto found = contents.index.find(node_tag);
                if (found == contents.index.end())
                    lines.fail("element " + std::to_string(tag) + " has node " + std::to_string(node_tag) +
                               ", which the file does not define");
                node.push_back(found->second);
            }
            if (type == 15) contents.points.emplace_back(entity, node[0]);
            if (type == 1 || type == 8) contents.lines.push_back({tag, entity, node[0], node[1]});
            if (type == 3 || type == 16) {
                contents.quadrilaterals.push_back(node);
                contents.tags.push_back(tag);
                contents.entities.push_back(entity);
                (type == 3 ? contents.has_linear : contents.has_quadratic) = true;
            }
        }
    }
    if (seen != total) lines.fail("the blocks hold fewer or more elements than announced");
    lines.end("Elements");
    if (contents.has_linear && contents.has_quadratic)
        lines.fail("4-node and 8-node quadrilaterals are mixed; mesh all with Mesh.ElementOrder=2");
    if (contents.quadrilaterals.empty()) lines.fail("there is no quadrilateral; put the surface in a physical group");
}

[[noreturn]] void fail(const std::string& source, const std::string& message) {
    throw MeshError(source + ": " + message);
}

// Straight mid-side nodes for 4-node quadrilaterals, one for each edge.
void add_mid_side_nodes(Contents& contents) {
    std::map<std::pair<NodeIndex, NodeIndex>, NodeIndex> middle;
    for (Element& element : contents.quadrilaterals)
        for (std::size_t s = 0; s < 4; ++s) {
            const NodeIndex a = element[s], b = element[(s + 1) % 4];
            const auto [found, made] = middle.emplace(std::minmax(a, b), static_cast<NodeIndex>(contents.nodes.size()));
            if (made) {
                const auto &A = contents.nodes[static_cast<std::size_t>(a)],
                           &B = contents.nodes[static_cast<std::size_t>(b)];
                contents.nodes.push_back({0.5 * (A[0] + B[0]), 0.5 * (A[1] + B[1])});
                contents.node_tags.push_back(0);
                contents.on_unnamed_point.push_back(false);
            }
            element.push_back(found->second);
        }
}

// Numbers only the nodes that quadrilaterals use; drops geometry points, refuses other nodes that nothing uses.
void drop_unused_nodes(Contents& contents, const std::string& source) {
    std::vector<bool> used(contents.nodes.size(), false);
    for (const Element& element : contents.quadrilaterals)
        for (const NodeIndex a : element) used[static_cast<std::size_t>(a)] = true;
    std::vector<NodeIndex> renumbered(contents.nodes.size(), -1);
    NodeIndex next = 0;
    for (std::size_t a = 0; a < used.size(); ++a) {
        if (!used[a] && !contents.on_unnamed_point[a])
            fail(source,
                 "node " + std::to_string(contents.node_tags[a]) + " is dangling: it belongs to no quadrilateral");
        if (!used[a]) continue;
        contents.nodes[static_cast<std::size_t>(next)] = contents.nodes[a];
        renumbered[a] = next++;
    }
    contents.nodes.resize(static_cast<std::size_t>(next));
    const auto renumber = [&](NodeIndex& a) { a = renumbered[static_cast<std::size_t>(a)]; };
    for (Element& element : contents.quadrilaterals) std::for_each(element.begin(), element.end(), renumber);
    for (Line& line : contents.lines) renumber(line.first), renumber(line.second);
    for (auto& [entity, node] : contents.points) renumber(node);
}

Mesh<2> build(Contents& contents, const std::string& source) {
    if (contents.has_linear) add_mid_side_nodes(contents);
    drop_unused_nodes(contents, source);
    Mesh<2> mesh{contents.nodes, contents.quadrilaterals, {}, {}, {}};
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        if (const std::string fault = element_fault(mesh, e); !fault.empty())
            fail(source, "element " + std::to_string(contents.tags[e]) + " " + fault);

    std::map<std::string, std::set<NodeIndex>> sets;
    const auto groups = [&](int dimension, int entity) -> std::vector<std::string> {
        const auto found = contents.groups.find({dimension, entity});
        return found == contents.groups.end() ? std::vector<std::string>{} : found->second;
    };
    for (const auto& [entity, node] : contents.points)
        for (const std::string& name : groups(0, entity))
            if (node >= 0) sets[name].insert(node);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        for (const std::string& name : groups(2, contents.entities[e]))
            sets[name].insert(mesh.elements[e].begin(), mesh.elements[e].end());

    std::map<std::pair<NodeIndex, NodeIndex>, std::pair<Facet, int>> edges;  // with the number of its elements
    for (const Element& element : mesh.elements)
        for (std::size_t s = 0; s < 4; ++s) {
            const Facet edge{element[s], element[(s + 1) % 4], element[4 + s]};
            ++edges.emplace(std::minmax(edge[0], edge[1]), std::pair{edge, 0}).first->second.second;
        }
    std::map<std::string, std::vector<Facet>> surfaces;
    for (const Line& line : contents.lines)
        for (const std::string& name : groups(1, line.entity)) {
            const auto found = edges.find(std::minmax(line.first, line.second));
            if (found == edges.end())
                fail(source, "line element " + std::to_string(line.tag) + " of '" + name +
                                 "' is not an edge of a quadrilateral");
            const auto& [edge, elements] = found->second;
            sets[name].insert(edge.begin(), edge.end());
            if (elements == 1) surfaces[name].push_back(edge);
        }
    for (const auto& [name, set] : sets) mesh.node_sets[name].assign(set.begin(), set.end());
    for (const auto& [name, list] : surfaces) mesh.surfaces[name] = chain(list);
    check(mesh);
    return mesh;
}

}  // namespace

Mesh<2> read_gmsh(std::istream& input, const std::string& source) {
    Lines lines(input, source);
    Contents contents;
    std::set<std::string> seen;
    std::string line;
    while (lines.next(line)) {
        if (line.front() != '$') lines.fail("a section ($Name) is expected here");
        const std::string section = line.substr(1, line.find_last_not_of(" \t"));
        if (section != "MeshFormat" && !seen.contains("MeshFormat"))
            lines.fail("$MeshFormat must come first: this is not a Gmsh file");
        if (section == "MeshFormat") {
            read_format(lines);
        } else if (section == "PhysicalNames") {
            read_names(lines, contents);
        } else if (section == "Entities") {
            read_entities(lines, contents);
        } else if (section == "Nodes") {
            read_nodes(lines, contents);
        } else if (section == "Elements") {
            if (!seen.contains("Nodes")) lines.fail("$Elements comes before $Nodes");
            read_elements(lines, contents);
        } else {  // of no use here
            std::string skipped;
            do {
                if (!lines.next(skipped)) lines.fail("the file ends inside $" + section + ": it is truncated");
            } while (skipped.rfind("$End" + section, 0) != 0);
        }
        seen.insert(section);
    }
    for (const char* section : {"MeshFormat", "PhysicalNames", "Entities", "Nodes", "Elements"})
        if (!seen.contains(section))
            lines.fail(std::string("the file has no $") + section +
                       (section == std::string("PhysicalNames")
                            ? ": it has no physical group; name the clamped and wet curves as physical curves"
                            : ": it is truncated or not a mesh"));
    return build(contents, source);
}

}  // namespace aquagraph::solid
