#include "tasks/statistics.hpp"

#include <doctest/doctest.h>

#include "tasks/parallel_loop.hpp"
#include "tasks/task_graph.hpp"
#include "tasks/trace.hpp"
#include "tests/graph/waiting.hpp"

using namespace aquagraph::tasks;
using namespace aquagraph::tests;

TEST_CASE("runs, time and reported work add up over runs and blocks") {
    for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        Executor executor(threads);
        const auto loop = [] {
            for_each_block(8, [](std::size_t block) {
                spin(Milliseconds(2));
                report_work(block);
            });
            report_work(100);
        };
        TaskGraph graph({{.name = "fluxes", .writes = {"x"}, .body = loop},
                         {.name = "stage", .reads = {"x"}, .body = [] { spin(Milliseconds(3)); }}},
                        executor);
        graph.run();
        graph.run();
        const TaskStatistics fluxes = graph.statistics(0);
        CHECK(fluxes.runs == 2);
        CHECK(fluxes.work_items == 2 * (28 + 100));
        CHECK(fluxes.busy_seconds >= 2 * 8 * 0.002);
        CHECK(fluxes.busy_seconds <= fluxes.wall_seconds * threads * (1 + 1e-12));
        const TaskStatistics stage = graph.statistics(1);
        CHECK(stage.runs == 2);
        CHECK(stage.work_items == 0);
        CHECK(stage.wall_seconds >= 2 * 0.003);
        CHECK(stage.busy_seconds == doctest::Approx(stage.wall_seconds).epsilon(1e-12));

        graph.reset_statistics();
        CHECK(graph.statistics(0).runs == 0);
        CHECK(graph.statistics(0).busy_seconds == 0);
        CHECK(graph.statistics(0).wall_seconds == 0);
        CHECK(graph.statistics(0).work_items == 0);
    }
}

TEST_CASE("nested loops count no time twice") {
    for (const int threads : {1, 2, 4})
        for (const bool traced : {false, true}) {
            CAPTURE(threads);
            Executor executor(threads);
            Trace trace;
            const auto body = [] {
                for_each_block(3, [](std::size_t) {
                    for_each_block(3, [](std::size_t) { spin(Milliseconds(1)); });
                    spin(Milliseconds(1));
                });
            };
            TaskGraph graph({{.name = "assembly", .body = body}}, executor, traced ? &trace : nullptr);
            graph.run();
            const TaskStatistics cost = graph.statistics(0);
            CHECK(cost.busy_seconds >= 0.012);
            CHECK(cost.busy_seconds <= cost.wall_seconds * threads * (1 + 1e-12));
        }
}

TEST_CASE("waiting for the last block is not busy time") {
    Executor executor(2);
    std::atomic<int> taken{0};
    const auto body = [&] {
        for_each_block(2, [&](std::size_t block) {
            ++taken;
            comes_true([&] { return taken == 2; });
            if (block == 0) spin(Milliseconds(300));
        });
    };
    TaskGraph graph({{.name = "uneven", .body = body}}, executor);
    graph.run();
    CHECK(graph.statistics(0).busy_seconds < 1.5 * graph.statistics(0).wall_seconds);
}

TEST_CASE("work reported outside of a task is ignored") {
    report_work(5);
    Executor executor(2);
    executor.execute([] { for_each_block(4, [](std::size_t) { report_work(1); }); });
    TaskGraph graph({{.name = "idle", .body = [] {}}}, executor);
    graph.run();
    CHECK(graph.statistics(0).work_items == 0);
}
