#include "io/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "io/atomic_file.hpp"
#include "io/suggestion.hpp"
#include "io/toml_document.hpp"
#include "io/value_ranges.hpp"

namespace aquagraph::io {
namespace {

using K = KeyKind;
using namespace ranges;

constexpr auto sections = std::to_array<SceneSection>({
    {"", false, true, "Before any table."},
    {"variant", true, false,
     "A named set of overrides: a scheme, a wall, an integrator. Without any the scenes run as they are."},
    {"axis", true, false,
     "A key and values for it. Every value goes with every value of the other axes and with every variant: names "
     "become `cps_p4`, of a value that is a word itself, of a number with the axis's name before it."},
    {"case", true, false, "A scene at several resolutions, in some or all of the variants."},
});

constexpr auto keys = std::to_array<SceneKey>({
    {"", "schema_version", K::integer, true, "", closed(1, 1), "", "", "version of this layout"},
    {"", "name", K::text, false, "", any, "", "the file's, up to its first dot", "of the section in the results"},
    {"", "title", K::text, false, "", any, "", "the name", "heading of the section"},
    {"", "repeats", K::integer, false, "", closed(1, 100), "", "1",
     "runs of everything, in turn; times are their medians"},
    {"", "time_limit", K::number, false, "s", positive, "", "3600",
     "a run that takes longer is stopped and counts as failed"},
    {"", "readme", K::texts, false, "", any, "", "all",
     "names of the variants whose rows go into READMEs too; * stands for anything"},

    {"variant", "name", K::text, true, "", any, "", "", "letters, digits and _, beginning with a letter; each once"},
    {"variant", "label", K::text, false, "", any, "", "the name", "for tables and plots"},
    {"variant", "set", K::texts, false, "", any, "", "none", "overrides, KEY=VALUE as for `--set`"},

    {"axis", "name", K::text, true, "", any, "", "", "letters, digits and _, beginning with a letter; each once"},
    {"axis", "key", K::text, true, "", any, "", "", "of the scene: coupling.ratio"},
    {"axis", "values", K::texts, true, "", any, "", "", "what it takes in turn, as for `--set`"},
    {"axis", "coarse", K::integer, false, "", at_least_one, "", "all", "how many of them `--coarse` runs"},

    {"case", "name", K::text, false, "", any, "", "folder of the scene",
     "letters, digits and _, beginning with a letter; each once"},
    {"case", "title", K::text, false, "", any, "", "the name", "heading of its table"},
    {"case", "scene", K::text, true, "", any, "", "", "scene file, seen from the study's folder"},
    {"case", "set", K::texts, false, "", any, "", "none", "overrides for all runs of the case"},
    {"case", "variants", K::texts, false, "", any, "", "all",
     "names of the variants that apply; * stands for anything"},
    {"case", "resolution_key", K::text, false, "", any, "", "fluid.spacing", "the key that is varied"},
    {"case", "resolutions", K::numbers, true, "", positive, "", "", "its values, from coarse to fine"},
    {"case", "coarse", K::integer, false, "", at_least_one, "", "1", "how many of them `--coarse` runs"},
    {"case", "error", K::text, false, "", any, "", "the first comparison", "label of the [[compare]] that is drawn"},
    {"case", "curve", K::text, false, "", any, "", "none",
     "column of history.csv by which runs are compared with each other: the table then has their times per step, their "
     "difference from the `reference` and whether they are stable"},
    {"case", "reference", K::text, false, "", any, "", "the first variant",
     "name of the variant that is taken for right"},
    {"case", "speedup", K::text, false, "", any, "", "none",
     "axis: times are over that of the run with its first value and all else the same"},
    {"case", "growth", K::number, false, "", positive, "", "not looked at",
     "a run is also unstable if its curve's range in the last quarter of the time is larger than this times that in "
     "the second quarter"},
    {"case", "roughness", K::number, false, "", positive, "", "2",
     "a run is unstable if it fails, or if its curve's total variation is larger than this times the reference's"},
});

// Whether a name fits a pattern in which * stands for anything.
bool matches(std::string_view pattern, std::string_view name) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) return pattern == name;
    if (!name.starts_with(pattern.substr(0, star))) return false;
    const std::string_view rest = pattern.substr(star + 1);
    for (std::size_t at = star; at <= name.size(); ++at)
        if (matches(rest, name.substr(at))) return true;
    return false;
}

class Reader {
  public:
    Reader(const CheckedDocument& document, Complaints& complaints, Study& study)
        : document_(document), complaints_(complaints), study_(study) {}

