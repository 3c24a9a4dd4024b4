// What a task has cost so far, and how its body says how much work it did.
#pragma once
#include <cstdint>

namespace aquagraph::tasks {

struct TaskStatistics {
    std::uint64_t runs = 0;        // finished without an exception
    double wall_seconds = 0;       // from start to end of the body, summed over runs
    double busy_seconds = 0;       // time of all threads inside the body and its blocks; waiting in a loop not counted
    std::uint64_t work_items = 0;  // as reported by the body: pairs, elements, ...
};

// Adds to the work of the task whose body, or whose block of a parallel loop, calls it; thread-safe, one atomic
// addition: call it once per block or once per body. Outside of any task it does nothing.
void report_work(std::uint64_t items);

}  // namespace aquagraph::tasks
