// A run of a study with all its repeats, and what tables and plots ask of it.
#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "engine/study_runs.hpp"
#include "io/study_file.hpp"

namespace aquagraph::engine {

struct StudyResult {
    StudyRun run;
    std::vector<RunRecord> repeats;

    // The first repeat that went well: steps and errors are those of all of them. Null where each one failed.
    const RunRecord* good() const;
    // Of the repeats that went well; NaN where there is none.
    double median(const std::function<double(const RunRecord&)>& value) const;
};

// The error that is drawn and multiplied with time: the one that the case names, otherwise the first; null without any.
const RunError* main_error(const io::StudyCase& one, const RunRecord& record);

}  // namespace aquagraph::engine
