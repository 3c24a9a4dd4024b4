#include "engine/diagnostics.hpp"

#include <memory>

#include "engine/probes.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"

namespace aquagraph::engine {

namespace {

namespace resource = tasks::resource;

template <int D>
Diagnostic probes(const io::Scene& scene, const Model<D>& model) {
    // Held by pointer: the graph copies bodies.
    auto all = std::make_shared<std::vector<Probe<D>>>();
    HistoryPart part;
    for (std::size_t k = 0; k < scene.probes.size(); ++k) {
        for (const io::HistoryColumn& column : all->emplace_back(scene, k, model).columns())
            part.columns.push_back(column);
    }
    part.append = [all](std::vector<double>& row) {
        for (const Probe<D>& probe : *all) row.insert(row.end(), probe.values().begin(), probe.values().end());
    };
    return {
        {.name = "probes",
         .reads = {resource::fluid_lists, resource::fluid_state, resource::walls},
         .writes = {},
         .body = [all,
                  &model] { tasks::for_each_block(all->size(), [&](std::size_t k) { (*all)[k].measure(model); }); }},
        part};
}

}  // namespace

template <int D>
std::vector<Diagnostic> make_diagnostics(const io::Scene& scene, Model<D>& model) {
    std::vector<Diagnostic> all;
    if (!scene.probes.empty()) all.push_back(probes(scene, model));
    return all;
}

template std::vector<Diagnostic> make_diagnostics(const io::Scene&, Model<2>&);
template std::vector<Diagnostic> make_diagnostics(const io::Scene&, Model<3>&);

}  // namespace aquagraph::engine
