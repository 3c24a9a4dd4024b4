#include "io/toml_document.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <system_error>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include "io/suggestion.hpp"

namespace aquagraph::io {
namespace {

// Where things given on the command line are said to stand: their text was parsed under a path that is this line.
SourcePosition place(const toml::source_region& region) {
    if (region.path) return {std::stoi(*region.path), 1};
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

std::string_view type_text(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "a list";
        case toml::node_type::string:
            return "a text";
        case toml::node_type::integer:
            return "a whole number";
        case toml::node_type::floating_point:
            return "a number with a fraction";
        case toml::node_type::boolean:
            return "true or false";
        default:
            return "a date or time";
    }
}

std::string dotted(const std::string& path, std::string_view name) {
    return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

std::string help_for(const SceneKey& key) {
    return fmt::format("`{}` is {}: {}", key.name, expectation(key), key.meaning);
}

class Checker {
  public:
    Checker(const KeyTable& known, CheckedDocument& document, Complaints& complaints)
        : known_(known), document_(document), complaints_(complaints) {}

    void table(const SceneSection& section, const std::string& path, const toml::table& table) {
        if (section.name.empty() && !version_is_known(table)) return;
        for (auto&& [key, node] : table) {
            const std::string full = dotted(path, key.str());
            const std::string child = dotted(std::string(section.name), key.str());
            complaints_.positions.try_emplace(full, place(node.source()));
            if (section.free_names)
                free(full, key.str(), place(key.source()), node);
            else if (const SceneKey* known = known_.find_key(section.name, key.str()))
                value(*known, full, node);
            else if (const SceneSection* inner = known_.find_section(child))
                subtable(*inner, full, place(key.source()), node);
            else
                unknown(section, key.str(), full, place(key.source()));
        }
        for (const SceneKey& key : known_.keys)
            if (key.section == section.name && key.required && !table.contains(key.name))
                complaints_.add(dotted(path, key.name),
                                fmt::format("`{}` is missing{}", key.name,
                                            section.name.empty() ? "" : " in " + section_heading(section)),
                                help_for(key));
        if (section.name.empty()) missing_tables(table);
    }

  private:
    void missing_tables(const toml::table& root) {
        for (const SceneSection& section : known_.sections)
            if (section.required && !section.name.empty() && !root.contains(section.name))
                complaints_.add_at(
                    {1, 1}, section.name, fmt::format("the table {} is missing", section_heading(section)),
                    fmt::format("every {} needs {}: {}", known_.what, section_heading(section), section.meaning));
    }

    // Another version has other keys: nothing else that could be said of such a file would help.
    bool version_is_known(const toml::table& root) {
        const toml::node* node = root.get("schema_version");
        if (!known_.find_key("", "schema_version") || !node || !node->is_integer() || node->value_or(0LL) == 1)
            return true;
        complaints_.positions["schema_version"] = place(node->source());
        complaints_.add("schema_version", fmt::format("schema_version {} is not supported", node->value_or(0LL)),
                        fmt::format("this program reads a {} of schema_version = 1", known_.what));
        return false;
    }

    void subtable(const SceneSection& section, const std::string& path, SourcePosition key_place,
                  const toml::node& node) {
        const std::string heading = section_heading(section);
        if (!section.repeated) {
            if (const toml::table* inner = node.as_table()) {
                document_.tables[path] = 1;
                table(section, path, *inner);
            } else {
                complaints_.add_at(key_place, path,
                                   fmt::format("`{}` must be a table, but it is {}", section.name, type_text(node)),
                                   fmt::format("write {} once", heading));
            }
            return;
        }
        const toml::array* list = node.as_array();
        bool tables = list != nullptr;
        if (list)
            for (auto&& element : *list) tables = tables && element.is_table();
        if (!tables) {
            complaints_.add_at(
                key_place, path,
                fmt::format("`{}` must be a list of tables, but it is {}", section.name, type_text(node)),
                fmt::format("write {} with double brackets, once for each", heading));
            return;
        }
        document_.tables[path] = static_cast<int>(list->size());
        for (std::size_t i = 0; i < list->size(); ++i) {
            const std::string element = fmt::format("{}[{}]", path, i);
            complaints_.positions[element] = place((*list)[i].source());
            table(section, element, *(*list)[i].as_table());
        }
    }

    void unknown(const SceneSection& section, std::string_view name, const std::string& path, SourcePosition where) {
        std::vector<std::string> known;
        for (const SceneKey& key : known_.keys)
            if (key.section == section.name) known.emplace_back(key.name);
        const std::string prefix = section.name.empty() ? "" : fmt::format("{}.", section.name);
        for (const SceneSection& inner : known_.sections)
            if (inner.name.size() > prefix.size() && inner.name.starts_with(prefix) &&
                inner.name.find('.', prefix.size()) == std::string_view::npos)
                known.emplace_back(inner.name.substr(prefix.size()));

        std::string help;
        if (const auto guess = nearest(name, known)) {
            help = fmt::format("did you mean `{}`?", *guess);
        } else {
            for (const SceneKey& key : known_.keys)
                if (key.name == name && help.empty())
                    help = key.section.empty() ? fmt::format("`{}` belongs at the top of the file", name)
                                               : fmt::format("`{}` belongs to {}", name,
                                                             section_heading(*known_.find_section(key.section)));
            if (help.empty()) help = fmt::format("known here: {}", fmt::join(known, ", "));
        }
        complaints_.add_at(where, path,
                           section.name.empty() ? fmt::format("unknown key or table `{}`", name)
                                                : fmt::format("unknown key `{}` in {}", name, section_heading(section)),
                           help);
    }

    void wrong_type(const SceneKey& key, const std::string& path, const toml::node& node, std::string_view is = {}) {
        complaints_.add_at(
            place(node.source()), path,
            fmt::format("`{}` must be {}, but it is {}", key.name, expectation(key), is.empty() ? type_text(node) : is),
            help_for(key));
    }

    void free(const std::string& path, std::string_view name, SourcePosition where, const toml::node& node) {
        if (const auto number = node.value<double>(); number && node.is_number() && std::isfinite(*number))
            keep(path, *number);
        else if (const auto words = node.value_exact<std::string>(); words && !words->empty())
            keep(path, *words);
        else
            complaints_.add_at(where, path, fmt::format("`{}` must be a finite number or a formula in quotes", name),
                               "U = 1.5, or k = \"2*pi/L\"");
    }

    // A number is a formula too.
    std::optional<std::string> formula(const SceneKey& key, const std::string& path, const toml::node& node) {
        if (!node.is_number()) return text(key, path, node);
        const auto number = finite(key, path, node);
        return number ? std::optional(fmt::format("{}", *number)) : std::nullopt;
    }

    void value(const SceneKey& key, const std::string& path, const toml::node& node) {
        switch (key.kind) {
            case KeyKind::number:
                if (const auto number = finite(key, path, node); number && inside(key, path, node, *number))
                    keep(path, *number);
                break;
            case KeyKind::integer:
                if (const auto number = whole(key, path, node)) keep(path, *number);
                break;
            case KeyKind::boolean:
                if (const auto flag = node.value_exact<bool>())
                    keep(path, *flag);
                else
                    wrong_type(key, path, node);
                break;
            case KeyKind::text:
                if (const auto words = text(key, path, node)) keep(path, *words);
                break;
            case KeyKind::formula:
                if (const auto words = formula(key, path, node)) keep(path, *words);
                break;
            case KeyKind::choice:
                choice(key, path, node);
                break;
            case KeyKind::point:
                if (const auto place = point(key, path, node)) keep(path, *place);
                break;
            case KeyKind::interval:
                if (const auto both = pair(key, path, node)) keep(path, *both);
                break;
            case KeyKind::numbers:
                numbers(key, path, node);
                break;
            case KeyKind::counts:
                counts(key, path, node);
                break;
            case KeyKind::texts:
            case KeyKind::formulas:
                texts(key, path, node);
                break;
            case KeyKind::points:
                points(key, path, node);
                break;
            case KeyKind::pairs:
                pairs(key, path, node);
                break;
        }
    }

    template <class T>
    void keep(const std::string& path, T value) {
        document_.values[path] = std::move(value);
    }

    std::optional<double> finite(const SceneKey& key, const std::string& path, const toml::node& node) {
        if (!node.is_number()) return wrong_type(key, path, node), std::nullopt;
        const double number = *node.value<double>();
        if (std::isfinite(number)) return number;
        complaints_.add_at(place(node.source()), path,
                           fmt::format("`{}` must be a finite number, but it is {}", key.name, number), help_for(key));
        return std::nullopt;
    }

    bool inside(const SceneKey& key, const std::string& path, const toml::node& node, double number) {
        if (key.range.contains(number)) return true;
        const std::string range = key.range.text();
        const bool both_ends = range.front() == '[' || range.front() == ']';
        complaints_.add_at(
            place(node.source()), path,
            fmt::format("`{}` must be {}{}, but it is {}", key.name, both_ends ? "in " : "", range, number),
            help_for(key));
        return false;
    }

    std::optional<int> whole(const SceneKey& key, const std::string& path, const toml::node& node) {
        if (!node.is_integer()) return wrong_type(key, path, node), std::nullopt;
        const auto number = *node.value_exact<std::int64_t>();
        if (!inside(key, path, node, static_cast<double>(number))) return std::nullopt;
        if (number > std::numeric_limits<int>::max()) return wrong_type(key, path, node, "too large"), std::nullopt;
        return static_cast<int>(number);
    }

    std::optional<std::string> text(const SceneKey& key, const std::string& path, const toml::node& node) {
        auto words = node.value_exact<std::string>();
        if (!words) return wrong_type(key, path, node), std::nullopt;
        if (!words->empty()) return words;
        return wrong_type(key, path, node, "empty"), std::nullopt;
    }

    void choice(const SceneKey& key, const std::string& path, const toml::node& node) {
        const auto word = text(key, path, node);
        if (!word) return;
        std::vector<std::string> known;
        for (std::size_t begin = 0; begin < key.choices.size();) {
            const std::size_t end = std::min(key.choices.find(' ', begin), key.choices.size());
            known.emplace_back(key.choices.substr(begin, end - begin));
            if (known.back() == *word) return keep(path, *word);
            begin = end + 1;
        }
        const auto guess = nearest(*word, known);
        complaints_.add_at(place(node.source()), path,
                           fmt::format("`{}` must be {}, but it is \"{}\"", key.name, expectation(key), *word),
                           guess ? fmt::format("did you mean \"{}\"?", *guess) : help_for(key));
    }

    const toml::array* list(const SceneKey& key, const std::string& path, const toml::node& node,
                            std::size_t size = 0) {
        const toml::array* found = node.as_array();
        if (!found) return wrong_type(key, path, node), nullptr;
        if (size > 0 && found->size() != size)
            return wrong_type(key, path, node, fmt::format("a list of {}", found->size())), nullptr;
        for (std::size_t i = 0; i < found->size(); ++i)
            complaints_.positions[fmt::format("{}[{}]", path, i)] = place((*found)[i].source());
        return found;
    }

    std::optional<std::array<double, 2>> pair(const SceneKey& key, const std::string& path, const toml::node& node) {
        const toml::array* both = list(key, path, node, 2);
        if (!both) return std::nullopt;
        const auto first = finite(key, path, (*both)[0]), second = finite(key, path, (*both)[1]);
        if (!first || !second) return std::nullopt;
        return std::array{*first, *second};
    }

    // That all points of a scene have the same number of coordinates is looked at when all are known.
    std::optional<Point> point(const SceneKey& key, const std::string& path, const toml::node& node) {
        const bool three = node.is_array() && node.as_array()->size() == 3;
        const toml::array* all = list(key, path, node, three ? 3 : 2);
        if (!all) return std::nullopt;
        const auto x = finite(key, path, (*all)[0]), y = finite(key, path, (*all)[1]);
        const auto z = three ? finite(key, path, (*all)[2]) : 0.0;
        if (!x || !y || !z) return std::nullopt;
        return three ? Point(*x, *y, *z) : Point(*x, *y);
    }

    void counts(const SceneKey& key, const std::string& path, const toml::node& node) {
        const bool three = node.is_array() && node.as_array()->size() == 3;
        const toml::array* all = list(key, path, node, three ? 3 : 2);
        if (!all) return;
        std::vector<int> counts;
        for (auto&& element : *all)
            if (const auto count = whole(key, path, element)) counts.push_back(*count);
        if (counts.size() == all->size()) keep(path, std::move(counts));
    }

    void texts(const SceneKey& key, const std::string& path, const toml::node& node) {
        const toml::array* all = list(key, path, node);
        if (!all) return;
        std::vector<std::string> words;
        bool good = true;
        for (auto&& element : *all) {
            const auto word = key.kind == KeyKind::formulas ? formula(key, path, element) : text(key, path, element);
            good = good && word;
            if (word) words.push_back(*word);
        }
        if (good) keep(path, std::move(words));
    }

    void points(const SceneKey& key, const std::string& path, const toml::node& node) {
        const toml::array* all = list(key, path, node);
        if (!all) return;
        std::vector<Point> corners;
        bool good = true;
        for (std::size_t i = 0; i < all->size(); ++i) {
            const auto corner = point(key, fmt::format("{}[{}]", path, i), (*all)[i]);
            good = good && corner;
            if (corner) corners.push_back(*corner);
        }
        if (good) keep(path, std::move(corners));
    }

    void pairs(const SceneKey& key, const std::string& path, const toml::node& node) {
        const toml::array* all = list(key, path, node);
        if (!all) return;
        std::vector<std::array<double, 2>> values;
        bool good = true;
        for (std::size_t i = 0; i < all->size(); ++i) {
            const auto both = pair(key, fmt::format("{}[{}]", path, i), (*all)[i]);
            good = good && both;
            if (both) values.push_back(*both);
        }
        if (good) keep(path, std::move(values));
    }

    void numbers(const SceneKey& key, const std::string& path, const toml::node& node) {
        const toml::array* all = list(key, path, node);
        if (!all) return;
        std::vector<double> values;
        bool good = true;
        for (auto&& element : *all) {
            const auto number = finite(key, path, element);
            good = good && number && inside(key, path, element, *number);
            if (number) values.push_back(*number);
        }
        if (good) keep(path, std::move(values));
    }

    const KeyTable& known_;
    CheckedDocument& document_;
    Complaints& complaints_;
};

// Puts overrides into the tables that the file gave.
class Override {
  public:
    Override(const std::string& text, int line, Complaints& complaints)
        : text_(text), line_(line), complaints_(complaints) {}

    void apply(toml::table& root) {
        const std::size_t equals = text_.find('=');
        if (equals == std::string::npos || equals == 0)
            return complain("this is not KEY=VALUE", "give a key of the file and its value: fluid.spacing=0.01");
        toml::table parsed = value(text_.substr(equals + 1));
        toml::table* table = &root;
        std::string_view path = std::string_view(text_).substr(0, equals);
        while (!path.empty() && path.back() == ' ') path.remove_suffix(1);
        for (std::size_t dot = path.find('.'); dot != std::string_view::npos; dot = path.find('.')) {
            table = inner(*table, path.substr(0, dot));
            if (!table) return;
            path.remove_prefix(dot + 1);
        }
        toml::node& given = *parsed.get("value");
        table->insert_or_assign(toml::key(path, toml::source_region(given.source())),
                                std::move(given));  // a copy would not know its place
    }

  private:
    void complain(std::string message, std::string help) {
        complaints_.add_at({line_, 1}, "", std::move(message), std::move(help));
    }

    // A word without quotes is a text.
    toml::table value(const std::string& given) const {
        const std::string path = std::to_string(line_);
        try {
            return toml::parse("value = " + given, path);
        } catch (const toml::parse_error&) {
            std::string escaped;
            for (const char c : given) {
                if (c == '"' || c == '\\') escaped += '\\';
                escaped += c;
            }
            return toml::parse("value = \"" + escaped + '"', path);
        }
    }

    toml::table* inner(toml::table& table, std::string_view name) {
        const std::size_t bracket = name.find('[');
        toml::node* node = table.get(name.substr(0, bracket));
        if (bracket == std::string_view::npos) {
            if (!node) node = &table.insert(name, toml::table{}).first->second;
            if (node->is_table()) return node->as_table();
            complain(fmt::format("`{}` is {}, not a table", name, type_text(*node)),
                     fmt::format("one of a list of tables is {}[0]", name));
            return nullptr;
        }
        std::size_t place = 0;
        const char* const end = name.data() + name.size();
        const auto [behind, error] = std::from_chars(name.data() + bracket + 1, end, place);
        const bool is_number = error == std::errc{} && std::string_view(behind, end) == "]";
        toml::array* list = node ? node->as_array() : nullptr;
        const std::size_t size = list ? list->size() : 0;
        if (!is_number || place >= size || !list->get(place)->is_table()) {
            complain(fmt::format("there is no {}: the file has {} of them", name, size), "the first one is number 0");
            return nullptr;
        }
        return list->get(place)->as_table();
    }

    const std::string& text_;
    int line_;
    Complaints& complaints_;
};

}  // namespace

int CheckedDocument::count(const std::string& section) const {
    const auto found = tables.find(section);
    return found == tables.end() ? 0 : found->second;
}

CheckedDocument check_document(const KeyTable& known, std::string_view text, Complaints& complaints,
                               std::span<const std::string> overrides, int first_line_of_overrides) {
    CheckedDocument document;
    try {
        toml::table root = toml::parse(text);
        for (std::size_t k = 0; k < overrides.size(); ++k)
            Override(overrides[k], first_line_of_overrides + int(k), complaints).apply(root);
        Checker(known, document, complaints).table(*known.find_section(""), "", root);
    } catch (const toml::parse_error& error) {
        complaints.add_at(place(error.source()), "", fmt::format("not valid TOML: {}", error.description()),
                          "a key stands once and takes one value, texts stand in quotes, every bracket is closed");
    }
    return document;
}

}  // namespace aquagraph::io
