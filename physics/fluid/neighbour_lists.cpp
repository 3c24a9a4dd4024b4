#include "physics/fluid/neighbour_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aquagraph::fluid {

namespace {
// Bit l is set where value[l] < limit. Sums of powers of two: a form that GCC turns into one vector compare.
[[gnu::always_inline]] inline unsigned lanes_below(const double (&value)[W], double limit) {
    unsigned bits = 0;
#pragma omp simd reduction(+ : bits)
    for (unsigned l = 0; l < W; ++l) bits += value[l] < limit ? 1u << l : 0u;
    return bits;
}
}  // namespace

template <int D>
std::uint64_t NeighbourLists<D>::pairs() const {
    std::uint64_t sum = 0;
    for (const auto& block : blocks) sum += block.pairs;
    return sum;
}

template <int D>
typename NeighbourSearch<D>::Cell NeighbourSearch<D>::cell_of(const Particles<D>& particles, std::size_t lane) const {
    Cell cell;
    for (int d = 0; d < D; ++d)
        cell[d] = std::clamp(std::int32_t((particles.x[d][lane] - origin_[d]) * inverse_cell_), 0, cells_[d] - 1);
    return cell;
}

template <int D>
std::size_t NeighbourSearch<D>::index(const Cell& cell) const {
    std::size_t k = 0;
    for (int d = 0; d < D; ++d) k = k * std::size_t(cells_[d]) + std::size_t(cell[d]);
    return k;
}

template <int D>
void NeighbourSearch<D>::bin(const Particles<D>& particles, double reach) {
    const std::size_t fluid_end = particles.count, ghost_begin = particles.ghost_begin(),
                      ghost_end = ghost_begin + particles.ghost_count;
    const auto each_lane = [&](auto&& f) {
        for (std::size_t i = 0; i < fluid_end; ++i) f(i);
        for (std::size_t i = ghost_begin; i < ghost_end; ++i) f(i);
    };
    double high[D];
    if (fluid_end + particles.ghost_count == 0) {  // an open domain that has run dry
        cells_.fill(1);
        origin_.fill(0);
        cell_start_.assign(2, 0);
        cell_clusters_.clear();
        return;
    }
    for (int d = 0; d < D; ++d) {
        origin_[d] = std::numeric_limits<double>::max();
        high[d] = std::numeric_limits<double>::lowest();
    }
    each_lane([&](std::size_t i) {
        for (int d = 0; d < D; ++d) {
            origin_[d] = std::min(origin_[d], particles.x[d][i]);
            high[d] = std::max(high[d], particles.x[d][i]);
        }
    });
    // Cells are as wide as the reach, wider only where a few far particles would need more cells than there are lanes.
    double width = reach;
    for (;; width *= 1.3) {
        double total = 1;
        for (int d = 0; d < D; ++d) {
            cells_[d] = std::int32_t(std::min((high[d] - origin_[d]) / width, 1e9)) + 1;
            total *= cells_[d];
        }
        if (total <= 4.0 * double(particles.size()) + 64) break;
    }
    inverse_cell_ = 1 / width;
    std::size_t cells = 1;
    for (int d = 0; d < D; ++d) cells *= std::size_t(cells_[d]);

    // Each cell lists the clusters with a lane in it, once each: lanes of a cluster are visited one after the other.
    const auto each_membership = [&](auto&& f) {
        std::size_t seen[W];
        const auto part = [&](std::size_t begin, std::size_t end) {
            for (std::size_t first = begin; first < end; first += W) {
                int distinct = 0;
                for (std::size_t i = first; i < std::min(first + W, end); ++i) {
                    const std::size_t cell = index(cell_of(particles, i));
                    if (std::find(seen, seen + distinct, cell) != seen + distinct) continue;
                    seen[distinct++] = cell;
                    f(cell, std::uint32_t(first / W));
                }
            }
        };
        part(0, fluid_end);
        part(ghost_begin, ghost_end);
    };
    cell_start_.assign(cells + 1, 0);
    each_membership([&](std::size_t cell, std::uint32_t) { ++cell_start_[cell + 1]; });
    for (std::size_t c = 0; c < cells; ++c) cell_start_[c + 1] += cell_start_[c];
    cell_clusters_.resize(cell_start_[cells]);
    each_membership([&](std::size_t cell, std::uint32_t cluster) { cell_clusters_[cell_start_[cell]++] = cluster; });
    for (std::size_t c = cells; c > 0; --c) cell_start_[c] = cell_start_[c - 1];
    cell_start_[0] = 0;
}

