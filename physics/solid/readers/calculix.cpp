#include "physics/solid/readers/calculix.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "physics/solid/readers/calculix_deck.hpp"
#include "physics/solid/readers/raw_mesh.hpp"

namespace aquagraph::solid {

namespace {

// What says nothing about the mesh.
const std::set<std::string> left_out{"HEADING",      "PREPRINT",      "MATERIAL",
                                     "ELASTIC",      "HYPERELASTIC",  "DENSITY",
                                     "EXPANSION",    "CONDUCTIVITY",  "SPECIFIC HEAT",
                                     "PLASTIC",      "DAMPING",       "SOLID SECTION",
                                     "ORIENTATION",  "STEP",          "END STEP",
                                     "STATIC",       "DYNAMIC",       "FREQUENCY",
                                     "BUCKLE",       "MODAL DYNAMIC", "STEADY STATE DYNAMICS",
                                     "BOUNDARY",     "CLOAD",         "DLOAD",
                                     "DSLOAD",       "AMPLITUDE",     "INITIAL CONDITIONS",
                                     "TEMPERATURE",  "CONTROLS",      "RESTART",
                                     "OUTPUT",       "NODE OUTPUT",   "ELEMENT OUTPUT",
                                     "NODE FILE",    "EL FILE",       "NODE PRINT",
                                     "EL PRINT",     "ENERGY PRINT",  "ENERGY OUTPUT",
                                     "FILE FORMAT",  "TIME POINTS",   "PHYSICAL CONSTANTS",
                                     "CONTACT FILE", "CONTACT PRINT", "SECTION PRINT",
                                     "MONITOR",      "FIELD OUTPUT",  "HISTORY OUTPUT"};

// Dimension and nodes. Those of fewer dimensions than the mesh stand for its sides: mesh generators write them so.
const std::map<std::string, std::array<int, 2>> element_types{
    {"CPE4", {2, 4}},    {"CPE4R", {2, 4}},  {"CPS4", {2, 4}}, {"CPS4R", {2, 4}}, {"CPE8", {2, 8}},  {"CPE8R", {2, 8}},
    {"CPS8", {2, 8}},    {"CPS8R", {2, 8}},  {"C3D8", {3, 8}}, {"C3D8R", {3, 8}}, {"C3D8I", {3, 8}}, {"C3D20", {3, 20}},
    {"C3D20R", {3, 20}}, {"C3D10", {3, 10}}, {"T3D2", {1, 2}}, {"T3D3", {1, 3}},  {"CPS3", {2, 3}},  {"CPS6", {2, 6}}};

// Sets by name, told apart without regard to case.
class Sets {
  public:
    std::set<int>& operator[](const std::string& name) {
        const std::string key = upper_case(name);
        names_.emplace(key, name);
        return content_[key];
    }
    const std::set<int>* find(const std::string& name) const {
        const auto found = content_.find(upper_case(name));
        return found == content_.end() ? nullptr : &found->second;
    }
    // Calls f(name as first written, members).
    template <class F>
    void for_each(const F& f) const {
        for (const auto& [key, members] : content_) f(names_.at(key), members);
    }

  private:
    std::map<std::string, std::string> names_;
    std::map<std::string, std::set<int>> content_;
};

template <int D>
class Reader {
  public:
    Reader(std::istream& input, const std::string& source) : deck_(FileLines(input, source)) {}

    Mesh<D> read() {
        while (deck_.next_card()) card();
        if (index_of_.empty())
            deck_.fail("the deck has no elements of " + std::to_string(D) +
                       " dimensions: it is truncated or not a mesh");
        return finished();
    }

  private:
    using Sides = std::vector<std::pair<std::size_t, std::size_t>>;  // element of dimension D, side

    void card() {
        const std::string& keyword = deck_.keyword();
        if (keyword == "NODE") return nodes();
        if (keyword == "ELEMENT") return elements();
        if (keyword == "NSET") return set("NSET", node_sets_, raw_.index, "node");
        if (keyword == "ELSET") return set("ELSET", element_sets_, place_, "element");
        if (keyword == "SURFACE") return surface();
        if (left_out.contains(keyword)) return;
        if (keyword == "INCLUDE") deck_.fail("*INCLUDE is not followed: paste the other file in");
        if (keyword == "PART" || keyword == "INSTANCE" || keyword == "ASSEMBLY")
            deck_.fail("*" + keyword + " is not known: write a flat deck, without parts and instances");
        deck_.fail("*" + keyword + " is not known here, and may change what the mesh means: take it out");
    }

