// The graphs of a run: one per p, made when p is first met and kept, since making one costs more than running it.
#pragma once
#include <map>
#include <optional>
#include <vector>

#include "engine/results.hpp"
#include "engine/summary.hpp"
#include "tasks/executor.hpp"
#include "tasks/task_graph.hpp"
#include "tasks/trace.hpp"

namespace aquagraph::engine {

template <int D>
class CycleGraphs {
  public:
    // All must outlive the graphs; trace may be null.
    CycleGraphs(Model<D>& model, const io::Scene& scene, Results<D>& results, tasks::Executor& executor,
                tasks::Trace* trace);

    // One coupling cycle, with the present p, and what is due of the results. Throws tasks::TaskError.
    void run();

    // What the tasks have cost, of all graphs together: tasks of one name, "fluxes (stage 2)", are one pass, "fluxes".
    std::vector<PassTime> passes() const;
    // Cycles made with each p.
    const std::map<int, long>& cycles() const { return cycles_; }

  private:
    struct Graphs {
        std::optional<tasks::TaskGraph> begin, end;  // around iterated steps
        tasks::TaskGraph steps;
    };
    int ratio() const { return model_.interface ? model_.interface->ratio.p : 1; }
    Graphs& graphs(int p);

    Model<D>& model_;
    const io::Scene& scene_;
    Results<D>& results_;
    tasks::Executor& executor_;
    tasks::Trace* trace_;
    std::map<int, Graphs> graphs_;
    std::map<int, long> cycles_;
};

}  // namespace aquagraph::engine
