#include "io/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace aquagraph::io {
namespace {

using K = KeyKind;

// What SCENES.md says that a key takes. A direction to turn about has three coordinates wherever there is one.
std::string kind_text(const SceneKey& key, bool in_space) {
    switch (key.kind) {
        case K::number:
            return "number";
        case K::integer:
            return "whole number";
        case K::boolean:
            return "true or false";
        case K::text:
            return "text";
        case K::choice:
            return "text";
        case K::point:
            return in_space || key.name == "axis" ? "[x, y, z]" : "[x, y]";
        case K::counts:
            return "[nx, ny]";
        case K::formula:
            return "formula";
        case K::formulas:
            return "list of formulas";
        case K::numbers:
            return "list of numbers";
        case K::texts:
            return "list of texts";
        case K::points:
            return "list of [x, y]";
        case K::interval:
            return "[from, to]";
        case K::pairs:
            return "list of pairs";
    }
    return {};
}

std::string choices_text(std::string_view choices, std::string_view quote) {
    std::string text;
    for (std::size_t begin = 0; begin < choices.size();) {
        const std::size_t end = std::min(choices.find(' ', begin), choices.size());
        text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", quote, choices.substr(begin, end - begin), quote);
        begin = end + 1;
    }
    return text;
}

std::string bound(double value) {
    return value == -1.0 / 3 ? "-1/3" : fmt::format("{}", value);
}

}  // namespace

bool ValueRange::contains(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string ValueRange::text() const {
    const bool below = std::isfinite(high), above = std::isfinite(low);
    if (!below && !above) return "any";
    if (!below) return fmt::format("{} {}", low_open ? ">" : "≥", bound(low));
    if (!above) return fmt::format("{} {}", high_open ? "<" : "≤", bound(high));
    if (low == high) return bound(low);
    return fmt::format("{}{}, {}{}", low_open ? "]" : "[", bound(low), bound(high), high_open ? "[" : "]");
}

const SceneSection* KeyTable::find_section(std::string_view name) const {
    for (const SceneSection& section : sections)
        if (section.name == name) return &section;
    return nullptr;
}

const SceneKey* KeyTable::find_key(std::string_view section, std::string_view name) const {
    for (const SceneKey& key : keys)
        if (key.section == section && key.name == name) return &key;
    return nullptr;
}

std::string expectation(const SceneKey& key) {
    if (key.kind == K::choice) return "one of " + choices_text(key.choices, "\"");
    std::string text;
    switch (key.kind) {
        case K::number:
            text = "a number";
            break;
        case K::integer:
            text = "a whole number";
            break;
        case K::text:
            text = "a text in quotes";
            break;
        case K::point:
            text = "two numbers [x, y] or three [x, y, z]";
            break;
        case K::counts:
            text = "two whole numbers [nx, ny] or three [nx, ny, nz]";
            break;
        case K::formula:
            text = "a formula in quotes or a number";
            break;
        case K::numbers:
            text = "a list of numbers [a, b, …]";
            break;
        case K::formulas:
            text = "a list of formulas [\"…\", …]";
            break;
        case K::texts:
            text = "a list of texts [\"…\", …]";
            break;
        case K::points:
            text = "a list of points [[x, y], …]";
            break;
        case K::interval:
            text = "two numbers [from, to]";
            break;
        case K::pairs:
            text = "a list of pairs [[a, b], …]";
            break;
        default:
            text = kind_text(key, false);
    }
    const std::string range = key.range.text();
    if (key.range.low == key.range.high)
        text += ", " + range;
    else if (range.front() == '[' || range.front() == ']')
        text += " in " + range;
    else if (range != "any")
        text += (key.kind == K::counts || key.kind == K::numbers ? ", each " : " ") + range;
    if (!key.unit.empty()) text += fmt::format(", in {}", key.unit);
    return text;
}

std::string section_heading(const SceneSection& section) {
    if (section.name.empty()) return {};
    return section.repeated ? fmt::format("[[{}]]", section.name) : fmt::format("[{}]", section.name);
}

std::string section_markdown(const SceneSection& section, const KeyTable& table) {
    std::string text =
        section.name.empty() ? "## Top of the file\n\n" : fmt::format("## `{}`\n\n", section_heading(section));
    if (section.free_names) return text + fmt::format("{}\n", section.meaning);
    text += fmt::format("{}\n\n| key | takes | unit | range | default | meaning |\n|---|---|---|---|---|---|\n",
                        section.meaning);
    for (const SceneKey& key : table.keys) {
        if (key.section != section.name) continue;
        const std::string range = key.kind == K::choice ? choices_text(key.choices, "`") : key.range.text();
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, kind_text(key, section.in_space),
                            key.unit.empty() ? "–" : key.unit, range == "any" ? "–" : range,
                            key.required ? "**required**" : key.standard, key.meaning);
    }
    return text;
}

}  // namespace aquagraph::io
