// What is measured for the history beside the state itself, each a task that is absent where the scene does not ask.
#pragma once
#include <functional>
#include <vector>

#include "engine/history_parts.hpp"
#include "io/archive.hpp"
#include "tasks/task.hpp"

namespace aquagraph::engine {

struct Diagnostic {
    tasks::Task task;                               // measures the model's present state
    HistoryPart part;                               // what it has measured last
    std::function<void(io::AnyArchive)> archive{};  // of what it keeps between two measurements; empty: nothing
};

// The model must outlive them. Throws io::SceneError for a probe that is not on the wall it names.
template <int D>
std::vector<Diagnostic> make_diagnostics(const io::Scene& scene, Model<D>& model);

}  // namespace aquagraph::engine
