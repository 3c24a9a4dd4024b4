// What runs at the same time, and what does not.
#include <doctest/doctest.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <mutex>
#include <set>
#include <thread>

#include "tasks/parallel_loop.hpp"
#include "tasks/task_graph.hpp"
#include "tests/graph/waiting.hpp"

using namespace aquagraph::tasks;
using namespace aquagraph::tests;

TEST_CASE("tasks that share no data overlap") {
    for (const int threads : {2, 3}) {
        Executor executor(threads);
        std::atomic<int> arrived{0};
        std::atomic<int> met{0};
        const auto meet = [&] {
            ++arrived;
            if (comes_true([&] { return arrived == 2; })) ++met;
        };
        TaskGraph graph({{.name = "fluid", .writes = {"fluid"}, .body = meet},
                         {.name = "solid", .writes = {"solid"}, .body = meet}},
                        executor);
        graph.run();
        CHECK(met == 2);
    }
}

TEST_CASE("the blocks of a loop overlap, in a graph and outside of one") {
    Executor executor(2);
    std::atomic<int> arrived{0};
    std::atomic<int> met{0};
    const auto body = [&] {
        arrived = 0;
        for_each_block(2, [&](std::size_t) {
            ++arrived;
            if (comes_true([&] { return arrived == 2; })) ++met;
        });
    };
    TaskGraph graph({{.name = "fluxes", .writes = {"fluid"}, .body = body}}, executor);
    graph.run();
    CHECK(met == 2);
    executor.execute(body);
    CHECK(met == 4);
}

TEST_CASE("no more threads than asked for take part, and one thread means the calling one") {
    for (const int threads : {1, 2, 3}) {
        CAPTURE(threads);
        Executor executor(threads);
        CHECK(executor.threads() == threads);
        std::mutex mutex;
        std::set<std::thread::id> seen;
        std::atomic<int> inside{0};
        std::atomic<int> most{0};
        std::vector<Task> listing;
        for (int task = 0; task < 12; ++task)
            listing.push_back({.name = "task " + std::to_string(task), .body = [&] {
                                   for_each_block(16, [&](std::size_t) {
                                       const int now = ++inside;
                                       for (int old = most; old < now && !most.compare_exchange_weak(old, now);) {
                                       }
                                       {
                                           const std::scoped_lock lock(mutex);
                                           seen.insert(std::this_thread::get_id());
                                       }
                                       spin(Milliseconds(1));
                                       --inside;
                                   });
                               }});
        TaskGraph graph(listing, executor);
        graph.run();
        CHECK(most <= threads);
        if (threads == 1) {
            CHECK(seen == std::set<std::thread::id>{std::this_thread::get_id()});
        }
    }
}

namespace {

thread_local bool waits_in_loop = false;

// Three threads. Two hold one block each of the loop of "fluxes"; the third makes "solve" ready only then. The block
// on the thread that started the loop returns at once, the other is held: will the first take up "solve" meanwhile?
template <class Loop>
bool picks_up_the_solve(Executor& executor, Loop&& loop, Milliseconds hold) {
    std::atomic<int> blocks_taken{0};
    std::atomic<bool> picked_up{false};
    std::atomic<bool> loop_done{false};
    const auto fluxes = [&] {
        const std::thread::id owner = std::this_thread::get_id();
        waits_in_loop = true;
        loop([&](std::size_t) {
            ++blocks_taken;
            comes_true([&] { return blocks_taken == 2; });
            if (std::this_thread::get_id() != owner) comes_true([&] { return picked_up.load(); }, hold);
        });
        waits_in_loop = false;
        loop_done = true;
    };
    const auto gate = [&] { comes_true([&] { return blocks_taken == 2; }); };
    // Of the two tasks behind the gate its own thread takes one, and keeps it until the loop is done.
    const auto solve = [&] {
        if (waits_in_loop) {
            picked_up = true;
        } else {
            comes_true([&] { return picked_up || loop_done; });
        }
    };
    TaskGraph graph({{.name = "fluxes", .writes = {"fluid"}, .body = fluxes},
                     {.name = "gate", .writes = {"gate"}, .body = gate},
                     {.name = "solve 1", .reads = {"gate"}, .body = solve},
                     {.name = "solve 2", .reads = {"gate"}, .body = solve}},
                    executor);
    graph.run();
    return picked_up;
}

}  // namespace

TEST_CASE("a thread that waits in a loop takes no other task meanwhile") {
    Executor executor(3);
    for (int trial = 0; trial < 5; ++trial)
        CHECK_FALSE(picks_up_the_solve(
            executor, [](auto body) { for_each_block(2, body); }, Milliseconds(30)));
    // The loop of TBB as it is does: so the arrangement above can tell the difference.
    CHECK(picks_up_the_solve(
        executor, [](auto body) { tbb::parallel_for(std::size_t{0}, std::size_t{2}, body, tbb::simple_partitioner{}); },
        Milliseconds(20000)));
}
