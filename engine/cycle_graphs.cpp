#include "engine/cycle_graphs.hpp"

#include <string>

#include "engine/listings.hpp"
#include "engine/trials.hpp"

namespace aquagraph::engine {

namespace {

std::string pass_name(const std::string& task) {
    return task.substr(0, task.find(" ("));
}

std::string family_of(const std::string& pass) {
    if (pass == "FE Newton solve" || pass == "FE equilibrium") return "solid";
    if (pass == "exchange" || pass == "wall motion" || pass == "ratio control" || pass == "relaxation" ||
        pass == "start of iterations" || pass == "back to the start" || pass.starts_with("interface "))
        return "coupling";
    if (pass == "history" || pass == "frames" || pass == "probes" || pass == "wall forces") return "output";
    return "fluid";
}

}  // namespace

template <int D>
CycleGraphs<D>::CycleGraphs(Model<D>& model, const io::Scene& scene, Results<D>& results, tasks::Executor& executor,
                            tasks::Trace* trace)
    : model_(model), scene_(scene), results_(results), executor_(executor), trace_(trace) {
    graphs(ratio());
}

template <int D>
CycleGraphs<D>::Graphs& CycleGraphs<D>::graphs(int p) {
    const auto known = graphs_.find(p);
    if (known != graphs_.end()) return known->second;
    CycleListing cycle = coupling_cycle(model_, scene_.coupling, p);
    std::vector<tasks::Task>& last = cycle.iterated ? cycle.end : cycle.steps;
    for (tasks::Task& task : result_tasks(&results_, results_.diagnostics())) last.push_back(std::move(task));
    Graphs made{{}, {}, tasks::TaskGraph(std::move(cycle.steps), executor_, trace_)};
    if (cycle.iterated) {
        made.begin.emplace(std::move(cycle.begin), executor_, trace_);
        made.end.emplace(std::move(cycle.end), executor_, trace_);
    }
    cycles_[p] = 0;
    return graphs_.emplace(p, std::move(made)).first->second;
}

template <int D>
void CycleGraphs<D>::run() {
    const int p = ratio();
    Graphs& cycle = graphs(p);
    if (cycle.begin) {
        cycle.begin->run();
        run_trials(*model_.interface, model_.clock, [&steps = cycle.steps] { steps.run(); });
        cycle.end->run();
    } else {
        cycle.steps.run();
    }
    ++cycles_[p];
}

template <int D>
std::vector<PassTime> CycleGraphs<D>::passes() const {
    std::vector<PassTime> passes;
    std::map<std::string, std::size_t> place;
    const auto add = [&](const tasks::TaskGraph& graph) {
        for (std::size_t k = 0; k < graph.size(); ++k) {
            const std::string name = pass_name(graph.names()[k]);
            const auto [at, is_new] = place.try_emplace(name, passes.size());
            if (is_new) passes.push_back({.name = name, .family = family_of(name)});
            PassTime& pass = passes[at->second];
            const tasks::TaskStatistics statistics = graph.statistics(k);
            pass.calls += statistics.runs;
            pass.wall_seconds += statistics.wall_seconds;
            pass.busy_seconds += statistics.busy_seconds;
            if (name == "gradients" || name == "fluxes" || name == "interface loads")
                pass.pairs += double(statistics.work_items);
        }
    };
    for (const auto& [p, cycle] : graphs_) {
        if (cycle.begin) add(*cycle.begin);
        add(cycle.steps);
        if (cycle.end) add(*cycle.end);
    }
    return passes;
}

template class CycleGraphs<2>;
template class CycleGraphs<3>;

}  // namespace aquagraph::engine
