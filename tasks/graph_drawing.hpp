// A listing of tasks as a picture: text for Graphviz' dot.
#pragma once
#include <span>
#include <string>

#include "tasks/task.hpp"

namespace aquagraph::tasks {

struct DrawingOptions {
    std::string title{};
    bool groups = true;       // a frame around the tasks of a group
    bool edge_labels = true;  // the resources an edge stands for
};

// Nodes are the tasks in the order of the listing, coloured by family; edges are those of derive_edges: a solid line
// where data flows (read after write), a dashed one where a task waits only before it overwrites.
std::string to_dot(std::span<const Task> listing, const DrawingOptions& options = {});

}  // namespace aquagraph::tasks
