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
    // Clusters of this block behind the particle's own come first, those before it last.
    const std::size_t block_first = own_cluster / clusters_per_block * clusters_per_block,
                      block_end = std::min(block_first + clusters_per_block, particles.clusters());
    using Place = std::vector<std::uint32_t>::const_iterator;
    const auto from = [&](std::size_t cluster) -> Place {
        return std::lower_bound(candidates.begin(), candidates.end(), std::uint32_t(cluster));
    };
    const Place lower = from(block_first), own_place = from(own_cluster), higher = from(own_cluster + 1),
                beyond = from(block_end);
    const std::pair<Place, Place> parts[] = {{higher, beyond},
                                             {candidates.begin(), lower},
                                             {own_place, higher},
                                             {beyond, candidates.end()},
                                             {lower, own_place}};
    const std::size_t begin = out.open.size();
    std::size_t mutual = 0, between = 0;
    if (!filter || filter->sees_everything(i)) {
        std::size_t count = begin;
        out.open.resize(count + candidates.size());
        for (std::size_t part = 0; part < 5; ++part) {
            for (Place candidate = parts[part].first; candidate != parts[part].second; ++candidate) {
                unsigned in_support;
                const unsigned in_reach = look(*candidate, in_support);
                pairs += std::uint64_t(__builtin_popcount(in_support));
                out.open[count] = *candidate;  // overwritten by the next one unless it counts
                count += in_reach != 0;
            }
            if (part == 0) mutual = count - begin;
            if (part == 3) between = count - begin;
        }
        out.open.resize(count);
    } else {
        out.reciprocal = false;
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
        between = out.open.size() - begin;
    }
    out.pairs += pairs;
    out.particle.push_back({std::uint32_t(out.open.size()), std::uint32_t(out.masked.size()), std::uint16_t(mutual),
                            std::uint16_t(out.open.size() - begin - between)});
}

template <int D>
void NeighbourSearch<D>::build(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter,
                               BlockLoop loop) {
    lists.pruned = false;
    lists.blocks.resize(particles.blocks());
    lists.inner.resize(particles.blocks());
    grid_.build(particles, lists.reach(), loop);
    if (method == SearchMethod::tree) {
        build_with_tree(particles, lists, filter, loop);
        return;
    }
    loop(particles.blocks(), [&](std::size_t block) {
        thread_local std::vector<std::uint32_t> candidates;
        NeighbourBlock& out = lists.blocks[block];
        out.clear();
        out.reciprocal = true;
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
