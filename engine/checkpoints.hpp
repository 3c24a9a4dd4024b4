// The checkpoints of a run: written between two coupling cycles, they change nothing of what is computed, so that a run
// that is continued has the bits of one that never stopped.
#pragma once
#include <chrono>
#include <filesystem>
#include <optional>

#include "engine/restart_point.hpp"
#include "engine/results.hpp"

namespace aquagraph::engine {

template <int D>
class Checkpoints {
  public:
    // minutes: of wall-clock time between two; 0: none are ever due. from: where the run goes on, if it does.
    Checkpoints(const io::Scene& scene, Model<D>& model, Results<D>& results, double minutes,
                const std::optional<RestartPoint>& from);

    // The state of the restart point, into model and results, whose files are cut back to it. Returns what the run had
    // cost until then. Throws io::ArchiveError, io::CheckpointError or std::runtime_error before any file is touched.
    RunFigures restore(const RestartPoint& from);

    bool is_due() const;
    // Before the first cycle there is nothing to write. figures: what the run has cost so far. Throws
    // std::system_error; what had been written before is then untouched.
    void write(RunFigures figures);

  private:
    using Clock = std::chrono::steady_clock;
    const io::Scene& scene_;
    Model<D>& model_;
    Results<D>& results_;
    std::chrono::duration<double> interval_;
    Clock::time_point written_;
    int next_slot_ = 0;
};

}  // namespace aquagraph::engine
