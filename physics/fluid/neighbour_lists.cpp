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
    reciprocal = false;
    particle.push_back({0, 0, 0, 0});
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
void prune_block(const Particles<D>& particles, const NeighbourBlock& outer, NeighbourBlock& inner, double radius,
                 const StepSkin& skin, std::size_t block) {
    const Places<D> places(particles.x), velocities(particles.v);
    const LaneRange lanes = lanes_of_block(particles, block);
    // (a + b)² ≤ (1 + ε) a² + (1 + 1/ε) b²: neither roots nor absolute values, for 1 % of reach.
    constexpr double epsilon = 0.02;
    const double image_reach = radius + skin.images, reach = radius + skin.particles,
                 reach2 = (1 + epsilon) * reach * reach, per_speed2 = (1 + 1 / epsilon) * skin.step * skin.step;
    const std::size_t images = particles.clusters();
    inner.make_room_for(outer);
    inner.particle[0] = {0, 0, 0, 0};
    inner.pairs = outer.pairs;
    inner.reciprocal = outer.reciprocal;
    std::uint32_t open = 0, masked = 0;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        double own[D], velocity[D];
        for (int d = 0; d < D; ++d) {
            own[d] = places.x[d][i];
            velocity[d] = velocities.x[d][i];
        }
        // The velocity of an image need not be the one it moves with (no slip).
        const auto near = [&](std::uint32_t cluster) {
            const std::size_t first = std::size_t(cluster) * W;
            const LaneDistances<D> distances(places, first, own);
            return cluster < images ? distances.below(reach2, per_speed2, velocities, first, velocity)
                                    : distances.below(image_reach * image_reach);
        };
        const auto from = outer.particle[i - lanes.begin], to = outer.particle[i - lanes.begin + 1];
        const std::uint32_t mutual_end = from.open_end + to.mutual, lower_begin = to.open_end - to.lower;
        const std::uint32_t begin = open;
        std::uint32_t mutual = 0, between = 0;
        // Every entry is written, and overwritten by the next one unless it counts: no branch to be mispredicted.
        for (std::uint32_t k = from.open_end; k < to.open_end; ++k) {
            const std::uint32_t cluster = outer.open[k];
            inner.open[open] = cluster;
            open += near(cluster) != 0;
            mutual = k < mutual_end ? open - begin : mutual;
            between = k < lower_begin ? open - begin : between;
        }
        for (std::uint32_t k = from.masked_end; k < to.masked_end; ++k) {
            const std::uint32_t cluster = outer.masked[k];
            inner.masked[masked] = cluster;
            inner.mask[masked] = outer.mask[k];
            masked += (near(cluster) & outer.mask[k]) != 0;
        }
        inner.particle[i - lanes.begin + 1] = {open, masked, std::uint16_t(mutual),
                                               std::uint16_t(open - begin - between)};
    }
}
}  // namespace

template <int D>
void prune(const Particles<D>& particles, NeighbourLists<D>& lists, const StepSkin& skin, BlockLoop loop) {
    lists.pruned = skin.particles < lists.skin;
    if (!lists.pruned) return;
    loop(lists.blocks.size(), [&](std::size_t block) {
        prune_block(particles, lists.blocks[block], lists.inner[block], lists.radius, skin, block);
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
template void prune(const Particles<2>&, NeighbourLists<2>&, const StepSkin&, BlockLoop);
template void prune(const Particles<3>&, NeighbourLists<3>&, const StepSkin&, BlockLoop);
template struct NeighbourLists<2>;
template struct NeighbourLists<3>;

}  // namespace aquagraph::fluid
