#include "engine/stop_request.hpp"

#include <csignal>
#include <initializer_list>

namespace aquagraph::engine {

namespace {
volatile std::sig_atomic_t interrupt_requested = 0, checkpoint_requested = 0;
}  // namespace

StopSignals::StopSignals() {
    interrupt_requested = 0;
    checkpoint_requested = 0;
    for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int number) {
            interrupt_requested = 1;
            std::signal(number, SIG_DFL);
        });
    std::signal(SIGUSR1, [](int) { checkpoint_requested = 1; });
}

StopSignals::~StopSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, SIG_DFL);
}

StopRequest StopSignals::request() const {
    if (interrupt_requested) return StopRequest::interrupt;
    return checkpoint_requested ? StopRequest::checkpoint : StopRequest::none;
}

}  // namespace aquagraph::engine
