#include "io/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>

#include "io/atomic_file.hpp"
#include "io/suggestion.hpp"
#include "io/toml_document.hpp"

namespace aquagraph::io {
namespace {

using K = KeyKind;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr ValueRange any{};
constexpr ValueRange positive{0, inf, true, true};
constexpr ValueRange at_least_one{1, inf, false, true};

constexpr auto sections = std::to_array<SceneSection>({
    {"", false, true, "Before any table."},
    {"variant", true, false,
     "A named set of overrides: a scheme, a wall, an integrator. Without any the scenes run as they are."},
    {"case", true, false, "A scene at several resolutions, in some or all of the variants."},
});

constexpr auto keys = std::to_array<SceneKey>({
    {"", "schema_version", K::integer, true, "", {1, 1, false, false}, "", "", "version of this layout"},
    {"", "name", K::text, false, "", any, "", "the file's, up to its first dot", "of the section in the results"},
    {"", "title", K::text, false, "", any, "", "the name", "heading of the section"},
    {"",
     "repeats",
     K::integer,
     false,
     "",
     {1, 100, false, false},
     "",
     "1",
     "runs of everything, in turn; times are their medians"},
    {"", "time_limit", K::number, false, "s", positive, "", "3600",
     "a run that takes longer is stopped and counts as failed"},

    {"variant", "name", K::text, true, "", any, "", "", "letters, digits and _, beginning with a letter; each once"},
    {"variant", "label", K::text, false, "", any, "", "the name", "for tables and plots"},
    {"variant", "set", K::texts, false, "", any, "", "none", "overrides, KEY=VALUE as for `--set`"},

    {"case", "name", K::text, false, "", any, "", "folder of the scene",
     "letters, digits and _, beginning with a letter; each once"},
    {"case", "title", K::text, false, "", any, "", "title of the scene", "heading of its table"},
    {"case", "scene", K::text, true, "", any, "", "", "scene file, seen from the study's folder"},
    {"case", "set", K::texts, false, "", any, "", "none", "overrides for all runs of the case"},
    {"case", "variants", K::texts, false, "", any, "", "all", "names of the variants that apply"},
    {"case", "resolution_key", K::text, false, "", any, "", "fluid.spacing", "the key that is varied"},
    {"case", "resolutions", K::numbers, true, "", positive, "", "", "its values, from coarse to fine"},
    {"case", "coarse", K::integer, false, "", at_least_one, "", "1", "how many of them `--coarse` runs"},
    {"case", "error", K::text, false, "", any, "", "the first comparison", "label of the [[compare]] that is drawn"},
});

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
        if (study_.variants.empty()) study_.variants.push_back({"as_is", "as it is", {}});
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
        std::vector<std::string> known;
        for (const StudyVariant& variant : study_.variants) known.push_back(variant.name);
        if (!document_.take(at + ".variants", one.variants)) one.variants = known;
        for (std::size_t k = 0; k < one.variants.size(); ++k) {
            const std::string& wanted = one.variants[k];
            if (std::find(known.begin(), known.end(), wanted) != known.end()) continue;
            const auto guess = nearest(wanted, known);
            complaints_.add(fmt::format("{}.variants[{}]", at, k), fmt::format("there is no variant \"{}\"", wanted),
                            guess ? fmt::format("did you mean \"{}\"?", *guess)
                                  : fmt::format("there are {}", fmt::join(known, ", ")));
        }
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
    std::vector<std::string> variant_names_, case_names_;
};

}  // namespace

const KeyTable& study_table() {
    static constexpr KeyTable table{"study", sections, keys};
    return table;
}

Study read_study(const std::filesystem::path& file) {
    Study study;
    std::string text;
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
    if (!complaints.positions.empty() && !complaints.touch("schema_version"))
        Reader(document, complaints, study).everything();
    if (!complaints.empty()) throw SceneError(file, text, complaints.in_order_of_the_file());
    return study;
}

}  // namespace aquagraph::io
