// A listing of tasks as a graph that runs in parallel, built once and run many times.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tasks/dependencies.hpp"
#include "tasks/executor.hpp"
#include "tasks/statistics.hpp"
#include "tasks/task.hpp"
#include "tasks/task_error.hpp"

namespace aquagraph::tasks {

class Trace;

// Guarantees:
//  - a task starts only after every earlier task of the listing has finished with which it shares data that one of
//    the two writes; so the result is that of running the listing from top to bottom. Other tasks may overlap.
//  - run() makes no allocation of its own.
//  - if a body throws, tasks that are running finish, no further one starts, run() throws a TaskError for the first
//    exception, and the graph can be run again.
// One run at a time: run() must not be called while it runs, nor from one of its own bodies.
class TaskGraph {
  public:
    // Throws std::invalid_argument for a task without a name or a body. The executor and the trace, if any, must
    // outlive the graph. With a trace, every execution of a task and of a block of its loops is recorded.
    TaskGraph(std::vector<Task> listing, Executor& executor, Trace* trace = nullptr);
    ~TaskGraph();
    TaskGraph(TaskGraph&&) noexcept;
    TaskGraph& operator=(TaskGraph&&) noexcept;

    void run();
    // The same bodies on the calling thread in the order of the listing: the reference for tests.
    void run_in_listing_order();

    std::size_t size() const;               // number of tasks
    std::span<const Task> listing() const;  // as handed in
    std::span<const std::string> names() const;
    std::span<const Edge> edges() const;

    TaskStatistics statistics(std::size_t task) const;  // not while the graph runs
    std::vector<TaskStatistics> statistics() const;
    void reset_statistics();

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace aquagraph::tasks
