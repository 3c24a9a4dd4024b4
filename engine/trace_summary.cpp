#include "engine/trace_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <system_error>

namespace aquagraph::engine {

namespace {

constexpr std::string_view solve_name = "FE Newton solve", exchange_name = "exchange", loads_name = "interface loads";

struct Interval {
    double begin, end;
};
using Intervals = std::vector<Interval>;

// Sorted and without overlaps.
Intervals merged(Intervals all) {
    std::sort(all.begin(), all.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
    Intervals made;
    for (const Interval& i : all) {
        if (!made.empty() && i.begin <= made.back().end)
            made.back().end = std::max(made.back().end, i.end);
        else
            made.push_back(i);
    }
    return made;
}

double length(const Intervals& merged) {
    double sum = 0;
    for (const Interval& i : merged) sum += i.end - i.begin;
    return sum;
}

// Of `a` what lies in `b`, and what does not; both merged.
Intervals common(const Intervals& a, const Intervals& b) {
    Intervals made;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const double begin = std::max(a[i].begin, b[j].begin), end = std::min(a[i].end, b[j].end);
        if (begin < end) made.push_back({begin, end});
        a[i].end < b[j].end ? ++i : ++j;
    }
    return made;
}
Intervals without(const Intervals& a, const Intervals& b) {
    Intervals made;
    std::size_t j = 0;
    for (Interval rest : a) {
        while (j > 0 && b[j - 1].end > rest.begin) --j;
        for (; j < b.size() && b[j].begin < rest.end; ++j) {
            if (b[j].end <= rest.begin) continue;
            if (b[j].begin > rest.begin) made.push_back({rest.begin, b[j].begin});
            rest.begin = std::max(rest.begin, b[j].end);
        }
        if (rest.begin < rest.end) made.push_back(rest);
    }
    return made;
}

struct Block {
    int thread;
    Interval at;
};
struct TaskRun {
    int thread;
    Interval at;
    std::vector<Block> blocks;
};

struct Trace {
    std::map<std::string, std::vector<TaskRun>> tasks;
    std::map<int, std::string> thread_names;
    std::size_t dropped = 0;
};

// One event a line, as this program writes them.
Trace read(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::system_error(errno, std::generic_category(), "cannot read " + file.string());
    const auto refuse = [&](const std::string& why) {
        throw std::runtime_error(file.string() + " is not a trace of this program (" + why +
                                 "): give a file that `run --trace FILE` has written");
    };
    Trace trace;
    std::map<std::string, std::vector<Block>> blocks;
    std::string line;
    if (!std::getline(stream, line) || line.find("\"traceEvents\":[") == std::string::npos) refuse("no traceEvents");
    if (const std::size_t at = line.find("\"dropped_events\":"); at != std::string::npos)
        trace.dropped = std::stoul(line.substr(at + 17));
    while (std::getline(stream, line) && line != "]}") {
        if (line.starts_with(",")) line.erase(0, 1);
        if (line.ends_with(",")) line.pop_back();
        if (line.empty()) continue;
        try {
            const auto event = nlohmann::json::parse(line);
            const int thread = event.at("tid").get<int>();
            if (event.at("ph") == "M") {
                if (event.at("name") == "thread_name")
                    trace.thread_names[thread] = event.at("args").at("name").get<std::string>();
                continue;
            }
            const double begin = 1e-6 * event.at("ts").get<double>();
            const Interval at{begin, begin + 1e-6 * event.at("dur").get<double>()};
            const auto name = event.at("name").get<std::string>();
            if (event.at("cat") == "block")
                blocks[name].push_back({thread, at});
            else
                trace.tasks[name].push_back({thread, at, {}});
        } catch (const nlohmann::json::exception& error) {
            refuse(error.what());
        }
    }
    if (trace.tasks.empty()) refuse("no task in it");
    // Tasks of one name never run at the same time: a block belongs to the one that was running. Clocks of different
    // threads agree to well below a block.
    for (auto& [name, runs] : trace.tasks) {
        std::sort(runs.begin(), runs.end(), [](const TaskRun& a, const TaskRun& b) { return a.at.begin < b.at.begin; });
        for (const Block& block : blocks[name]) {
            const auto after = std::upper_bound(runs.begin(), runs.end(), block.at.begin,
                                                [](double time, const TaskRun& run) { return time < run.at.begin; });
            if (after != runs.begin()) std::prev(after)->blocks.push_back(block);
        }
    }
    return trace;
}

// A run of a task: what its own thread did besides blocks, and what it waited for.
struct Parts {
    Intervals own, waiting;
    double longest_block = 0, blocks = 0;
};
Parts parts_of(const TaskRun& run) {
    Parts parts;
    Intervals here, elsewhere;
    std::map<int, Intervals> by_thread;  // blocks of inner loops lie within those of outer ones
    for (const Block& block : run.blocks) {
        (block.thread == run.thread ? here : elsewhere).push_back(block.at);
        by_thread[block.thread].push_back(block.at);
        parts.longest_block = std::max(parts.longest_block, block.at.end - block.at.begin);
    }
    for (const auto& [thread, blocks] : by_thread) parts.blocks += length(merged(blocks));
    const Intervals gaps = without({run.at}, merged(here));
    parts.waiting = common(gaps, merged(elsewhere));
    parts.own = without(gaps, parts.waiting);
    return parts;
}

}  // namespace

double TraceSummary::critical_path() const {
    return side_by_side ? std::max(fluid_chain, solve_chain) : fluid_chain + solve_chain;
}

double TraceSummary::bound() const {
    return std::max(critical_path(), threads.empty() ? 0 : work / double(threads.size()));
}

TraceSummary summarise_trace(const std::filesystem::path& file) {
    const Trace trace = read(file);
    TraceSummary summary;
    summary.dropped = trace.dropped;

    // Cycles run from exchange to exchange; without a solid, from clock to clock.
    Intervals window{{1e300, -1e300}};
    const auto exchanges = trace.tasks.find(std::string(exchange_name));
    const auto clocks = std::find_if(trace.tasks.begin(), trace.tasks.end(),
                                     [](const auto& task) { return task.first.starts_with("clock"); });
    const auto marks = exchanges != trace.tasks.end() ? exchanges : clocks;
    if (marks != trace.tasks.end() && marks->second.size() > 1) {
        summary.cycles = marks->second.size() - 1;
        window = {{marks->second.front().at.end, marks->second.back().at.end}};
    } else {
        for (const auto& [name, runs] : trace.tasks) {
            window[0].begin = std::min(window[0].begin, runs.front().at.begin);
            window[0].end = std::max(window[0].end, runs.back().at.end);
        }
        summary.cycles = 1;
    }
    summary.wall = window[0].end - window[0].begin;

    std::map<int, Intervals> busy, waiting, fluid_busy;
    Intervals solves;
    const auto within = [&](const Interval& at) { return at.begin >= window[0].begin && at.end <= window[0].end; };
    double work = 0, fluid_chain = 0, solve_chain = 0;
    for (const auto& [name, runs] : trace.tasks) {
        const bool solve = name == solve_name;
        for (const TaskRun& run : runs) {
            if (!within(run.at)) continue;
            const Parts parts = parts_of(run);
            const auto add = [&](int thread, const Interval& at) {
                busy[thread].push_back(at);
                if (!solve) fluid_busy[thread].push_back(at);
            };
            for (const Interval& at : parts.own) add(run.thread, at);
            for (const Block& block : run.blocks) add(block.thread, block.at);
            waiting[run.thread].insert(waiting[run.thread].end(), parts.waiting.begin(), parts.waiting.end());
            work += length(parts.own) + parts.blocks;
            (solve ? solve_chain : fluid_chain) += length(parts.own) + parts.longest_block;
            if (solve) solves.push_back(run.at);
        }
    }
    Intervals all_fluid;
    for (auto& [thread, intervals] : fluid_busy) all_fluid.insert(all_fluid.end(), intervals.begin(), intervals.end());
    const Intervals of_solves = merged(solves);
    summary.solid = length(of_solves);
    summary.hidden = length(common(of_solves, merged(all_fluid)));
    for (auto& [thread, intervals] : busy) {
        const auto name = trace.thread_names.find(thread);
        TraceSummary::Thread one{name == trace.thread_names.end() ? std::to_string(thread) : name->second,
                                 length(merged(intervals)), length(merged(waiting[thread])), 0};
        one.idle = summary.wall - one.busy - one.waiting;
        summary.threads.push_back(one);
    }
    const double cycles = double(summary.cycles);
    summary.cycle = summary.wall / cycles;
    summary.work = work / cycles;
    summary.fluid_chain = fluid_chain / cycles;
    summary.solve_chain = solve_chain / cycles;
    // In every CPS cycle the solve may begin before the loads are known; in CSS it never does.
    const auto loads = trace.tasks.find(std::string(loads_name));
    const auto all_solves = trace.tasks.find(std::string(solve_name));
    if (loads != trace.tasks.end() && all_solves != trace.tasks.end()) {
        const std::size_t n = std::min(loads->second.size(), all_solves->second.size());
        for (std::size_t k = 0; k < n; ++k)
            summary.side_by_side = summary.side_by_side || all_solves->second[k].at.begin < loads->second[k].at.begin;
    }
    return summary;
}

void print(const TraceSummary& s, std::ostream& out) {
    const auto percent = [](double part, double whole) { return whole > 0 ? 100 * part / whole : 0; };
    out << fmt::format("{} cycles of {:.4g} ms\n", s.cycles, 1e3 * s.cycle);
    out << fmt::format("{:<12} {:>8} {:>9} {:>8}\n", "thread", "busy", "waiting", "idle");
    for (const TraceSummary::Thread& thread : s.threads)
        out << fmt::format("{:<12} {:>7.1f}% {:>8.1f}% {:>7.1f}%\n", thread.name, percent(thread.busy, s.wall),
                           percent(thread.waiting, s.wall), percent(thread.idle, s.wall));
    if (s.solid > 0)
        out << fmt::format("solid: {:.4g} ms a cycle, {:.1f} % of it hidden behind the fluid\n",
                           1e3 * s.solid / double(s.cycles), percent(s.hidden, s.solid));
    out << fmt::format(
        "shortest possible cycle: {:.4g} ms = max(critical path {:.4g} ms, work of all threads {:.4g} ms / "
        "{}); the cycle takes {:.3f} times that\n",
        1e3 * s.bound(), 1e3 * s.critical_path(), 1e3 * s.work, s.threads.size(),
        s.bound() > 0 ? s.cycle / s.bound() : 0);
    if (s.dropped > 0) out << fmt::format("the trace lacks its last {} events\n", s.dropped);
}

}  // namespace aquagraph::engine