template <int D>
void NeighbourSearch<D>::build(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter,
                               BlockLoop loop) {
    lists.blocks.resize(particles.blocks());
    bin(particles, lists.reach());
    loop(particles.blocks(), [&](std::size_t block) { build_block(particles, lists, filter, block); });
}

template <int D>
void NeighbourSearch<D>::build_block(const Particles<D>& particles, NeighbourLists<D>& lists,
                                     const PairFilter<D>* filter, std::size_t block) const {
    NeighbourBlock& out = lists.blocks[block];
    out.particle.clear();
    out.open.clear();
    out.masked.clear();
    out.mask.clear();
    out.pairs = 0;
    out.particle.push_back({0, 0});
    const double radius2 = lists.radius * lists.radius, reach2 = lists.reach() * lists.reach();

    // Candidates of a cluster: the clusters in the cells around its lanes, in ascending order and once each.
    thread_local std::vector<std::uint32_t> candidates;
    const std::size_t last = std::min(particles.clusters(), (block + 1) * clusters_per_block);
    for (std::size_t cluster = block * clusters_per_block; cluster < last; ++cluster) {
        const std::size_t lane_end = std::min(particles.count, (cluster + 1) * W);
        candidates.clear();
        std::array<std::size_t, W> done{};
        std::size_t done_count = 0;
        for (std::size_t i = cluster * W; i < lane_end; ++i) {
            const Cell centre = cell_of(particles, i);
            const std::size_t home = index(centre);
            if (std::find(done.begin(), done.begin() + done_count, home) != done.begin() + done_count) continue;
            done[done_count++] = home;
            Cell low, high;
            for (int d = 0; d < D; ++d) {
                low[d] = std::max(0, centre[d] - 1);
                high[d] = std::min(cells_[d] - 1, centre[d] + 1);
            }
            Cell cell = low;
            while (true) {  // an odometer over the block of 3^D cells
                const std::size_t k = index(cell);
                candidates.insert(candidates.end(), cell_clusters_.begin() + cell_start_[k],
                                  cell_clusters_.begin() + cell_start_[k + 1]);
                int d = D - 1;
                while (d >= 0 && cell[d] == high[d]) {
                    cell[d] = low[d];
                    --d;
                }
                if (d < 0) break;
                ++cell[d];
            }
        }
        std::sort(candidates.begin(), candidates.end());
        candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());

        for (std::size_t i = cluster * W; i < lane_end; ++i) {
            double own[D];
            for (int d = 0; d < D; ++d) own[d] = particles.x[d][i];
            const bool filtered = filter && !filter->sees_everything(i);
            std::uint64_t pairs = 0;
            for (const std::uint32_t candidate : candidates) {
                double distance2[W];
                const std::size_t first = std::size_t(candidate) * W;
#pragma omp simd
                for (std::size_t l = 0; l < W; ++l) {
                    double r2 = 0;
                    for (int d = 0; d < D; ++d) {
                        const double dx = particles.x[d][first + l] - own[d];
                        r2 += dx * dx;
                    }
                    distance2[l] = r2;
                }
                const unsigned in_reach_or_self = lanes_below(distance2, reach2);
                if (!in_reach_or_self) continue;
                unsigned in_reach = in_reach_or_self, in_support = lanes_below(distance2, radius2);
                if (candidate == cluster) {  // a particle is no neighbour of its own, yet its lane may be computed
                    in_reach &= ~(1u << (i - first));
                    in_support &= ~(1u << (i - first));
                }
                if (!in_reach) continue;
                const unsigned seen = filtered ? filter->lanes_seen(i, candidate, std::uint8_t(in_reach)) : in_reach;
                pairs += std::uint64_t(__builtin_popcount(in_support & seen));
                if (seen == in_reach) {
                    out.open.push_back(candidate);
                } else if (seen) {
                    out.masked.push_back(candidate);
                    out.mask.push_back(std::uint8_t(seen));
                }
            }
            out.pairs += pairs;
            out.particle.push_back({std::uint32_t(out.open.size()), std::uint32_t(out.masked.size())});
        }
    }
}

template <int D>
double largest_displacement_squared(const Particles<D>& particles, std::size_t block) {
    const std::size_t begin = block * clusters_per_block * W,
                      end = std::min(particles.count, begin + clusters_per_block * W);
    double largest = 0;
    for (std::size_t i = begin; i < end; ++i) {
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
template struct NeighbourLists<2>;
template struct NeighbourLists<3>;
template class NeighbourSearch<2>;
template class NeighbourSearch<3>;

}  // namespace aquagraph::fluid