    void everything() {
        document_.take("name", study_.name);
        study_.title = study_.name;
        document_.take("title", study_.title);
        document_.take("repeats", study_.repeats);
        study_.time_limit = 3600;
        document_.take("time_limit", study_.time_limit);
        for (int i = 0; i < document_.count("variant"); ++i) variant(fmt::format("variant[{}]", i));
        const bool given = !study_.variants.empty();
        if (!given) study_.variants.push_back({"as_is", "as it is", {}, "", {}, true});
        for (StudyVariant& variant : study_.variants) variant.base = variant.name;
        for (int i = 0; i < document_.count("axis"); ++i) axis(fmt::format("axis[{}]", i), given || i > 0);
        study_.readme = variants("readme");
        for (int i = 0; i < document_.count("case"); ++i) one_case(fmt::format("case[{}]", i));
        if (study_.cases.empty() && !complaints_.touch("case"))
            complaints_.add_at({1, 1}, "case", "the study has no [[case]]",
                               "give at least one, with scene and resolutions");
    }

  private:
    void variant(const std::string& at) {
        StudyVariant& variant = study_.variants.emplace_back();
        document_.take(at + ".name", variant.name);
        name(at + ".name", variant.name, variant_names_);
        variant.label = variant.name;
        document_.take(at + ".label", variant.label);
        document_.take(at + ".set", variant.set);
        for (std::size_t k = 0; k < variant.set.size(); ++k)
            variant.set_keys.push_back(fmt::format("{}.set[{}]", at, k));
    }

    // Multiplies what there is with the axis's values; `named`: their names stay in front.
    void axis(const std::string& at, bool named) {
        StudyAxis& axis = study_.axes.emplace_back();
        document_.take(at + ".name", axis.name);
        name(at + ".name", axis.name, axis_names_);
        document_.take(at + ".key", axis.key);
        document_.take(at + ".values", axis.values);
        if (axis.values.empty() && !complaints_.touch(at + ".values"))
            complaints_.add(at + ".values", "the axis has no values", "values = [\"1\", \"2\", \"4\"]");
        for (std::size_t k = 1; k < axis.values.size(); ++k)
            if (const auto same = axis.values.begin() + std::ptrdiff_t(k);
                std::find(axis.values.begin(), same, *same) != same)
                complaints_.add(fmt::format("{}.values[{}]", at, k), fmt::format("\"{}\" is named twice", *same),
                                "name each value once");
        axis.coarse = int(axis.values.size());
        document_.take(at + ".coarse", axis.coarse);
        const std::vector<StudyVariant> before = std::move(study_.variants);
        study_.variants.clear();
        for (const StudyVariant& variant : before)
            for (std::size_t k = 0; k < axis.values.size(); ++k) {
                const std::string& value = axis.values[k];
                StudyVariant& made = study_.variants.emplace_back(variant);
                const bool word = usable_as_constant(value);
                std::string part = word ? value : axis.name;
                if (!word)
                    for (const char c : value) part += c == '-' ? 'm' : c == '.' ? '_' : c;
                made.name = named ? variant.name + "_" + part : part;
                const std::string label = word ? value : axis.name + " = " + value;
                made.label = named ? variant.label + ", " + label : label;
                made.set.push_back(axis.key + "=" + value);
                made.set_keys.push_back(fmt::format("{}.values[{}]", at, k));
                made.place.push_back(int(k));
                made.coarse = variant.coarse && int(k) < axis.coarse;
            }
    }

