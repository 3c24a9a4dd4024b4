#include "engine/study_coupling_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/study_speedup.hpp"

namespace aquagraph::engine {

namespace {

std::string number(double value, const char* unit = "") {
    return std::isfinite(value) ? fmt::format("{:.3g}{}", value, unit) : "–";
}

class CouplingTable {
  public:
    CouplingTable(const io::Study& study, std::size_t number, const std::vector<StudyResult>& results, int threads)
        : study_(study), case_(study.cases[number]), threads_(threads), all_(results) {
        for (const StudyResult& result : results)
            if (result.run.study_case == number) results_.push_back(&result);
    }

    std::string text() const {
        const bool speedup = speedup_axis(study_, case_) >= 0;
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
            const Speedup of = speedup_of(study_, all_, result, threads_);
            text += fmt::format(" {} | {} | {} | {} | {} |", number(1e3 * of.solve), number(1e3 * of.fluid_step),
                                number(of.measured), number(of.theory), number(of.shared));
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
    int threads_;
    const std::vector<StudyResult>& all_;
    std::vector<const StudyResult*> results_;
};

}  // namespace

std::string coupling_table(const io::Study& study, std::size_t study_case, const std::vector<StudyResult>& results,
                           int threads) {
    return CouplingTable(study, study_case, results, threads).text();
}

}  // namespace aquagraph::engine
