// MSH 4.1: nodes and elements in blocks, one for each entity of the geometry; physical groups belong to entities.
#include "physics/solid/readers/gmsh_sections.hpp"

namespace aquagraph::solid::gmsh {

void read_entities_4(GmshLines& lines, Contents& contents) {
    std::array<long, 4> counts{};
    lines.read("the numbers of entities", counts[0], counts[1], counts[2], counts[3]);
    for (int dimension = 0; dimension < 4; ++dimension)
        for (long k = 0; k < counts[std::size_t(dimension)]; ++k) {
            int tag = 0, groups = 0;
            std::istringstream line = lines.read("an entity", tag);
            double coordinate = 0;
            for (int c = 0; c < (dimension == 0 ? 3 : 6); ++c) line >> coordinate;
            line >> groups;
            for (int g = 0; g < groups; ++g) {
                int group = 0;
                if (line >> group)
                    contents.groups[{dimension, tag}].push_back(name_of(contents, dimension, group, lines));
            }
            if (!line) lines.fail("cannot read an entity");
        }
    lines.end("Entities");
}

void read_nodes_4(GmshLines& lines, Contents& contents) {
    long blocks = 0, total = 0;
    lines.read("the numbers of node blocks and nodes", blocks, total);
    for (long b = 0; b < blocks; ++b) {
        int dimension = 0, entity = 0, parametric = 0;
        long count = 0;
        lines.read("a block of nodes", dimension, entity, parametric, count);
        if (count < 0 || count > total) lines.fail("a block holds more nodes than the file announces");
        std::vector<int> tags(static_cast<std::size_t>(count));
        for (int& tag : tags) lines.read("a node tag", tag);
        for (const int tag : tags) {
            std::array<double, 3> x{};
            lines.read("the coordinates of a node", x[0], x[1], x[2]);
            add_node(contents, tag, x, dimension == 0 && !contents.groups.contains({0, entity}), lines);
        }
    }
    const auto seen = static_cast<long>(contents.mesh.nodes.size());
    if (seen != total)
        lines.fail("the blocks hold " + std::to_string(seen) + " nodes, " + std::to_string(total) + " are announced");
    lines.end("Nodes");
}

void read_elements_4(int D, GmshLines& lines, Contents& contents) {
    long blocks = 0, total = 0, seen = 0;
    lines.read("the numbers of element blocks and elements", blocks, total);
    for (long b = 0; b < blocks; ++b) {
        int dimension = 0, entity = 0, type = 0;
        long count = 0;
        lines.read("a block of elements", dimension, entity, type, count);
        for (long k = 0; k < count; ++k, ++seen) {
            int tag = 0;
            std::istringstream line = lines.read("an element", tag);
            const ElementType known = element_type(D, type, tag, lines);
            const auto groups = contents.groups.find({dimension, entity});
            add_element(contents, known, tag, line,
                        groups == contents.groups.end() ? std::vector<std::string>{} : groups->second, lines);
        }
    }
    if (seen != total) lines.fail("the blocks hold fewer or more elements than announced");
    lines.end("Elements");
}

}  // namespace aquagraph::solid::gmsh
