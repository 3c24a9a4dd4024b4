// Which task of a listing must wait for which, found from what they read and write.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tasks/task.hpp"

namespace aquagraph::tasks {

// Why the later task waits. A pair of tasks may have several reasons, one for each resource.
enum class HazardKind { read_after_write, write_after_read, write_after_write };

struct Hazard {
    HazardKind kind{};
    std::string resource{};  // the narrower of the two overlapping names
};

struct Edge {
    std::size_t from{};  // positions in the listing, from < to
    std::size_t to{};
    std::vector<Hazard> hazards{};  // never empty, as hazards_between returns them
};

// All reasons why `later` must not start before `earlier` has finished; empty if the two may run at the same time.
// Ordered by kind, and a resource appears once, with the first kind that applies.
std::vector<Hazard> hazards_between(const Task& earlier, const Task& later);

// The edges that order every pair of tasks with a hazard as in the listing, and none that follows from the others
// (the transitive reduction). Sorted by `to`, then by `from`.
std::vector<Edge> derive_edges(std::span<const Task> listing);

const char* to_string(HazardKind kind);  // "read after write", ...

}  // namespace aquagraph::tasks
