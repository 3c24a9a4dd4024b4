#include "engine/study_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/results.hpp"
#include "io/scene_reader.hpp"
#include "io/suggestion.hpp"

namespace aquagraph::engine {

namespace {

std::string at_case(const StudyRun& run, const char* key) {
    return fmt::format("case[{}].{}", run.study_case, key);
}

std::string choice(const std::string& wanted, const std::vector<std::string>& known) {
    const auto guess = io::nearest(wanted, known);
    return guess ? fmt::format("did you mean \"{}\"?", *guess) : fmt::format("there are {}", fmt::join(known, ", "));
}

template <int D>
std::vector<std::string> columns_in(const io::Scene& scene) {
    return history_columns(scene, *make_model<D>(scene));
}

}  // namespace

io::Scene scene_of_run(const io::Study& study, const StudyRun& run, const std::vector<std::string>& keys) {
    const io::StudyCase& one = study.cases[run.study_case];
    try {
        return io::read_scene(one.scene, run.overrides);
    } catch (const io::SceneError& error) {
        const std::string what = error.what();
        for (std::size_t k = 0; k < keys.size(); ++k)
            if (what.starts_with(fmt::format("--set {}: error: ", run.overrides[k])))
                throw io::study_error(study, keys[k],
                                      fmt::format("{} refuses {}: {}", one.scene.filename().string(), run.overrides[k],
                                                  error.complaints().front().message),
                                      error.complaints().front().help);
        throw;
    }
}

void check_drawn_error(const io::Study& study, const StudyRun& run, const io::Scene& scene) {
    const std::string& wanted = study.cases[run.study_case].error;
    std::vector<std::string> labels;
    for (const io::Compare& compare : scene.comparisons)
        if (compare.error) labels.push_back(compare.label);
    if (wanted.empty() || std::find(labels.begin(), labels.end(), wanted) != labels.end()) return;
    throw io::study_error(study, at_case(run, "error"),
                          fmt::format("the scene has no [[compare]] with the label \"{}\"", wanted),
                          labels.empty() ? "add one to the scene" : choice(wanted, labels));
}

void check_curve(const io::Study& study, const StudyRun& run) {
    const io::StudyCase& one = study.cases[run.study_case];
    const io::Scene scene = io::read_scene(one.scene, run.overrides);
    const auto columns = scene.dimension == 3 ? columns_in<3>(scene) : columns_in<2>(scene);
    if (std::find(columns.begin(), columns.end(), one.curve) == columns.end())
        throw io::study_error(study, at_case(run, "curve"),
                              fmt::format("history.csv will have no column \"{}\"", one.curve),
                              choice(one.curve, columns));
}

}  // namespace aquagraph::engine
