// Loops over blocks inside a task, on all threads of the executor.
//
// A thread that has run out of blocks and waits for the others takes no other task meanwhile (the loop is isolated):
// otherwise it could pick up a long solve and the loop would end when that does. Time spent in blocks is added to the
// statistics of the task that runs the loop. A block should cost 100 000 cycles or more.
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "physics/block_loop.hpp"

namespace aquagraph::tasks {

// Can be passed wherever physics asks for a BlockLoop. Every block runs exactly once; with one block or one thread,
// in order on the calling thread. If a block throws, no further one is started and the first exception is rethrown
// here. A loop is not cut short because another task of the graph has failed.
struct ParallelLoop {
    void operator()(std::size_t blocks, BlockBody body) const;
};
inline constexpr ParallelLoop parallel_loop{};

// parallel_loop with any callable body(block).
template <class F>
void for_each_block(std::size_t blocks, F&& body) {
    parallel_loop(blocks, BlockBody(body));
}

// Blocks are cut for passes over pairs. A pass over particles alone takes a microsecond or two for one of them, less
// than handing it to a thread is worth: this many together.
inline constexpr std::size_t blocks_without_pairs = 8;

// The same with `together` neighbouring blocks at a time; every block still writes its own.
template <class F>
void for_each_block(std::size_t blocks, std::size_t together, F&& body) {
    for_each_block((blocks + together - 1) / together, [&](std::size_t piece) {
        for (std::size_t block = piece * together; block < std::min(blocks, (piece + 1) * together); ++block)
            body(block);
    });
}

// Combines map(b) of all blocks. The values are combined in pairs of neighbours, then pairs of pairs: the shape of
// this tree depends on the number of blocks alone, so the result is bitwise the same on any number of threads.
// scratch holds one value per block and belongs to the caller: nothing is allocated.
template <class T, class Map, class Combine>
T reduce_blocks(std::size_t blocks, const T& identity, Map&& map, Combine&& combine,
                std::type_identity_t<std::span<T>> scratch, std::size_t together = 1) {
    if (blocks == 0) return identity;
    if (scratch.size() < blocks)
        throw std::invalid_argument("reduce_blocks: scratch is smaller than the number of blocks");
    for_each_block(blocks, together, [&](std::size_t block) { scratch[block] = map(block); });
    for (std::size_t stride = 1; stride < blocks; stride *= 2)
        for (std::size_t left = 0; left + stride < blocks; left += 2 * stride)
            scratch[left] = combine(scratch[left], scratch[left + stride]);
    return combine(identity, scratch[0]);
}

// The same with scratch of its own: for set-up and tests, not for the step.
template <class T, class Map, class Combine>
T reduce_blocks(std::size_t blocks, const T& identity, Map&& map, Combine&& combine) {
    std::vector<T> scratch(blocks, identity);
    return reduce_blocks(blocks, identity, map, combine, std::span<T>(scratch));
}

}  // namespace aquagraph::tasks
