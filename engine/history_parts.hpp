// The columns of history.csv, each group with what fills it: what a scene does not have or ask for is not there.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "engine/model.hpp"
#include "io/history.hpp"

namespace aquagraph::engine {

struct HistoryPart {
    std::vector<io::HistoryColumn> columns;
    std::function<void(std::vector<double>&)> append;  // one value per column, of the model's present state
    // What `append` remembers from row to row, for a checkpoint; null: nothing.
    std::shared_ptr<std::vector<double>> memory{};
};

// The state of the clock, the fluid and the solid. The model must outlive the parts.
template <int D>
std::vector<HistoryPart> history_parts(const io::Scene& scene, const Model<D>& model);

}  // namespace aquagraph::engine
