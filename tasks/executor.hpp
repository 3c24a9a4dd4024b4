// The threads that run graphs and parallel loops: one arena of a given concurrency.
#pragma once
#include <memory>

#include "physics/block_loop.hpp"

namespace aquagraph::tasks {

// Guarantees that never more than threads() threads, the calling one included, work for it. The limit holds for all
// of the process' oneTBB use while the executor lives, so make one in main() and hand it around: where several live
// at the same time, the smallest limit counts. Must outlive the graphs built on it.
class Executor {
  public:
    explicit Executor(int threads = 0);  // 0: as many as the machine has cores; throws std::invalid_argument if < 0
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    int threads() const;

    // Runs body within the arena and waits for it: parallel loops outside of any graph (set-up, tests) use the
    // executor's threads this way. Exceptions of body pass through unchanged.
    void execute(FunctionRef<void()> body);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace aquagraph::tasks
