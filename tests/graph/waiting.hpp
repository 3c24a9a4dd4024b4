// Waiting for another thread in a test, with a limit so that a deadlock fails instead of hanging.
#pragma once
#include <chrono>
#include <thread>

namespace aquagraph::tests {

using Milliseconds = std::chrono::milliseconds;

// True as soon as the condition holds; false if it does not within the limit.
template <class Condition>
bool comes_true(Condition&& condition, Milliseconds limit = Milliseconds(20000)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

// Keeps the thread busy for at least this long.
inline void spin(Milliseconds duration) {
    const auto end = std::chrono::steady_clock::now() + duration;
    while (std::chrono::steady_clock::now() < end) {
    }
}

}  // namespace aquagraph::tests
