#include "physics/fluid/neighbour_lists.hpp"

#include <algorithm>

#include "physics/fluid/lanes.hpp"

namespace aquagraph::fluid {

void NeighbourBlock::clear() {
    particle.clear();
    open.clear();
    masked.clear();
    mask.clear();
    pairs = 0;
    particle.push_back({0, 0});
}

void NeighbourBlock::make_room_for(const NeighbourBlock& other) {
    particle.resize(other.particle.size());
    open.resize(other.open.size());
    masked.resize(other.masked.size());
    mask.resize(other.mask.size());
}

template <int D>
std::uint64_t NeighbourLists<D>::pairs() const {
    std::uint64_t sum = 0;
    for (const auto& block : blocks) sum += block.pairs;
    return sum;
}

namespace {
template <int D>
void prune_block(const Particles<D>& particles, const NeighbourBlock& outer, NeighbourBlock& inner, double limit2,
                 std::size_t block) {
    const Places<D> places(particles.x);
    const LaneRange lanes = lanes_of_block(particles, block);
    inner.make_room_for(outer);
    inner.particle[0] = {0, 0};
    inner.pairs = outer.pairs;
    std::uint32_t open = 0, masked = 0;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        double own[D];
        for (int d = 0; d < D; ++d) own[d] = places.x[d][i];
        const auto from = outer.particle[i - lanes.begin], to = outer.particle[i - lanes.begin + 1];
        // Every entry is written, and overwritten by the next one unless it counts: no branch to be mispredicted.
        for (std::uint32_t k = from.open_end; k < to.open_end; ++k) {
            const std::uint32_t cluster = outer.open[k];
            inner.open[open] = cluster;
            open += LaneDistances<D>(places, std::size_t(cluster) * W, own).below(limit2) != 0;
        }
        for (std::uint32_t k = from.masked_end; k < to.masked_end; ++k) {
            const std::uint32_t cluster = outer.masked[k];
            inner.masked[masked] = cluster;
            inner.mask[masked] = outer.mask[k];
            masked += (LaneDistances<D>(places, std::size_t(cluster) * W, own).below(limit2) & outer.mask[k]) != 0;
        }
        inner.particle[i - lanes.begin + 1] = {open, masked};
    }
}
}  // namespace

template <int D>
void prune(const Particles<D>& particles, NeighbourLists<D>& lists, double inner_skin, BlockLoop loop) {
    lists.pruned = inner_skin < lists.skin;
    if (!lists.pruned) return;
    const double limit = lists.radius + inner_skin;
    loop(lists.blocks.size(), [&](std::size_t block) {
        prune_block(particles, lists.blocks[block], lists.inner[block], limit * limit, block);
    });
}

template <int D>
double largest_displacement_squared(const Particles<D>& particles, std::size_t block) {
    const LaneRange lanes = lanes_of_block(particles, block);
    double largest = 0;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        double r2 = 0;
        for (int d = 0; d < D; ++d) {
            const double dx = particles.x[d][i] - particles.x_built[d][i];
            r2 += dx * dx;
        }
        largest = std::max(largest, r2);
    }
    return largest;
}

template double largest_displacement_squared(const Particles<2>&, std::size_t);
template double largest_displacement_squared(const Particles<3>&, std::size_t);
template void prune(const Particles<2>&, NeighbourLists<2>&, double, BlockLoop);
template void prune(const Particles<3>&, NeighbourLists<3>&, double, BlockLoop);
template struct NeighbourLists<2>;
template struct NeighbourLists<3>;

}  // namespace aquagraph::fluid
