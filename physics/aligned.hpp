// Arrays on cache-line boundaries, as the vector units like to load them, and each at another distance from the start
// of its memory page: large arrays would all begin at the same place in a page, a loop over a dozen of them would then
// find all its lines in one set of the first-level cache, and the flux pass would take twice as long (measured).
#pragma once
#include <atomic>
#include <cstddef>
#include <new>
#include <vector>

namespace aquagraph {

template <class T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::size_t line = 64, lines_of_page = 64;
    CacheLineAllocator() = default;
    template <class U>
    explicit CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t n) {
        // Consecutive arrays start 5 lines apart: 13 steps round a page before the pattern repeats nearby.
        static std::atomic<std::size_t> count{0};
        const std::size_t shift = (1 + 5 * count.fetch_add(1, std::memory_order_relaxed) % lines_of_page) * line;
        auto* const memory = static_cast<std::byte*>(::operator new (n * sizeof(T) + shift, std::align_val_t{line}));
        std::byte* const start = memory + shift;
        *reinterpret_cast<std::byte**>(start - sizeof(std::byte*)) = memory;  // for deallocate
        return reinterpret_cast<T*>(start);
    }
    void deallocate(T* start, std::size_t) {
        ::operator delete (*reinterpret_cast<std::byte**>(reinterpret_cast<std::byte*>(start) - sizeof(std::byte*)),
                           std::align_val_t{line});
    }
    template <class U>
    bool operator==(const CacheLineAllocator<U>&) const {
        return true;
    }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace aquagraph
