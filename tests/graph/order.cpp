// Random listings, run thousands of times on 1 to 8 threads: nothing starts early, nothing overlaps that shares data,
// and the data end up as if the listing had been run from top to bottom.
#include <doctest/doctest.h>

#include <atomic>
#include <map>
#include <thread>

#include "tasks/task_graph.hpp"
#include "tests/graph/random_listing.hpp"

using namespace aquagraph::tasks;
using aquagraph::tests::any_overlap;
using aquagraph::tests::must_stay_in_order;
using aquagraph::tests::random_listing;

namespace {

// A listing whose bodies watch each other. Everything a body writes is either atomic or protected by the graph.
class WatchedListing {
  public:
    WatchedListing(std::mt19937& random, std::size_t tasks, std::size_t resources)
        : listing_(random_listing(random, tasks, resources)), watches_(tasks) {
        // One value for each field; a family stands for those of its fields.
        for (const Task& task : listing_)
            for (const auto* names : {&task.reads, &task.writes})
                for (const std::string& name : *names)
                    if (name.find('.') != std::string::npos) values_[name] = 1;
        for (std::size_t task = 0; task < tasks; ++task) {
            for (std::size_t other = 0; other < tasks; ++other) {
                const std::size_t first = std::min(task, other);
                const std::size_t second = std::max(task, other);
                if (first == second || !must_stay_in_order(listing_[first], listing_[second])) continue;
                (other < task ? watches_[task].before : watches_[task].after).push_back(other);
            }
            for (auto& [name, value] : values_) {
                if (any_overlap({name}, listing_[task].reads)) watches_[task].inputs.push_back(&value);
                if (any_overlap({name}, listing_[task].writes)) watches_[task].outputs.push_back(&value);
            }
            listing_[task].body = [this, task] { run(task); };
        }
    }

    const std::vector<Task>& listing() const { return listing_; }
    void begin_run() { ++run_; }
    std::size_t violations() const { return violations_; }
    bool all_ran() const {
        for (const Watch& watch : watches_)
            if (watch.finished != run_ || watch.started != run_) return false;
        return true;
    }
    std::map<std::string, std::uint64_t>& values() { return values_; }

  private:
    struct Watch {
        std::vector<std::size_t> before, after;
        std::vector<std::uint64_t*> inputs, outputs;
        std::atomic<int> started{0}, finished{0};
    };

    void run(std::size_t task) {
        Watch& watch = watches_[task];
        if (watch.started.exchange(run_) == run_) ++violations_;
        for (const std::size_t other : watch.before)
            if (watches_[other].finished != run_) ++violations_;
        std::uint64_t hash = task + 1;
        for (const std::uint64_t* input : watch.inputs) hash = (hash ^ *input) * 0x9E3779B97F4A7C15U;
        if (hash % 3 == 0) std::this_thread::yield();
        for (std::uint64_t* output : watch.outputs) *output = *output * 31 + hash;
        for (const std::size_t other : watch.after)
            if (watches_[other].started == run_) ++violations_;
        watch.finished = run_;
    }

    std::vector<Task> listing_;
    std::vector<Watch> watches_;
    std::map<std::string, std::uint64_t> values_;
    int run_ = 0;
    std::atomic<std::size_t> violations_{0};
};

}  // namespace

TEST_CASE("random listings keep their order on any number of threads") {
    for (int threads = 1; threads <= 8; ++threads) {
        CAPTURE(threads);
        Executor executor(threads);
        std::mt19937 random(static_cast<unsigned>(1000 + threads));
        for (int trial = 0; trial < 10; ++trial) {
            WatchedListing watched(random, 4 + random() % 30, 3 + random() % 14);
            TaskGraph graph(watched.listing(), executor);
            const auto initial = watched.values();
            constexpr int runs = 60;
            for (int run = 0; run < runs; ++run) {
                watched.begin_run();
                graph.run();
                REQUIRE(watched.all_ran());
            }
            REQUIRE(watched.violations() == 0);
            const auto parallel = watched.values();
            for (auto& [name, value] : watched.values()) value = initial.at(name);  // bodies point to them
            for (int run = 0; run < runs; ++run) {
                watched.begin_run();
                graph.run_in_listing_order();
            }
            REQUIRE(watched.values() == parallel);
        }
    }
}

TEST_CASE("an empty graph runs") {
    Executor executor(2);
    TaskGraph graph({}, executor);
    graph.run();
    CHECK(graph.size() == 0);
    CHECK(graph.statistics().empty());
}

TEST_CASE("a graph that has moved still runs") {
    Executor executor(2);
    int count = 0;
    TaskGraph first({{.name = "count", .writes = {"x"}, .body = [&] { ++count; }}}, executor);
    first.run();
    TaskGraph second = std::move(first);
    second.run();
    CHECK(count == 2);
    CHECK(second.statistics(0).runs == 2);
    CHECK(second.names()[0] == "count");
}

TEST_CASE("a task without a name or a body is refused") {
    Executor executor(1);
    CHECK_THROWS_WITH_AS(TaskGraph({{.name = "fluxes"}}, executor), "task 'fluxes' has no body", std::invalid_argument);
    CHECK_THROWS_WITH_AS(TaskGraph({{.body = [] {}}}, executor), "task 1 of the listing has no name",
                         std::invalid_argument);
    CHECK_THROWS_AS(Executor(-1), std::invalid_argument);
}
