// When every task ran on which thread, as a file for chrome://tracing or ui.perfetto.dev.
#pragma once
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

namespace aquagraph::tasks {

// Hand one to the graphs that shall be recorded. Each thread writes to a buffer of its own, allocated when it records
// its first event; a full buffer takes no more events, and the file then says how many are missing.
class Trace {
  public:
    static constexpr std::size_t default_capacity = std::size_t{1} << 17;  // events of a thread, 40 bytes each

    struct Options {
        std::size_t events_per_thread = default_capacity;
        bool blocks = true;  // record the blocks of parallel loops too
    };

    Trace();
    explicit Trace(Options options);
    ~Trace();
    Trace(const Trace&) = delete;
    Trace& operator=(const Trace&) = delete;

    // One finished interval. `name` comes from name_of_events, times from now(). Thread-safe.
    static constexpr std::int64_t whole_task = -1;
    struct Event {
        std::uint32_t name = 0;
        std::uint64_t run = 0;            // how often the task had run before
        std::int64_t block = whole_task;  // or the number of a block of one of its loops
        std::int64_t start = 0;
        std::int64_t end = 0;
    };
    std::uint32_t name_of_events(std::string_view name);  // allocates: when a graph is built, not when it runs
    void record(const Event& event) noexcept;
    bool records_blocks() const noexcept;

    static std::int64_t now() noexcept;  // nanoseconds of a steady clock

    // Call these while no graph runs.
    std::size_t event_count() const;
    std::size_t dropped_count() const;
    void write(std::ostream& out) const;
    void write(const std::string& path) const;  // throws std::runtime_error if the file cannot be written

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace aquagraph::tasks
