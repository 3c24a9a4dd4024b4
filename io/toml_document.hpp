// A TOML text checked against the table of keys (io/scene_keys.hpp): known keys, types, ranges, nothing required
// missing. What is well formed comes out flat, by dotted key; the only part of the reader that knows the TOML library.
#pragma once
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/complaints.hpp"

namespace aquagraph::io {

using DocumentValue = std::variant<double, int, bool, std::string, std::array<double, 2>, std::array<int, 2>, Point,
                                   std::vector<std::string>, std::vector<Point>>;

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
CheckedDocument check_document(std::string_view text, Complaints& complaints);

}  // namespace aquagraph::io
