// Every key of a scene file, in one table: the reader checks against it and benchmarks/SCENES.md shows it (a test
// compares them).
#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace aquagraph::io {

enum class KeyKind {
    number,
    integer,
    boolean,
    text,
    choice,
    point,
    counts,
    texts,
    points,
    interval,
    formula,
    formulas,
    numbers,
    pairs
};

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
    ValueRange range;           // of numbers, integers and entries of counts
    std::string_view choices;   // of a choice, blank-separated: "muscl none"
    std::string_view standard;  // the default, as SCENES.md says it; empty where required
    std::string_view meaning;
};

struct SceneSection {
    std::string_view name;  // "fluid.box"
    bool repeated;          // [[fluid.box]]
    bool required;          // of every scene
    std::string_view meaning;
    bool free_names = false;  // the names of its keys are the writer's; each takes a number or a formula
    bool in_space = false;    // of three-dimensional scenes alone
};

// What a kind of file may hold: scenes here, studies in io/study_file.hpp.
struct KeyTable {
    std::string_view what;  // "scene", for messages
    std::span<const SceneSection> sections;
    std::span<const SceneKey> keys;

    // nullptr where there is none.
    const SceneSection* find_section(std::string_view name) const;
    const SceneKey* find_key(std::string_view section, std::string_view name) const;
};

const KeyTable& scene_table();
std::span<const SceneSection> scene_sections();
std::span<const SceneKey> scene_keys();

// "a number > 0 in m", "[x, y] in m", "one of muscl, none": what a key takes.
std::string expectation(const SceneKey& key);

// "[fluid]", "[[fluid.box]]"; the top of the file has no heading of its own.
std::string section_heading(const SceneSection& section);

// Names that history.csv and the results use themselves: not for walls, bodies and tracks.
std::span<const std::string_view> reserved_names();

// Heading, meaning and table of a section as they stand in benchmarks/SCENES.md and STUDIES.md.
std::string section_markdown(const SceneSection& section, const KeyTable& table = scene_table());

}  // namespace aquagraph::io
