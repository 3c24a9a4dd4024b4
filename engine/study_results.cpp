#include "engine/study_results.hpp"

#include <algorithm>

namespace aquagraph::engine {

const RunRecord* StudyResult::good() const {
    for (const RunRecord& record : repeats)
        if (record.failure.empty()) return &record;
    return nullptr;
}

double StudyResult::median(const std::function<double(const RunRecord&)>& value) const {
    std::vector<double> values;
    for (const RunRecord& record : repeats)
        if (record.failure.empty()) values.push_back(value(record));
    if (values.empty()) return NAN;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

const RunError* main_error(const io::StudyCase& one, const RunRecord& record) {
    for (const RunError& error : record.errors)
        if (one.error.empty() || error.label == one.error) return &error;
    return nullptr;
}

}  // namespace aquagraph::engine
