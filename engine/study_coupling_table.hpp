// The table of a case whose runs are compared with each other: what solid and fluid cost per step, the speedup beside
// its theory, the difference from the reference and whether the run is stable.
#pragma once
#include <string>
#include <vector>

#include "engine/study_results.hpp"

namespace aquagraph::engine {

// threads: of a run.
std::string coupling_table(const io::Study& study, std::size_t study_case, const std::vector<StudyResult>& results,
                           int threads);

}  // namespace aquagraph::engine
