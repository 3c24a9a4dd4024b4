// How the time of a task is collected while its body and its blocks run. Used by task_graph.cpp and parallel_loop.cpp
// only.
//
// Every thread has a stack of frames, one for the body or block it is in. Busy time is the time inside a frame minus
// the time inside the loops the frame has started: those loops' blocks have frames of their own, on whichever thread.
#pragma once
#include <atomic>
#include <cstdint>

#include "tasks/trace.hpp"

namespace aquagraph::tasks {

// Only the counters that threads add to at the same time are atomic; a graph runs a task on one thread at a time.
struct alignas(64) TaskRecord {
    std::atomic<std::int64_t> busy_nanoseconds{0};
    std::atomic<std::uint64_t> work_items{0};
    std::int64_t wall_nanoseconds = 0;
    std::uint64_t runs = 0;
    std::uint64_t attempts = 0;  // runs that ended in an exception counted too: the number of a run in a trace
    Trace* trace = nullptr;
    std::uint32_t event_name = 0;

    bool traces_blocks() const { return trace != nullptr && trace->records_blocks(); }
    void trace_interval(std::int64_t block, std::int64_t start, std::int64_t end) const noexcept {
        trace->record({event_name, attempts, block, start, end});
    }
};

struct Frame {
    TaskRecord* record = nullptr;
    std::int64_t nanoseconds_in_loops = 0;
};

// Null outside of tasks.
inline constinit thread_local Frame* current_frame = nullptr;

// Makes a frame the current one while it lives and adds its busy time to the task when it ends, however it ends.
class FrameScope {
  public:
    explicit FrameScope(TaskRecord& record) : frame_{&record}, outer_(current_frame), start_(Trace::now()) {
        current_frame = &frame_;
    }
    FrameScope(const FrameScope&) = delete;
    FrameScope& operator=(const FrameScope&) = delete;

  protected:
    // Returns when it ended, so that no clock is read twice.
    std::int64_t close() {
        const std::int64_t end = Trace::now();
        current_frame = outer_;
        frame_.record->busy_nanoseconds.fetch_add(end - start_ - frame_.nanoseconds_in_loops,
                                                  std::memory_order_relaxed);
        return end;
    }
    ~FrameScope() = default;

    Frame frame_;
    Frame* outer_;
    std::int64_t start_;
};

class BodyScope : public FrameScope {
  public:
    explicit BodyScope(TaskRecord& record) : FrameScope(record) {}
    ~BodyScope() {
        const std::int64_t end = close();
        TaskRecord& record = *frame_.record;
        if (record.trace != nullptr) record.trace_interval(Trace::whole_task, start_, end);
        ++record.attempts;
        if (!finished_) return;
        record.wall_nanoseconds += end - start_;
        ++record.runs;
    }
    void finished() { finished_ = true; }

  private:
    bool finished_ = false;
};

class BlockScope : public FrameScope {
  public:
    BlockScope(TaskRecord& record, std::size_t block) : FrameScope(record), block_(block) {}
    ~BlockScope() {
        const std::int64_t end = close();
        if (frame_.record->traces_blocks())
            frame_.record->trace_interval(static_cast<std::int64_t>(block_), start_, end);
    }

  private:
    std::size_t block_;
};

// Around a loop, on the thread that starts it and waits for it.
class LoopScope {
  public:
    LoopScope() : frame_(current_frame), start_(frame_ == nullptr ? 0 : Trace::now()) {}
    ~LoopScope() {
        if (frame_ != nullptr) frame_->nanoseconds_in_loops += Trace::now() - start_;
    }
    LoopScope(const LoopScope&) = delete;
    LoopScope& operator=(const LoopScope&) = delete;

  private:
    Frame* frame_;
    std::int64_t start_;
};

}  // namespace aquagraph::tasks
