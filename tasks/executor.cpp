#include "tasks/executor.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <stdexcept>
#include <string>

namespace aquagraph::tasks {

namespace {

int checked(int threads) {
    if (threads < 0) throw std::invalid_argument("the number of threads is " + std::to_string(threads));
    return threads == 0 ? tbb::info::default_concurrency() : threads;
}

}  // namespace

// The control comes first: without it an arena larger than the machine gets no more threads than there are cores.
struct Executor::Implementation {
    explicit Implementation(int thread_count)
        : threads(checked(thread_count)),
          control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
          arena(threads, 1) {
        arena.initialize();
    }

    int threads;
    tbb::global_control control;
    tbb::task_arena arena;
};

Executor::Executor(int threads) : implementation_(std::make_unique<Implementation>(threads)) {}
Executor::~Executor() = default;

int Executor::threads() const {
    return implementation_->threads;
}

void Executor::execute(FunctionRef<void()> body) {
    implementation_->arena.execute(body);
}

}  // namespace aquagraph::tasks
