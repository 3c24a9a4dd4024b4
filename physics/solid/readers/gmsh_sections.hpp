// The sections of Gmsh files, for read_gmsh alone.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "physics/solid/readers/file_lines.hpp"
#include "physics/solid/readers/raw_mesh.hpp"

namespace aquagraph::solid::gmsh {

using EntityKey = std::pair<int, int>;  // dimension, tag

// What a type of element is: type numbers are Gmsh's.
struct ElementType {
    int dimension = 0;
    std::size_t nodes = 0;
    const std::vector<int>* order = nullptr;  // node k of mesh.hpp is node (*order)[k] of Gmsh; null: the same
};

// Refuses types that cannot be used in D dimensions, each with its remedy. tag: of the element, for the message.
ElementType element_type(int D, int type, int tag, const GmshLines& lines);

struct Contents {
    RawMesh mesh;
    std::map<EntityKey, std::string> names;                // physical group -> name
    std::map<EntityKey, std::vector<std::string>> groups;  // 4.1: entity -> names of its physical groups
};

// The name of a physical group; refuses one without.
const std::string& name_of(const Contents& contents, int dimension, int group, const GmshLines& lines);

void add_node(Contents& contents, int tag, const std::array<double, 3>& x, bool may_be_unused, const GmshLines& lines);
// Reads the element's nodes off the rest of its line.
void add_element(Contents& contents, const ElementType& type, int tag, std::istringstream& rest,
                 std::vector<std::string> groups, const GmshLines& lines);

void read_entities_4(GmshLines& lines, Contents& contents);
void read_nodes_4(GmshLines& lines, Contents& contents);
void read_elements_4(int D, GmshLines& lines, Contents& contents);
void read_nodes_2(GmshLines& lines, Contents& contents);
void read_elements_2(int D, GmshLines& lines, Contents& contents);

}  // namespace aquagraph::solid::gmsh