    std::string needed(const std::string& parameter) const {
        const auto value = deck_.parameter(parameter);
        if (!value || value->empty()) deck_.fail("*" + deck_.keyword() + " has no " + parameter + "=");
        return *value;
    }

    void nodes() {
        const auto set = deck_.parameter("NSET");
        std::vector<std::string> fields;
        while (deck_.next_data(fields)) {
            if (fields.size() < 3 || fields.size() > 4)
                deck_.fail("a node is a number and two or three coordinates, found " + std::to_string(fields.size()) +
                           " fields");
            const int tag = deck_.whole(fields[0]);
            if (!raw_.index.emplace(tag, NodeIndex(raw_.nodes.size())).second)
                deck_.fail("node " + std::to_string(tag) + " is there twice");
            auto& x = raw_.nodes.emplace_back();
            for (std::size_t d = 0; d + 1 < fields.size(); ++d) x[d] = deck_.number(fields[d + 1]);
            raw_.node_tags.push_back(tag);
            raw_.may_be_unused.push_back(false);
            if (set) node_sets_[*set].insert(tag);
        }
    }

    void elements() {
        const std::string type = upper_case(needed("TYPE"));
        const auto set = deck_.parameter("ELSET");
        const auto known = element_types.find(type);
        if (known == element_types.end() || known->second[0] > D ||
            (known->second[0] == D && known->second[1] % 3 == 0)) {
            std::string types;
            for (const auto& [name, content] : element_types)
                if (content[0] == D && content[1] % 3 != 0) types += " " + name;
            deck_.fail("elements of type " + type + " cannot be used in " + std::to_string(D) +
                       " dimensions; those are" + types);
        }
        const auto [dimension, nodes] = known->second;
        const auto count = std::size_t(nodes);
        std::vector<std::string> fields, more;
        while (deck_.next_data(fields)) {
            const long line = deck_.line();
            while (fields.size() < count + 1 && deck_.next_data(more))  // on several lines
                fields.insert(fields.end(), more.begin(), more.end());
            const int tag = deck_.whole(fields[0]);
            const std::string who = "element " + std::to_string(tag);
            if (fields.size() != count + 1)
                deck_.fail(who + " has " + std::to_string(fields.size() - 1) + " nodes, " + type + " takes " +
                               std::to_string(count),
                           line);
            if (!place_.emplace(tag, int(raw_.elements.size())).second) deck_.fail(who + " is there twice", line);
            if (dimension == D) index_of_.emplace(tag, index_of_.size());
            RawElement& element = raw_.elements.emplace_back();
            element.tag = tag;
            element.dimension = dimension;
            for (std::size_t a = 1; a < fields.size(); ++a) {
                const auto node = raw_.index.find(deck_.whole(fields[a]));
                if (node == raw_.index.end())
                    deck_.fail(who + " has node " + fields[a] + ", which the deck has not defined before", line);
                element.nodes.push_back(node->second);
            }
            if (set) element_sets_[*set].insert(tag);
        }
    }

    // Numbers, names of other sets, or with GENERATE first, last, step.
    void set(const std::string& parameter, Sets& sets, const std::map<int, int>& known, const std::string& what) {
        const std::string name = needed(parameter);
        const bool generate = deck_.parameter("GENERATE").has_value();
        std::set<int> members;
        const auto add = [&](int tag) {
            if (!known.contains(tag))
                deck_.fail("set '" + name + "' has " + what + " " + std::to_string(tag) +
                           ", which the deck has not defined before");
            members.insert(tag);
        };
        std::vector<std::string> fields;
        while (deck_.next_data(fields)) {
            if (generate) {
                if (fields.size() < 2 || fields.size() > 3) deck_.fail("GENERATE takes first, last and step");
                const int first = deck_.whole(fields[0]), last = deck_.whole(fields[1]),
                          step = fields.size() == 3 ? deck_.whole(fields[2]) : 1;
                if (step < 1 || last < first) deck_.fail("GENERATE runs backwards");
                for (int tag = first; tag <= last; tag += step) add(tag);
                continue;
            }
            for (const std::string& field : fields) {
                if (!field.empty() && field.find_first_not_of("0123456789") == std::string::npos) {
                    add(deck_.whole(field));
                    continue;
                }
                const std::set<int>* other = sets.find(field);
                if (other == nullptr) deck_.fail("there is no " + what + " set '" + field + "' before this line");
                members.insert(other->begin(), other->end());
            }
        }
        sets[name].insert(members.begin(), members.end());
    }

