// MSH 2.2: every element names its physical group itself; one in two groups stands there twice.
#include <set>

#include "physics/solid/readers/gmsh_sections.hpp"

namespace aquagraph::solid::gmsh {

void read_nodes_2(GmshLines& lines, Contents& contents) {
    long total = 0;
    lines.read("the number of nodes", total);
    for (long k = 0; k < total; ++k) {
        int tag = 0;
        std::array<double, 3> x{};
        lines.read("a node", tag, x[0], x[1], x[2]);
        add_node(contents, tag, x, false, lines);
    }
    lines.end("Nodes");
}

void read_elements_2(int D, GmshLines& lines, Contents& contents) {
    long total = 0;
    lines.read("the number of elements", total);
    std::map<std::set<NodeIndex>, std::size_t> place;  // of elements seen
    for (long k = 0; k < total; ++k) {
        int tag = 0, type = 0, count = 0;
        std::istringstream line = lines.read("an element", tag, type, count);
        const ElementType known = element_type(D, type, tag, lines);
        int group = 0;
        for (int t = 0; t < count; ++t) {
            int value = 0;
            line >> value;
            if (t == 0) group = value;
        }
        if (!line) lines.fail("cannot read the tags of element " + std::to_string(tag));
        std::vector<std::string> groups;
        if (group != 0) groups.push_back(name_of(contents, known.dimension, group, lines));
        add_element(contents, known, tag, line, groups, lines);
        std::vector<RawElement>& elements = contents.mesh.elements;
        const Element& nodes = elements.back().nodes;
        if (known.dimension == 0 && groups.empty()) contents.mesh.may_be_unused[std::size_t(nodes[0])] = true;
        const auto [first, is_new] = place.emplace(std::set(nodes.begin(), nodes.end()), elements.size() - 1);
        if (is_new) continue;
        if (groups.empty())
            lines.fail("element " + std::to_string(tag) + " is the same as element " +
                       std::to_string(elements[first->second].tag));
        elements[first->second].groups.push_back(groups[0]);
        elements.pop_back();
    }
    lines.end("Elements");
}

}  // namespace aquagraph::solid::gmsh
