#include <doctest/doctest.h>

#include <array>
#include <atomic>

#include "tasks/parallel_loop.hpp"
#include "tasks/task_graph.hpp"
#include "tests/graph/random_listing.hpp"
#include "tests/graph/waiting.hpp"

using namespace aquagraph::tasks;
using namespace aquagraph::tests;

namespace {

struct NegativeDensity : std::runtime_error {
    explicit NegativeDensity(int where) : std::runtime_error("the density is negative"), particle(where) {}
    int particle;
};

template <class Body>
std::string message_of(Body&& body) {
    try {
        body();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "no exception";
}

}  // namespace

TEST_CASE("the message names the task and the original can be had again") {
    for (const int threads : {1, 2, 4}) {
        Executor executor(threads);
        bool later_ran = false;
        TaskGraph graph({{.name = "gradients", .writes = {"gradients"}, .body = [] {}},
                         {.name = "fluxes (stage 2)",
                          .reads = {"gradients"},
                          .writes = {"rates"},
                          .body = [] { throw NegativeDensity(7); }},
                         {.name = "stage", .reads = {"rates"}, .body = [&] { later_ran = true; }}},
                        executor);
        CHECK(message_of([&] { graph.run(); }) == "in task 'fluxes (stage 2)': the density is negative");
        CHECK(message_of([&] { graph.run_in_listing_order(); }) ==
              "in task 'fluxes (stage 2)': the density is negative");
        CHECK_FALSE(later_ran);
        try {
            graph.run();
        } catch (const TaskError& error) {
            CHECK(error.task() == "fluxes (stage 2)");
            CHECK_THROWS_AS(std::rethrow_exception(error.cause()), NegativeDensity);
            try {
                error.rethrow_nested();
            } catch (const NegativeDensity& original) {
                CHECK(original.particle == 7);
            }
            CHECK_THROWS_AS(std::rethrow_if_nested(error), NegativeDensity);
        }
        CHECK(graph.statistics(0).runs == 3);
        CHECK(graph.statistics(1).runs == 0);
    }
}

TEST_CASE("causes, groups and exceptions of unknown type appear in the message") {
    Executor executor(2);
    const auto solve = [] {
        try {
            throw std::runtime_error("the matrix is singular");
        } catch (...) {
            std::throw_with_nested(std::runtime_error("no convergence"));
        }
    };
    TaskGraph nested({{.name = "newton", .body = solve, .group = "substep 3"}}, executor);
    CHECK(message_of([&] { nested.run(); }) == "in task 'newton, substep 3': no convergence: the matrix is singular");

    TaskGraph unknown({{.name = "odd", .body = [] { throw 42; }}}, executor);
    CHECK(message_of([&] { unknown.run(); }) == "in task 'odd': an exception of unknown type");
    try {
        unknown.run();
    } catch (const TaskError& error) {
        CHECK_THROWS_AS(error.rethrow_nested(), int);
    }

    TaskGraph inner({{.name = "inner", .body = [] { throw std::runtime_error("lost"); }}}, executor);
    CHECK(message_of([&] { TaskGraph({{.name = "outer", .body = [&] { inner.run(); }}}, executor).run(); }) ==
          "in task 'outer': in task 'inner': lost");
}

TEST_CASE("a block that throws fails its task") {
    for (const int threads : {1, 2, 4}) {
        Executor executor(threads);
        bool after_loop = false;
        const auto body = [&] {
            for_each_block(64, [](std::size_t block) {
                if (block == 40) throw NegativeDensity(40);
            });
            after_loop = true;
        };
        TaskGraph graph({{.name = "fluxes", .body = body}}, executor);
        CHECK(message_of([&] { graph.run(); }) == "in task 'fluxes': the density is negative");
        CHECK_FALSE(after_loop);
        CHECK_THROWS_AS(executor.execute(body), NegativeDensity);
    }
}

TEST_CASE("after a failure a graph runs as if nothing had happened") {
    for (const int threads : {1, 2, 4}) {
        Executor executor(threads);
        std::mt19937 random(static_cast<unsigned>(threads));
        for (int trial = 0; trial < 20; ++trial) {
            std::vector<Task> listing = random_listing(random, 20, 8);
            std::array<std::atomic<int>, 20> ran{};
            std::atomic<int> early{0};
            std::atomic<std::size_t> failing{listing.size()};
            std::vector<std::vector<std::size_t>> before(listing.size());
            for (std::size_t task = 0; task < listing.size(); ++task) {
                for (std::size_t other = 0; other < task; ++other)
                    if (must_stay_in_order(listing[other], listing[task])) before[task].push_back(other);
                listing[task].body = [&, task] {
                    if (task == failing) throw NegativeDensity(static_cast<int>(task));
                    for (const std::size_t other : before[task])
                        if (ran[other] == 0) ++early;
                    ++ran[task];
                };
            }
            TaskGraph graph(listing, executor);
            for (int run = 0; run < 20; ++run) {
                for (auto& count : ran) count = 0;
                failing = random() % listing.size();
                CHECK_THROWS_AS(graph.run(), TaskError);
                CHECK(ran[failing] == 0);
                failing = listing.size();
                for (auto& count : ran) count = 0;
                graph.run();
                for (const auto& count : ran) REQUIRE(count == 1);
            }
            REQUIRE(early == 0);
        }
    }
}

TEST_CASE("a loop is not cut short because another task has failed") {
    Executor executor(2);
    std::atomic<bool> started{false};
    std::atomic<bool> about_to_throw{false};
    std::atomic<int> blocks{0};
    int seen_after_loop = 0;
    const auto fluxes = [&] {
        started = true;
        comes_true([&] { return about_to_throw.load(); });
        std::this_thread::sleep_for(Milliseconds(30));  // time for the failure to reach the graph
        for_each_block(64, [&](std::size_t) { ++blocks; });
        seen_after_loop = blocks;
    };
    const auto solve = [&] {
        comes_true([&] { return started.load(); });
        about_to_throw = true;
        throw std::runtime_error("no convergence");
    };
    TaskGraph graph({{.name = "fluxes", .writes = {"fluid"}, .body = fluxes},
                     {.name = "newton", .writes = {"solid"}, .body = solve}},
                    executor);
    CHECK(message_of([&] { graph.run(); }) == "in task 'newton': no convergence");
    CHECK(seen_after_loop == 64);
}
