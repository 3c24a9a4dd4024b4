// The speedup of a run over the one at the first value of the case's axis (p = 1), beside its theory.
#pragma once
#include <vector>

#include "engine/study_results.hpp"

namespace aquagraph::engine {

struct Speedup {
    double solve, fluid_step;         // t_FE, t_SPH: the thread time of a fluid step over the threads [s]
    double measured, theory, shared;  // (6.7)-(6.9), and the same where the solve uses one of the fluid's threads
};

// NaN where there is nothing to divide by. The case must name an axis of the study as its `speedup`.
Speedup speedup_of(const io::Study& study, const std::vector<StudyResult>& results, const StudyResult& result,
                   int threads);

// The study's axis that the case's `speedup` names; -1: none.
int speedup_axis(const io::Study& study, const io::StudyCase& one);

}  // namespace aquagraph::engine
