// Every key of a scene file, in one table: the reader checks against it and benchmarks/SCENES.md shows it (a test
// compares them).
#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace aquagraph::io {

enum class KeyKind { number, integer, boolean, text, choice, point, pair_of_counts, texts, points, interval };

// The values that a number may have; the text of benchmarks/SCENES.md is made from it too.
struct ValueRange {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = true, high_open = true;

    bool contains(double value) const;
    std::string text() const;  // "> 0", "[1.5, 6]", "]0, 1]", "any"
};

struct SceneKey {
    std::string_view section;  // "fluid", "fluid.box"; empty: at the top of the file
    std::string_view name;     // "spacing"
    KeyKind kind;
    bool required;
    std::string_view unit;      // "m"; empty: none
    ValueRange range;           // of numbers, integers and entries of pair_of_counts
    std::string_view choices;   // of a choice, blank-separated: "muscl none"
    std::string_view standard;  // the default, as SCENES.md says it; empty where required
    std::string_view meaning;
};

struct SceneSection {
    std::string_view name;  // "fluid.box"
    bool repeated;          // [[fluid.box]]
    bool required;          // of every scene
    std::string_view meaning;
};

std::span<const SceneSection> scene_sections();
std::span<const SceneKey> scene_keys();

// The heading and the table of a section as they stand in benchmarks/SCENES.md.
std::string section_markdown(const SceneSection& section);

}  // namespace aquagraph::io
