// A task: one step of the algorithm with the data it reads and writes. A listing of tasks, in the order in which a
// single thread would run them, is the documentation of a step; tasks/task_graph.hpp turns it into a graph.
//
// Resources are short dotted names ("fluid.gradients", "solid.loads"). They form a tree: "fluid" stands for all of
// "fluid.*", so the task that re-sorts the particles writes "fluid" and is ordered against everything of the fluid.
// Names are looked at when a graph is built, never while it runs.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace aquagraph::tasks {

struct Task {
    std::string name{};                 // "fluxes (stage 2)": what reports, traces and error messages call it
    std::vector<std::string> reads{};   // resources whose values the body needs
    std::vector<std::string> writes{};  // resources it changes; what it updates in place is named here only once
    std::function<void()> body{};       // may use parallel_loop and report_work; may throw
    std::string group{};                // optional: "substep 3"; drawn as a frame around its tasks
};

// The first word of a task's name, "fluxes" for "fluxes (stage 2)" and "newton" for "newton: solve".
// Tasks of one family share a colour in drawings and a category in traces. The view points into name.
std::string_view family_of(std::string_view name);

// True if the names stand for overlapping data: they are equal, or one is a part of the other ("fluid",
// "fluid.density").
bool overlap(std::string_view resource, std::string_view other);

}  // namespace aquagraph::tasks
