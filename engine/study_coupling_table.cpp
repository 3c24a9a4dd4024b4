#include "engine/study_coupling_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace aquagraph::engine {

namespace {

std::string number(double value, const char* unit = "") {
    return std::isfinite(value) ? fmt::format("{:.3g}{}", value, unit) : "–";
}

class CouplingTable {
  public:
    CouplingTable(const io::Study& study, std::size_t number, const std::vector<StudyResult>& results, int threads)
        : study_(study), case_(study.cases[number]), threads_(threads) {
        for (const StudyResult& result : results)
            if (result.run.study_case == number) results_.push_back(&result);
        const auto axis = std::find_if(study.axes.begin(), study.axes.end(),
                                       [&](const io::StudyAxis& a) { return a.name == case_.speedup; });
        axis_ = axis == study.axes.end() ? -1 : int(axis - study.axes.begin());
    }

    std::string text() const {
        const bool speedup = axis_ >= 0;
        std::string text = fmt::format(
            "Difference: root mean square from `{}` of {} over its peak. Roughness: total variation of `{}` over that "
            "of "
            "{}; above {:g}, or where the run failed, the run counts as unstable{}.",
            case_.curve, case_.reference, case_.curve, case_.reference, case_.roughness,
            case_.growth > 0
                ? fmt::format(", as it does where the curve's range in the last quarter of the time is more "
                              "than {:g} times that in the second (growth)",
                              case_.growth)
                : "");
        if (speedup)
            text +=
                " t_FE: a solve; t_SPH: a fluid step, its thread time over the threads. Speedup over the first value "
                "of "
                "the axis; theory: (6.7)-(6.9) of the thesis with the ratio t_FE/t_SPH of the row that is divided by, "
                "and with its step, which the thesis does not shorten at p = 1; shared: the same where the solve uses "
                "one "
                "of the threads that the fluid uses too.";
        text += fmt::format("\n\n| variant | {} | steps |", case_.resolution_key);
        if (speedup) text += " t_FE [ms] | t_SPH [ms] | speedup | theory | shared |";
        text += " wall [s] | difference | growth | roughness | |\n|---|---|---|";
        if (speedup) text += "---|---|---|---|---|";
        text += "---|---|---|---|---|\n";
        for (const StudyResult* result : results_) text += row(*result, speedup);
        return text;
    }

  private:
    static double wall(const StudyResult& result) { return result.median(&RunRecord::wall_seconds); }
    static double solid_step(const StudyResult& result) {
        return result.median(
            [](const RunRecord& r) { return r.solves > 0 ? r.solve_seconds / double(r.solves) : NAN; });
    }
    double fluid_step(const StudyResult& result) const {
        return result.median([](const RunRecord& r) { return r.steps > 0 ? r.other_seconds / double(r.steps) : NAN; }) /
               threads_;
    }
    const StudyResult* find(double resolution, const auto& wanted) const {
        for (const StudyResult* result : results_)
            if (result->run.resolution == resolution && wanted(study_.variants[result->run.variant])) return result;
        return nullptr;
    }

    std::string row(const StudyResult& result, bool speedup) const {
        const io::StudyVariant& variant = study_.variants[result.run.variant];
        const RunRecord* record = result.good();
        const StudyResult* reference =
            find(result.run.resolution, [&](const io::StudyVariant& other) { return other.name == case_.reference; });
        const RunRecord* right = reference ? reference->good() : nullptr;
        std::string text = fmt::format("| {} | {:g} |", variant.label, result.run.resolution);
        text += record ? fmt::format(" {} |", record->steps) : " |";
        if (speedup) {
            const StudyResult* base = find(result.run.resolution, [&](const io::StudyVariant& other) {
                std::vector<int> place = variant.place;
                place[std::size_t(axis_)] = 0;
                return other.place == place && other.base == variant.base;
            });
            const double ratio = base ? solid_step(*base) / fluid_step(*base) : NAN;
            const double f = base ? result.run.step_fraction / base->run.step_fraction : NAN;
            text += fmt::format(" {} | {} | {} | {} | {} |", number(1e3 * solid_step(result)),
                                number(1e3 * fluid_step(result)), number(base ? wall(*base) / wall(result) : NAN),
                                number(speedup_theory(result.run.parallel, result.run.ratio, ratio, f)),
                                number(speedup_on_threads(result.run.parallel, result.run.ratio, ratio, f, threads_)));
        }
        const double away = record && right ? difference(record->curve, right->curve) : NAN;
        const double rough = record && right ? total_variation(record->curve) / total_variation(right->curve) : NAN;
        const double grown = record ? growth(record->curve) : NAN;
        const bool grows = case_.growth > 0 && !(grown <= case_.growth);
        const std::string verdict = !record                            ? "unstable: failed"
                                    : !std::isfinite(rough)            ? "no reference"
                                    : rough > case_.roughness || grows ? "unstable"
                                                                       : "stable";
        return text + fmt::format(" {} | {} | {} | {} | {} |\n", number(wall(result)), number(100 * away, " %"),
                                  number(grown), number(rough), verdict);
    }

    const io::Study& study_;
    const io::StudyCase& case_;
    int threads_, axis_ = -1;
    std::vector<const StudyResult*> results_;
};

}  // namespace

std::string coupling_table(const io::Study& study, std::size_t study_case, const std::vector<StudyResult>& results,
                           int threads) {
    return CouplingTable(study, study_case, results, threads).text();
}

}  // namespace aquagraph::engine
