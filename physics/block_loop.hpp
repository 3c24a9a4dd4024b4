// How physics asks for a loop over independent blocks without knowing who runs it: serially in a test, in parallel
// when the tasks folder passes its own loop. A reference to a callable, never an owner: it allocates nothing.
#pragma once
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace aquagraph {

template <class Signature>
class FunctionRef;

// Refers to any callable with this signature. The callable must outlive the reference.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>)
        FunctionRef(F&& callable)  // NOLINT: implicit on purpose, a lambda is passed where one is expected
        : object_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
          call_([](void* object, Arguments... arguments) -> Result {
              return (*static_cast<std::remove_reference_t<F>*>(object))(std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const { return call_(object_, std::forward<Arguments>(arguments)...); }

  private:
    void* object_;
    Result (*call_)(void*, Arguments...);
};

using BlockBody = FunctionRef<void(std::size_t block)>;
// Calls body(b) once for every b in [0, blocks), in any order, perhaps at the same time; returns when all are done.
using BlockLoop = FunctionRef<void(std::size_t blocks, BlockBody body)>;

inline constexpr auto serial_loop = [](std::size_t blocks, BlockBody body) {
    for (std::size_t block = 0; block < blocks; ++block) body(block);
};

}  // namespace aquagraph
