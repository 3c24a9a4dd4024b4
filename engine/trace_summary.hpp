// What a trace says about how well fluid and solid overlap: which part of the solid's time is hidden behind the fluid,
// how long each thread had nothing to do, and how far a coupling cycle is from the shortest it could be.
#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace aquagraph::engine {

struct TraceSummary {
    struct Thread {
        std::string name;
        double busy = 0, waiting = 0, idle = 0;  // [s]; waiting: inside a task, for blocks that other threads run
    };
    std::vector<Thread> threads;  // those that did anything
    double wall = 0;              // from the first event to the last [s]
    std::size_t cycles = 0;       // between exchanges, the first one left out
    double solid = 0,
           hidden = 0;  // of all solves: their time, and that in which another thread worked on the fluid [s]
    // Means of a cycle [s]: its length; the work of all threads; the chain of tasks of the fluid and the solve, each
    // with as many threads as it likes (its own part and its longest block).
    double cycle = 0, work = 0, fluid_chain = 0, solve_chain = 0;
    bool side_by_side = false;  // solves begin before the loads of their cycle are known
    std::size_t dropped = 0;    // events that the trace lacks

    double critical_path() const;
    double bound() const;  // max(critical path, work / threads)
};

// Throws std::runtime_error for a file that is not a trace of this program, std::system_error where it cannot be read.
TraceSummary summarise_trace(const std::filesystem::path& file);
void print(const TraceSummary& summary, std::ostream& out);

}  // namespace aquagraph::engine