    void surface() {
        const std::string name = needed("NAME"), type = upper_case(deck_.parameter("TYPE").value_or("ELEMENT"));
        if (type == "NODE") return set("NAME", node_sets_, raw_.index, "node");
        if (type != "ELEMENT") deck_.fail("a surface of TYPE=" + type + " cannot be used; ELEMENT and NODE can");
        Sides& sides_of_surface = surfaces_[name];
        std::vector<std::string> fields;
        while (deck_.next_data(fields)) {
            if (fields.size() != 2) deck_.fail("a surface takes an element or a set of elements, and a side, S1, S2 …");
            const std::string side = upper_case(fields[1]);
            const std::size_t number =
                side.size() == 2 && side[0] == 'S' && side[1] > '0' ? std::size_t(side[1] - '1') : 99;
            std::set<int> single;
            const std::set<int>* elements = element_sets_.find(fields[0]);
            if (elements == nullptr) {
                if (fields[0].find_first_not_of("0123456789") != std::string::npos)
                    deck_.fail("there is no element set '" + fields[0] + "' before this line");
                elements = &(single = {deck_.whole(fields[0])});
            }
            for (const int tag : *elements) {
                const auto element = index_of_.find(tag);
                if (element == index_of_.end())
                    deck_.fail("surface '" + name + "' has element " + std::to_string(tag) +
                               ", which the deck has not defined before, or not in " + std::to_string(D) +
                               " dimensions");
                if (number >= sides<D>(raw_.elements[std::size_t(place_.at(tag))].nodes).size())
                    deck_.fail("element " + std::to_string(tag) + " has no side " + fields[1]);
                sides_of_surface.emplace_back(element->second, number);
            }
        }
    }

    Mesh<D> finished() {
        element_sets_.for_each([&](const std::string& name, const std::set<int>& tags) {
            for (const int tag : tags) raw_.elements[std::size_t(place_.at(tag))].groups.push_back(name);
        });
        const std::size_t corners_only = D == 2 ? 4 : 8;
        const std::size_t nodes = raw_.elements[std::size_t(place_.at(index_of_.begin()->first))].nodes.size();
        const std::map<int, NodeIndex> node_of = raw_.index;
        Mesh<D> mesh = make_mesh<D>(std::move(raw_), nodes == corners_only ? MeshOrder::linear : MeshOrder::quadratic,
                                    deck_.source());
        for (const auto& [name, list] : surfaces_) {
            std::set<NodeIndex> used;
            std::vector<Facet>& facets = mesh.surfaces[name] = {};
            for (const auto& [element, side] : list) {
                facets.push_back(sides<D>(mesh.elements[element])[side]);
                used.insert(facets.back().begin(), facets.back().end());
            }
            mesh.node_sets[name].assign(used.begin(), used.end());
            if constexpr (D == 2) facets = chain(facets);
        }
        node_sets_.for_each([&](const std::string& name, const std::set<int>& tags) {
            std::vector<NodeIndex>& set = mesh.node_sets[name] = {};
            for (const int tag : tags) set.push_back(node_of.at(tag));
            std::sort(set.begin(), set.end());
        });
        try {
            check(mesh);
        } catch (const MeshError& error) {
            throw MeshError(deck_.source() + ": " + error.what());
        }
        return mesh;
    }

    Deck deck_;
    RawMesh raw_;
    std::map<int, int> place_;             // number of an element in the deck -> in raw_.elements
    std::map<int, std::size_t> index_of_;  // … -> among those of dimension D
    Sets node_sets_, element_sets_;
    std::map<std::string, Sides> surfaces_;
};

}  // namespace

template <int D>
Mesh<D> read_calculix(std::istream& input, const std::string& source) {
    return Reader<D>(input, source).read();
}

template Mesh<2> read_calculix(std::istream&, const std::string&);
template Mesh<3> read_calculix(std::istream&, const std::string&);

}  // namespace aquagraph::solid
