// A TOML text checked against a table of keys (io/scene_keys.hpp): known keys, types, ranges, nothing required missing.
// What is well formed comes out flat, by dotted key; the only part of the reader that knows the TOML library.
#pragma once
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/complaints.hpp"
#include "io/scene_keys.hpp"

namespace aquagraph::io {

using DocumentValue =
    std::variant<double, int, bool, std::string, std::array<double, 2>, std::vector<int>, Point,
                 std::vector<std::string>, std::vector<Point>, std::vector<double>, std::vector<std::array<double, 2>>>;

struct CheckedDocument {
    std::map<std::string, DocumentValue> values;  // "fluid.box[0].min"; only those without complaint
    std::map<std::string, int> tables;            // "fluid.box" -> how many there are; 1 for a plain table

    int count(const std::string& section) const;

    // Leaves `target`, the default, as it is where the key is not given; says whether it was.
    template <class T>
    bool take(const std::string& key, T& target) const {
        const auto found = values.find(key);
        if (found == values.end()) return false;
        target = std::get<T>(found->second);
        return true;
    }
};

// Complaints go into `complaints`, with the positions of all keys and tables. A syntax error is the only complaint
// there is.
//
// overrides: "fluid.spacing=0.01", as if the file had said so; a word that is no TOML value is taken as text. Keys of
// lists of tables carry their place, "wall[0].slip". What is wrong with the k-th one stands `first_line_of_overrides`
// + k lines down.
CheckedDocument check_document(const KeyTable& table, std::string_view text, Complaints& complaints,
                               std::span<const std::string> overrides = {}, int first_line_of_overrides = 0);

}  // namespace aquagraph::io
