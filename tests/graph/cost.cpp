// What a run costs by itself: allocations, which must be none of ours, and time, which is printed and not judged.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <new>

#include "tasks/parallel_loop.hpp"
#include "tasks/statistics.hpp"
#include "tasks/task_graph.hpp"
#include "tasks/trace.hpp"

namespace {
std::atomic<std::size_t> allocations{0};

void* counted(std::size_t bytes, std::size_t alignment) noexcept {
    ++allocations;
    if (alignment == 0) return std::malloc(bytes);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void* existing(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
}  // namespace

// TBB's own pools do not come here; everything else of the program does.
void* operator new(std::size_t bytes) {
    return existing(counted(bytes, 0));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    return counted(bytes, 0);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return existing(counted(bytes, static_cast<std::size_t>(alignment)));
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

using namespace aquagraph::tasks;

namespace {

std::vector<Task> chain(std::size_t tasks) {
    std::vector<Task> listing;
    for (std::size_t task = 0; task < tasks; ++task)
        listing.push_back({.name = "link " + std::to_string(task), .writes = {"x"}, .body = [] {}});
    return listing;
}

template <class Body>
double microseconds(int repetitions, Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    for (int repetition = 0; repetition < repetitions; ++repetition) body();
    const std::chrono::duration<double, std::micro> elapsed = std::chrono::steady_clock::now() - start;
    return elapsed.count() / repetitions;
}

}  // namespace

TEST_CASE("a run allocates nothing") {
    for (const int threads : {1, 2, 4}) {
        Executor executor(threads);
        Trace trace;
        std::vector<double> scratch(64);
        double total = 0;
        std::vector<Task> listing = chain(8);
        const auto body = [&] {
            const auto one = [](std::size_t) {
                report_work(1);
                return 1.0;
            };
            total += reduce_blocks(scratch.size(), 0.0, one, std::plus<>{}, std::span(scratch));
        };
        listing.push_back({.name = "sum", .reads = {"x"}, .body = body});
        for (Trace* const with : {static_cast<Trace*>(nullptr), &trace}) {
            TaskGraph graph(listing, executor, with);
            // A thread allocates its buffer of a trace when it records for the first time: all are to be there.
            std::atomic<int> arrived{0};
            TaskGraph meeting({{.name = "meeting",
                                .body =
                                    [&] {
                                        for_each_block(static_cast<std::size_t>(threads), [&](std::size_t) {
                                            ++arrived;
                                            while (arrived < threads) {
                                            }
                                        });
                                    }}},
                              executor, with);
            meeting.run();
            graph.run();
            const std::size_t before = allocations;
            for (int run = 0; run < 200; ++run) graph.run();
            CHECK(allocations - before == 0);
            CHECK(graph.statistics(8).work_items == 201 * 64);
        }
        CHECK(total == 2 * 201 * 64);
    }
}

TEST_CASE("the time of a run of 32 chained tasks") {
    for (const int threads : {1, 2}) {
        Executor executor(threads);
        Trace trace;
        TaskGraph plain(chain(32), executor);
        TaskGraph traced(chain(32), executor, &trace);
        const auto best = [](TaskGraph& graph, int repetitions) {
            double least = 1e9;
            for (int trial = 0; trial < 10; ++trial)
                least = std::min(least, microseconds(repetitions, [&] { graph.run(); }));
            return least;
        };
        best(plain, 100);
        const double reused = best(plain, 400);
        const double with_trace = best(traced, 400);  // fits into the buffers: 4000 runs, 128 000 events
        const double rebuilt = microseconds(200, [&] { TaskGraph(chain(32), executor).run(); });
        const double clock = microseconds(10000, [] { static_cast<void>(Trace::now()); });
        MESSAGE(threads << " thread(s): " << reused << " us a run, " << with_trace << " us with a trace, " << rebuilt
                        << " us built anew; reading the clock " << 1000 * clock << " ns");
        CHECK(plain.statistics(31).runs == plain.statistics(0).runs);
        CHECK(trace.dropped_count() == 0);
    }
}
