// Counts as the tests of the solid do, and memory on cache-line boundaries, where all the fluid's arrays lie, as well.
#include "tests/engine/allocation_count.hpp"

#include "tests/solid/allocation_count.cpp"

namespace {
std::atomic<long> aligned_count{0};
}

void* operator new(std::size_t size, std::align_val_t alignment) {
    ++aligned_count;
    const auto boundary = static_cast<std::size_t>(alignment);
    // aligned_alloc wants a multiple of the boundary.
    if (void* memory = std::aligned_alloc(boundary, (size + boundary - 1) / boundary * boundary)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace aquagraph::test {

long allocations() {
    return solid::test::allocations() + aligned_count;
}

}  // namespace aquagraph::test
