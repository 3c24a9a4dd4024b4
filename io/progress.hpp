// One line that says how far a run is. The only part of this library that prints.
#pragma once
#include <chrono>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

namespace aquagraph::io {

struct ProgressState {
    double time = 0;           // simulated [s]
    long long step = 0;        // fluid steps so far
    double step_size = 0;      // [s]
    std::string_view limiter;  // what limits it: "sound speed", "solid"
};

class Progress {
  public:
    using Clock = std::function<std::chrono::duration<double>()>;

    // On a terminal the line is rewritten in place at most 5 times a second; elsewhere a plain line is written at most
    // every 10 s. start_time: where a resumed run starts [s], for the estimate of the time left.
    Progress(std::ostream& out, bool terminal, double end_time, double start_time = 0, Clock clock = {});

    static bool is_terminal(int file_descriptor);

    void update(const ProgressState& state);
    // Writes the last state whatever the time since the last line, and ends the line. Without an update before:
    // nothing.
    void finish();

  private:
    void write(const ProgressState& state, double now);

    std::ostream& out_;
    bool terminal_;
    double end_time_, start_time_;
    Clock clock_;
    double begun_ = 0, written_ = 0;
    bool any_ = false, written_current_ = false;
    ProgressState last_{};
    std::string last_limiter_;
    std::size_t width_ = 0;
};

}  // namespace aquagraph::io
