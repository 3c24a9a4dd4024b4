#include "tasks/trace.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tasks/parallel_loop.hpp"
#include "tasks/task_graph.hpp"

using namespace aquagraph::tasks;

namespace {

struct Interval {
    std::string name;
    long long run, block, start, end;
};

long long nanoseconds(const nlohmann::json& microseconds) {
    return std::llround(1000 * microseconds.get<double>());
}

nlohmann::json parsed(const Trace& trace) {
    std::ostringstream text;
    trace.write(text);
    return nlohmann::json::parse(text.str());
}

// By thread, in the order of the file.
std::map<int, std::vector<Interval>> intervals(const nlohmann::json& file) {
    std::map<int, std::vector<Interval>> result;
    for (const auto& event : file.at("traceEvents")) {
        if (event.at("ph") != "X") continue;
        const long long start = nanoseconds(event.at("ts"));
        result[event.at("tid").get<int>()].push_back(
            {event.at("name").get<std::string>(), event.at("args").at("run").get<long long>(),
             event.at("args").value("block", -1LL), start, start + nanoseconds(event.at("dur"))});
    }
    return result;
}

}  // namespace

TEST_CASE("a trace holds every run of every task, and its times are nested") {
    for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        Executor executor(threads);
        Trace trace;
        const auto nested_loops = [] { for_each_block(6, [](std::size_t) { for_each_block(2, [](std::size_t) {}); }); };
        const std::vector<Task> listing = {{.name = "gradients", .writes = {"fluid.gradients"}, .body = nested_loops},
                                           {.name = "newton \"solid\"", .writes = {"solid"}, .body = [] {}},
                                           {.name = "fluxes", .reads = {"fluid.gradients"}, .body = nested_loops}};
        TaskGraph graph(listing, executor, &trace);
        constexpr int runs = 25;
        for (int run = 0; run < runs; ++run) graph.run();

        const nlohmann::json file = parsed(trace);
        std::set<int> named_threads;
        for (const auto& event : file.at("traceEvents"))
            if (event.at("name") == "thread_name") named_threads.insert(event.at("tid").get<int>());
        CHECK(file.at("otherData").at("dropped_events") == 0);
        CHECK_FALSE(file.at("otherData").contains("note"));
        CHECK(trace.event_count() == runs * (3 + 2 * (6 + 6 * 2)));

        std::map<std::string, std::map<long long, Interval>> bodies;
        const auto by_thread = intervals(file);
        for (const auto& [thread, events] : by_thread) {
            CHECK(named_threads.count(thread) == 1);
            for (const Interval& event : events)
                if (event.block < 0) CHECK(bodies[event.name].emplace(event.run, event).second);
        }
        CHECK(bodies.size() == listing.size());
        for (const auto& [name, of_task] : bodies) {
            CHECK(of_task.size() == runs);
            CHECK(of_task.rbegin()->first == runs - 1);
        }
        for (long long run = 0; run < runs; ++run)
            CHECK(bodies.at("gradients").at(run).end <= bodies.at("fluxes").at(run).start);

        for (const auto& [thread, events] : by_thread) {
            std::vector<Interval> open;
            for (const Interval& event : events) {
                while (!open.empty() && open.back().end <= event.start) open.pop_back();
                if (!open.empty()) REQUIRE(event.end <= open.back().end);
                open.push_back(event);
                if (event.block < 0) continue;
                const Interval& body = bodies.at(event.name).at(event.run);
                REQUIRE(body.start <= event.start);
                REQUIRE(event.end <= body.end);
            }
        }
    }
}

TEST_CASE("blocks can be left out") {
    Executor executor(2);
    Trace trace({.events_per_thread = 1000, .blocks = false});
    TaskGraph graph({{.name = "fluxes", .body = [] { for_each_block(8, [](std::size_t) {}); }}}, executor, &trace);
    graph.run();
    CHECK(trace.event_count() == 1);
}

TEST_CASE("a full buffer keeps what it has and the file says what is missing") {
    Executor executor(1);
    Trace trace({.events_per_thread = 10, .blocks = true});
    TaskGraph graph({{.name = "stage", .body = [] {}}}, executor, &trace);
    for (int run = 0; run < 25; ++run) graph.run();
    CHECK(trace.event_count() == 10);
    CHECK(trace.dropped_count() == 15);
    const nlohmann::json file = parsed(trace);
    CHECK(file.at("otherData").at("dropped_events") == 15);
    CHECK(file.at("otherData").at("note").get<std::string>() ==
          "The buffer of a thread was full: 15 later events are missing. Each thread keeps 10 events.");
    CHECK(intervals(file).at(0).back().run == 9);
}

TEST_CASE("graphs share a trace and may be gone when it is written") {
    Executor executor(2);
    Trace trace;
    for (const char* name : {"first", "second", "first"})
        TaskGraph({{.name = name, .body = [] {}}}, executor, &trace).run();
    std::multiset<std::string> names;
    for (const auto& [thread, events] : intervals(parsed(trace)))
        for (const Interval& event : events) names.insert(event.name);
    CHECK(names == std::multiset<std::string>{"first", "first", "second"});
}

TEST_CASE("a task that fails is recorded too") {
    Executor executor(2);
    Trace trace;
    TaskGraph graph({{.name = "newton", .body = [] { throw std::runtime_error("no convergence"); }}}, executor, &trace);
    CHECK_THROWS_AS(graph.run(), TaskError);
    CHECK(trace.event_count() == 1);
}

TEST_CASE("a trace that cannot be written says so") {
    CHECK_THROWS_AS(Trace().write("/no/such/folder/trace.json"), std::runtime_error);
}
