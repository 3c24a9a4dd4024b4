// Signals that ask a run to stop: Ctrl-C and SIGTERM interrupt it; SIGUSR1, as batch systems send before time is up,
// ends it with an exit code of its own. All leave a checkpoint.
#pragma once

namespace aquagraph::engine {

enum class StopRequest { none, interrupt, checkpoint };

// While it lives, signals become a request that a run looks at between two cycles. A second Ctrl-C or SIGTERM ends the
// program at once.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    StopRequest request() const;
};

}  // namespace aquagraph::engine
