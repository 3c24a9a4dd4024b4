#include "io/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace aquagraph::io {
namespace {

constexpr double terminal_period = 0.2, plain_period = 10;  // [s]

std::string duration_text(double seconds) {
    if (!std::isfinite(seconds)) return "–";
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    if (whole < 48 * 3600) return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
    return fmt::format("{:.1f} days", seconds / 86400);
}

std::size_t width_on_screen(std::string_view text) {
    std::size_t width = 0;
    for (const char c : text) width += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    return width;
}

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, double end_time, double start_time, Clock clock)
    : out_(out), terminal_(terminal), end_time_(end_time), start_time_(start_time), clock_(std::move(clock)) {
    if (!clock_)
        clock_ = [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()); };
    begun_ = written_ = clock_().count();
}

bool Progress::is_terminal(int file_descriptor) {
    return isatty(file_descriptor) != 0;
}

void Progress::update(const ProgressState& state) {
    last_ = state;
    last_limiter_ = state.limiter;
    last_.limiter = last_limiter_;
    written_current_ = false;
    const double now = clock_().count(), period = terminal_ ? terminal_period : plain_period;
    // On a terminal the first step shows at once; a log need not begin with it.
    if (now - written_ >= period || (terminal_ && !any_)) write(last_, now);
    any_ = true;
}

void Progress::finish() {
    if (!any_) return;
    if (!written_current_) write(last_, clock_().count());
    if (terminal_) out_ << '\n' << std::flush;
    any_ = false;
}

void Progress::write(const ProgressState& state, double now) {
    const double done = state.time - start_time_, all = end_time_ - start_time_;
    const double left = done > 0 ? (now - begun_) * (all - done) / done : INFINITY;
    std::string line = fmt::format("t = {:.5g} s of {:.5g} ({:.0f} %), step {}, Δt = {:.3g} s", state.time, end_time_,
                                   all > 0 ? std::floor(100 * done / all) : 100, state.step, state.step_size);
    if (!state.limiter.empty()) line += fmt::format(" ({})", state.limiter);
    line += state.time >= end_time_ ? fmt::format(", took {}", duration_text(now - begun_))
                                    : fmt::format(", {} left", duration_text(left));
    if (terminal_) {
        const std::size_t width = width_on_screen(line);
        out_ << '\r' << line << std::string(width < width_ ? width_ - width : 0, ' ') << std::flush;
        width_ = width;
    } else {
        out_ << line << '\n' << std::flush;
    }
    written_ = now;
    written_current_ = true;
}

}  // namespace aquagraph::io
