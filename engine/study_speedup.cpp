#include "engine/study_speedup.hpp"

#include <algorithm>

namespace aquagraph::engine {

namespace {

double solve_time(const StudyResult& result) {
    return result.median([](const RunRecord& r) { return r.solves > 0 ? r.solve_seconds / double(r.solves) : NAN; });
}

double fluid_step_time(const StudyResult& result, int threads) {
    return result.median([](const RunRecord& r) { return r.steps > 0 ? r.other_seconds / double(r.steps) : NAN; }) /
           threads;
}

}  // namespace

int speedup_axis(const io::Study& study, const io::StudyCase& one) {
    const auto axis = std::find_if(study.axes.begin(), study.axes.end(),
                                   [&](const io::StudyAxis& a) { return a.name == one.speedup; });
    return axis == study.axes.end() ? -1 : int(axis - study.axes.begin());
}

Speedup speedup_of(const io::Study& study, const std::vector<StudyResult>& results, const StudyResult& result,
                   int threads) {
    const io::StudyVariant& variant = study.variants[result.run.variant];
    std::vector<int> place = variant.place;
    place[std::size_t(speedup_axis(study, study.cases[result.run.study_case]))] = 0;
    const auto base = std::find_if(results.begin(), results.end(), [&](const StudyResult& other) {
        const io::StudyVariant& others = study.variants[other.run.variant];
        return other.run.study_case == result.run.study_case && other.run.resolution == result.run.resolution &&
               others.place == place && others.base == variant.base;
    });
    Speedup speedup{solve_time(result), fluid_step_time(result, threads), NAN, NAN, NAN};
    if (base == results.end()) return speedup;
    const double ratio = solve_time(*base) / fluid_step_time(*base, threads),
                 fraction = result.run.step_fraction / base->run.step_fraction;
    speedup.measured = base->median(&RunRecord::wall_seconds) / result.median(&RunRecord::wall_seconds);
    speedup.theory = speedup_theory(result.run.parallel, result.run.ratio, ratio, fraction);
    speedup.shared = speedup_on_threads(result.run.parallel, result.run.ratio, ratio, fraction, threads);
    return speedup;
}

}  // namespace aquagraph::engine
