// Which clusters each particle must visit.
//
// Lists hold clusters of W lanes, not particles (physics/fluid/particles.hpp): a pair loop computes all W pairs of an
// entry, and lanes outside the support contribute zero. They come twice (Páll and Hess 2013, "dual pair lists"):
// - `blocks` reach R + skin and stay valid until particles that might meet have moved against each other by the skin
//   (relative_travel.hpp). They are made by a search (neighbour_search.hpp) together with the order of the particles
//   and the ghosts.
// - `inner` holds those entries of `blocks` that have a lane which may come closer than R in the coming step.
//   Two entries in five go, and with them two fifths of the arithmetic; pruning costs a few per cent of a pass.
// Sums over either are the same bits: what is left out would have added zeros.
//
// An entry is "masked" where a wall hides some of its lanes from the particle (walls/visibility.hpp); the others,
// nearly all, are "open".
#pragma once
#include <cstdint>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

struct NeighbourBlock {
    struct Entries {
        std::uint32_t open_end, masked_end;  // where this particle's entries end in `open` and `masked`
        // Of the open ones, the first `mutual` are clusters of this block behind the particle's own, the last `lower`
        // clusters of this block before it, each in ascending order as those between.
        std::uint16_t mutual, lower;
    };
    std::vector<Entries> particle;      // one per lane of the block, plus a leading {0, 0}
    std::vector<std::uint32_t> open;    // clusters all of whose lanes may be seen
    std::vector<std::uint32_t> masked;  // clusters with hidden lanes …
    std::vector<std::uint8_t> mask;     // … and which lanes are seen
    std::uint64_t pairs = 0;            // pairs closer than R when the lists were built
    // No wall hides anything from the particles of this block: each of its pairs stands in the lists of both, so that
    // a pass may compute it once for both (pair_loop.hpp).
    bool reciprocal = false;

    void clear();
    void make_room_for(const NeighbourBlock& other);  // as long as the other; the entries are left over

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(particle, open, masked, mask, pairs, reciprocal);
    }
};

template <int D>
struct NeighbourLists {
    double radius = 0;  // R [m]
    double skin = 0;    // [m]
    double reach() const { return radius + skin; }
    std::vector<NeighbourBlock> blocks;  // particles.blocks() of them
    std::uint64_t pairs() const;         // directed pairs closer than R, ghosts included

    std::vector<NeighbourBlock> inner = {};
    bool pruned = false;  // `inner` is to be used; a search takes it back
    // What pair loops walk.
    const NeighbourBlock& visited(std::size_t block) const { return pruned ? inner[block] : blocks[block]; }
};

// How much closer a pair may come until the next pruning: a particle and an image by `images` [m], two particles by
// `particles` [m] plus their relative velocity times `step` [s].
struct StepSkin {
    double images, particles, step = 0;
    StepSkin(double images, double particles, double step) : images(images), particles(particles), step(step) {}
    StepSkin(double skin) : StepSkin(skin, skin, 0) {}  // NOLINT: a skin that knows no velocities

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(images, particles, step);
    }
};

// Makes `inner` from `blocks` for the present positions and velocities; where `particles` is as long as the skin of the
// lists nothing is pruned.
template <int D>
void prune(const Particles<D>& particles, NeighbourLists<D>& lists, const StepSkin& skin, BlockLoop loop);

// Largest displacement since the lists were built, over the fluid particles of one block [m], squared.
template <int D>
double largest_displacement_squared(const Particles<D>& particles, std::size_t block);

extern template struct NeighbourLists<2>;
extern template struct NeighbourLists<3>;
extern template void prune(const Particles<2>&, NeighbourLists<2>&, const StepSkin&, BlockLoop);
extern template void prune(const Particles<3>&, NeighbourLists<3>&, const StepSkin&, BlockLoop);

}  // namespace aquagraph::fluid