    // The names of variants that fit the patterns of this key, each once; all where it is not there.
    std::vector<std::string> variants(const std::string& key) {
        std::vector<std::string> known, wanted, found;
        for (const StudyVariant& variant : study_.variants) known.push_back(variant.name);
        if (!document_.take(key, wanted)) return known;
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            bool fits = false;
            for (const std::string& name : known) {
                if (!matches(wanted[k], name)) continue;
                fits = true;
                if (std::find(found.begin(), found.end(), name) == found.end()) found.push_back(name);
            }
            if (fits) continue;
            const auto guess = nearest(wanted[k], known);
            complaints_.add(fmt::format("{}[{}]", key, k), fmt::format("there is no variant \"{}\"", wanted[k]),
                            guess ? fmt::format("did you mean \"{}\"?", *guess)
                                  : fmt::format("there are {}", fmt::join(known, ", ")));
        }
        return found;
    }

    // Where runs are compared with each other.
    void curve(const std::string& at, StudyCase& one) {
        document_.take(at + ".curve", one.curve);
        document_.take(at + ".reference", one.reference);
        document_.take(at + ".speedup", one.speedup);
        document_.take(at + ".roughness", one.roughness);
        document_.take(at + ".growth", one.growth);
        for (const char* key : {"reference", "speedup", "roughness", "growth"})
            if (one.curve.empty() && complaints_.positions.contains(at + "." + key))
                complaints_.add(at + "." + key,
                                fmt::format("`{}` says how curves are compared, but there is no `curve`", key),
                                "give `curve`, the column of history.csv");
        if (!one.reference.empty() &&
            std::find(one.variants.begin(), one.variants.end(), one.reference) == one.variants.end())
            complaints_.add(at + ".reference", fmt::format("the case has no variant \"{}\"", one.reference),
                            fmt::format("there are {}", fmt::join(one.variants, ", ")));
        if (one.reference.empty() && !one.variants.empty()) one.reference = one.variants.front();
        if (!one.speedup.empty() && std::none_of(study_.axes.begin(), study_.axes.end(),
                                                 [&](const StudyAxis& axis) { return axis.name == one.speedup; }))
            complaints_.add(at + ".speedup", fmt::format("there is no axis \"{}\"", one.speedup), "name an [[axis]]");
    }

    void one_case(const std::string& at) {
        StudyCase& one = study_.cases.emplace_back();
        if (std::string scene; document_.take(at + ".scene", scene)) {
            one.scene = (study_.file.parent_path() / scene).lexically_normal();
            one.name = one.scene.parent_path().filename().string();
            if (!std::filesystem::exists(one.scene))
                complaints_.add(at + ".scene", fmt::format("the scene {} does not exist", one.scene.string()),
                                "the path is seen from the study's folder");
        }
        document_.take(at + ".name", one.name);
        name(complaints_.positions.contains(at + ".name") ? at + ".name" : at, one.name, case_names_);
        document_.take(at + ".title", one.title);
        document_.take(at + ".set", one.set);
        one.resolution_key = "fluid.spacing";
        document_.take(at + ".resolution_key", one.resolution_key);
        document_.take(at + ".resolutions", one.resolutions);
        resolutions(at + ".resolutions", one.resolutions);
        document_.take(at + ".coarse", one.coarse);
        document_.take(at + ".error", one.error);
        one.variants = variants(at + ".variants");
        curve(at, one);
    }

    void resolutions(const std::string& key, const std::vector<double>& values) {
        if (complaints_.touch(key)) return;
        if (values.empty()) complaints_.add(key, "there is no resolution", "resolutions = [0.04, 0.02, 0.01]");
        for (std::size_t i = 1; i < values.size(); ++i)
            if (!(values[i] < values[i - 1]))
                complaints_.add(key, fmt::format("{} stands behind {}", values[i], values[i - 1]),
                                "resolutions run from coarse to fine, from the largest value to the smallest");
    }

    void name(const std::string& key, const std::string& given, std::vector<std::string>& taken) {
        if (complaints_.touch(key)) return;
        if (!usable_as_constant(given))
            complaints_.add(key, fmt::format("\"{}\" cannot be a name", given),
                            "letters, digits and _, beginning with a letter");
        else if (std::find(taken.begin(), taken.end(), given) != taken.end())
            complaints_.add(key, fmt::format("the name \"{}\" is already taken", given), "choose another");
        taken.push_back(given);
    }

    const CheckedDocument& document_;
    Complaints& complaints_;
    Study& study_;
    std::vector<std::string> variant_names_, axis_names_, case_names_;
};

}  // namespace

const KeyTable& study_table() {
    static constexpr KeyTable table{"study", sections, keys};
    return table;
}

SceneError study_error(const Study& study, std::string_view key, std::string message, std::string help) {
    return SceneError(study.file, study.text,
                      {{std::string(key), position_of(study.positions, key), std::move(message), std::move(help)}});
}

Study read_study(const std::filesystem::path& file) {
    Study study;
    std::string& text = study.text;
    try {
        if (std::filesystem::is_directory(file))
            throw std::system_error(std::make_error_code(std::errc::is_a_directory));
        study.file = std::filesystem::absolute(file).lexically_normal();
        text = read_file(file);
    } catch (const std::system_error& error) {
        throw SceneError(file, {},
                         {{"",
                           {},
                           "the study cannot be read: " + error.code().message(),
                           "give the path of a study file, such as benchmarks/fluid.study.toml"}});
    }
    study.name = study.file.filename().string();
    study.name = study.name.substr(0, study.name.find('.'));
    Complaints complaints;
    const CheckedDocument document = check_document(study_table(), text, complaints);
    if (complaints.touch("domain"))
        throw SceneError(file, text,
                         {{"",
                           {},
                           "this is a scene, not a study",
                           "give it to `aquagraph run`; a study names scenes in its [[case]]s"}});
    if (!complaints.positions.empty() && !complaints.touch("schema_version"))
        Reader(document, complaints, study).everything();
    if (!complaints.empty()) throw SceneError(file, text, complaints.in_order_of_the_file());
    study.positions = std::move(complaints.positions);
    return study;
}

}  // namespace aquagraph::io
