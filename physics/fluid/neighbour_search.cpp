#include "physics/fluid/neighbour_search.hpp"

#include <algorithm>

#include "physics/fluid/lanes.hpp"

namespace aquagraph::fluid {

template <int D>
void append_entries(const Particles<D>& particles, const NeighbourLists<D>& lists, const PairFilter<D>* filter,
                    std::size_t i, const std::vector<std::uint32_t>& candidates, NeighbourBlock& out) {
    const Places<D> places(particles.x);
    const double radius2 = lists.radius * lists.radius, reach2 = lists.reach() * lists.reach();
    const std::uint32_t own_cluster = std::uint32_t(i / W);
    const unsigned own_lane = 1u << (i % W);
    double own[D];
    for (int d = 0; d < D; ++d) own[d] = places.x[d][i];
    std::uint64_t pairs = 0;
    const auto look = [&](std::uint32_t candidate, unsigned& in_support) {
        const LaneDistances<D> distances(places, std::size_t(candidate) * W, own);
        // A particle is no neighbour of its own, yet its lane may be computed.
        const unsigned others = candidate == own_cluster ? ~own_lane : ~0u;
        in_support = distances.below(radius2) & others;
        return distances.below(reach2) & others;
    };
    if (!filter || filter->sees_everything(i)) {
        std::size_t count = out.open.size();
        out.open.resize(count + candidates.size());
        for (const std::uint32_t candidate : candidates) {
            unsigned in_support;
            const unsigned in_reach = look(candidate, in_support);
            pairs += std::uint64_t(__builtin_popcount(in_support));
            out.open[count] = candidate;  // overwritten by the next one unless it counts
            count += in_reach != 0;
        }
        out.open.resize(count);
    } else {
        for (const std::uint32_t candidate : candidates) {
            unsigned in_support;
            const unsigned in_reach = look(candidate, in_support);
            if (!in_reach) continue;
            const unsigned seen = filter->lanes_seen(i, candidate, std::uint8_t(in_reach));
            pairs += std::uint64_t(__builtin_popcount(in_support & seen));
            if (seen == in_reach) {
                out.open.push_back(candidate);
            } else if (seen) {
                out.masked.push_back(candidate);
                out.mask.push_back(std::uint8_t(seen));
            }
        }
    }
    out.pairs += pairs;
    out.particle.push_back({std::uint32_t(out.open.size()), std::uint32_t(out.masked.size())});
}

template <int D>
void NeighbourSearch<D>::build(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter,
                               BlockLoop loop) {
    lists.pruned = false;
    lists.blocks.resize(particles.blocks());
    lists.inner.resize(particles.blocks());
    if (method == SearchMethod::tree) {
        build_with_tree(particles, lists, filter, loop);
        return;
    }
    grid_.build(particles, lists.reach(), loop);
    loop(particles.blocks(), [&](std::size_t block) {
        thread_local std::vector<std::uint32_t> candidates;
        NeighbourBlock& out = lists.blocks[block];
        out.clear();
        const std::size_t last = std::min(particles.clusters(), (block + 1) * clusters_per_block);
        for (std::size_t cluster = block * clusters_per_block; cluster < last; ++cluster) {
            grid_.candidates(particles, cluster, candidates);
            const LaneRange lanes = lanes_of_cluster(particles, cluster);
            for (std::size_t i = lanes.begin; i < lanes.end; ++i)
                append_entries(particles, lists, filter, i, candidates, out);
        }
        lists.inner[block].make_room_for(out);  // here, so that no step allocates
    });
}

template class NeighbourSearch<2>;
template class NeighbourSearch<3>;
template void append_entries(const Particles<2>&, const NeighbourLists<2>&, const PairFilter<2>*, std::size_t,
                             const std::vector<std::uint32_t>&, NeighbourBlock&);
template void append_entries(const Particles<3>&, const NeighbourLists<3>&, const PairFilter<3>*, std::size_t,
                             const std::vector<std::uint32_t>&, NeighbourBlock&);

}  // namespace aquagraph::fluid
