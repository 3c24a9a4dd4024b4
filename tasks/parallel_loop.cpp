#include "tasks/parallel_loop.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "tasks/measurement.hpp"

namespace aquagraph::tasks {

namespace {

void run_inline(std::size_t blocks, BlockBody body, TaskRecord* record) {
    // The frame of the body already measures this thread; only a trace wants to know about blocks.
    if (record == nullptr || !record->traces_blocks()) return serial_loop(blocks, body);
    for (std::size_t block = 0; block < blocks; ++block) {
        const LoopScope as_loop;
        const BlockScope scope(*record, block);
        body(block);
    }
}

}  // namespace

void ParallelLoop::operator()(std::size_t blocks, BlockBody body) const {
    TaskRecord* const record = current_frame == nullptr ? nullptr : current_frame->record;
    if (blocks <= 1 || tbb::this_task_arena::max_concurrency() == 1) return run_inline(blocks, body, record);

    const LoopScope loop;
    const auto run_range = [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t block = range.begin(); block != range.end(); ++block) {
            if (record == nullptr) {
                body(block);
            } else {
                const BlockScope scope(*record, block);
                body(block);
            }
        }
    };
    tbb::this_task_arena::isolate([&] {
        // A context of its own: when another task fails, the graph's context is cancelled, and with it every loop
        // bound to it would return with blocks left out, to a body that takes the loop for done.
        tbb::task_group_context context(tbb::task_group_context::isolated);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1), run_range, tbb::simple_partitioner{}, context);
    });
}

}  // namespace aquagraph::tasks
