// The one loop over pairs that every pair pass uses.
//
// A pass is a struct with
//     Own   what it needs of particle i, loaded once:          Own load(i)
//     Sum   double lane[…][W], W lanes of each accumulated quantity
//     pair(own, j, seen, sum, lane)   one pair, plain arithmetic without branches; seen is 1, or 0 where a wall hides j
//     store(i, own, sum)
// The lane loop is vectorised by `omp simd`. GCC gives up as soon as pair() is not inlined or writes to memory that it
// cannot prove private, so `aquagraph run` prints pairs/s of every pass: a fall to a quarter is a bug.
#pragma once

#include <iterator>

#include "physics/fluid/neighbour_lists.hpp"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace aquagraph::fluid {

// Adds the entries of particle i to `sum`, which is set to zero before.
template <class Pass>
[[gnu::always_inline]] inline void add_pairs(const NeighbourBlock& list, NeighbourBlock::Entries from,
                                             NeighbourBlock::Entries to, const Pass& pass,
                                             const typename Pass::Own& own, typename Pass::Sum& sum) {
    const std::uint32_t* const open = list.open.data();
    const std::uint32_t* const masked = list.masked.data();
    // Two paths, so that no zeros are written to memory where a loop follows that keeps its sums in registers.
    if (from.open_end < to.open_end) [[likely]] {
        sum = {};
        std::uint32_t k = from.open_end;
        do {
            const std::size_t j = std::size_t(open[k]) * W;
            asm volatile("");  // no instruction: keeps GCC from vectorising two entries at once instead of the lanes
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) pass.pair(own, j + l, 1.0, sum, l);
        } while (++k < to.open_end);
    } else {
        sum = {};
    }
    for (std::uint32_t k = from.masked_end; k < to.masked_end; ++k) {
        const std::size_t j = std::size_t(masked[k]) * W;
        const unsigned mask = list.mask[k];
        asm volatile("");
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) pass.pair(own, j + l, double((mask >> l) & 1u), sum, l);
    }
}

// A pass that can give what a pair exchanges to both of it at once, pair(own, j, to_i, to_j, lane), computes the pairs
// inside a block once where all of them see each other. What particles of lower clusters give is added last. Blocks
// stay independent of each other, and sums the same bits for any number of threads.
template <class Pass>
concept Reciprocal = requires(const Pass& pass, const typename Pass::Own& own, typename Pass::Sum& sum) {
    pass.pair(own, 0, sum, sum, 0);
};

template <class Pass>
[[gnu::always_inline]] inline void reciprocal_loop(const NeighbourBlock& list, LaneRange lanes, const Pass& pass) {
    const std::uint32_t* const open = list.open.data();
    const NeighbourBlock::Entries* const entries = list.particle.data();
    const std::size_t first_cluster = lanes.begin / W;
    typename Pass::Sum given[clusters_per_block] = {};
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const auto own = pass.load(i);
        const auto from = entries[i - lanes.begin], to = entries[i - lanes.begin + 1];
        typename Pass::Sum sum = {};
        std::uint32_t k = from.open_end;
        for (const std::uint32_t end = k + to.mutual; k < end; ++k) {
            const std::size_t j = std::size_t(open[k]) * W;
            typename Pass::Sum& to_j = given[open[k] - first_cluster];
            asm volatile("");
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) pass.pair(own, j + l, sum, to_j, l);
        }
        for (const std::uint32_t end = to.open_end - to.lower; k < end; ++k) {
            const std::size_t j = std::size_t(open[k]) * W;
            asm volatile("");
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) pass.pair(own, j + l, 1.0, sum, l);
        }
        const std::size_t lane = i - lanes.begin;
        for (std::size_t row = 0; row < std::size(sum.lane); ++row)
            sum.lane[row][0] += given[lane / W].lane[row][lane % W];
        pass.store(i, own, sum);
    }
}

template <int D, class Pass>
[[gnu::flatten]] void pair_loop(const NeighbourLists<D>& lists, LaneRange lanes, const Pass& pass) {
    const std::size_t block = lanes.begin / (clusters_per_block * W), block_begin = block * clusters_per_block * W;
    const NeighbourBlock& list = lists.visited(block);
    const NeighbourBlock::Entries* const entries = list.particle.data();
    if constexpr (Reciprocal<Pass>)
        if (list.reciprocal && lanes.end - lanes.begin + 1 == list.particle.size()) {
            reciprocal_loop(list, lanes, pass);
            return;
        }
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const auto own = pass.load(i);
        typename Pass::Sum sum;
        add_pairs(list, entries[i - block_begin], entries[i - block_begin + 1], pass, own, sum);
        pass.store(i, own, sum);
    }
}

// The lanes of an accumulator, added in a fixed order.
inline double add_lanes(const double (&lane)[W]) {
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

// The same of N accumulators at once: total[k] has the bits of add_lanes(lane[k]).
template <std::size_t N>
[[gnu::always_inline]] inline void add_lanes(const double (&lane)[N][W], double (&total)[N]) {
    std::size_t done = 0;
#ifdef __AVX512F__
    // Four at a time: halves, then quarters, are added across the four registers. (Masks of all lanes: the forms
    // without a mask make GCC 12 warn of uninitialised values in its own header.)
    constexpr __mmask8 all = 0xFF;
    for (; done + 2 < N; done += 4) {
        const auto row = [&](std::size_t k) __attribute__((always_inline)) {
            return _mm512_loadu_pd(lane[done + k < N ? done + k : N - 1]);
        };
        const auto halves = [](__m512d a, __m512d b) __attribute__((always_inline)) {
            return _mm512_add_pd(_mm512_maskz_shuffle_f64x2(all, a, b, 0x44),
                                 _mm512_maskz_shuffle_f64x2(all, a, b, 0xEE));
        };
        const __m512d ab = halves(row(0), row(1)), cd = halves(row(2), row(3));
        const __m512d quarters =
            _mm512_add_pd(_mm512_maskz_shuffle_f64x2(all, ab, cd, 0x88), _mm512_maskz_shuffle_f64x2(all, ab, cd, 0xDD));
        alignas(64) double pairs[8];
        _mm512_store_pd(pairs, quarters);
        for (std::size_t k = 0; k < 4 && done + k < N; ++k) total[done + k] = pairs[2 * k] + pairs[2 * k + 1];
    }
#endif
    for (; done < N; ++done) total[done] = add_lanes(lane[done]);
}

}  // namespace aquagraph::fluid
