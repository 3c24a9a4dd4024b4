#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/fluid/neighbour_search.hpp"

namespace aquagraph::fluid {

namespace {
// The lanes of a cluster, fluid or ghosts, that hold a particle.
template <int D>
LaneRange lanes_in_use(const Particles<D>& particles, std::size_t cluster) {
    const bool is_fluid = cluster < particles.clusters();
    const std::size_t end = is_fluid ? particles.count : particles.ghost_begin() + particles.ghost_count;
    return {cluster * W, std::min(end, (cluster + 1) * W)};
}
constexpr std::size_t boxes_at_once = 8;
}  // namespace

template <int D>
typename ClusterGrid<D>::Box ClusterGrid<D>::box_of(const Particles<D>& particles, LaneRange lanes) {
    Box box;
    for (int d = 0; d < D; ++d) {
        box.low[d] = box.high[d] = particles.x[d][lanes.begin];
        for (std::size_t i = lanes.begin + 1; i < lanes.end; ++i) {
            box.low[d] = std::min(box.low[d], particles.x[d][i]);
            box.high[d] = std::max(box.high[d], particles.x[d][i]);
        }
    }
    return box;
}

// Spray, or the step from one column to the next: its box would be met by far too many others.
template <int D>
bool ClusterGrid<D>::is_large(const Box& box) const {
    for (int d = 0; d < D; ++d)
        if (box.high[d] - box.low[d] > 1.5 * reach_) return true;
    return false;
}

template <int D>
void ClusterGrid<D>::choose_cells(std::size_t entries) {
    // Cells are as wide as the reach, wider only where a few far particles would need more cells than there are boxes.
    for (width_ = reach_;; width_ *= 1.3) {
        double total = 1;
        for (int d = 0; d < D; ++d) {
            cells_[d] = std::int32_t(std::min((end_[d] - origin_[d]) / width_, 1e9)) + 1;
            total *= cells_[d];
        }
        if (total <= 4.0 * double(entries) + 64) break;
    }
}

template <int D>
std::int32_t ClusterGrid<D>::cell_along(int d, double x) const {
    return std::int32_t(std::clamp((x - origin_[d]) / width_, 0.0, double(cells_[d] - 1)));
}

template <int D>
void ClusterGrid<D>::build(const Particles<D>& particles, double reach, BlockLoop loop) {
    reach_ = reach;
    const std::size_t clusters = particles.clusters() + particles.ghost_clusters;
    cluster_box_.resize(clusters);
    loop((clusters + clusters_per_block - 1) / clusters_per_block, [&](std::size_t block) {
        const std::size_t end = std::min(clusters, (block + 1) * clusters_per_block);
        for (std::size_t c = block * clusters_per_block; c < end; ++c)
            cluster_box_[c] = box_of(particles, lanes_in_use(particles, c));
    });

    // From here on boxes are what is counted, an eighth of the particles or little more: serial, 2 % of the search.
    entries_.clear();
    origin_.fill(std::numeric_limits<double>::max());
    end_.fill(std::numeric_limits<double>::lowest());
    half_.fill(0);
    const auto enter = [&](const Box& box, LaneRange lanes) {
        entries_.push_back({box, std::uint32_t(lanes.begin), std::uint32_t(lanes.end)});
        for (int d = 0; d < D; ++d) {
            const double centre = 0.5 * (box.low[d] + box.high[d]);
            origin_[d] = std::min(origin_[d], centre);
            end_[d] = std::max(end_[d], centre);
            half_[d] = std::max(half_[d], 0.5 * (box.high[d] - box.low[d]));
        }
    };
    for (std::size_t c = 0; c < clusters; ++c) {
        if (c == particles.clusters()) fluid_entries_ = entries_.size();
        const LaneRange lanes = lanes_in_use(particles, c);
        if (!is_large(cluster_box_[c])) {
            enter(cluster_box_[c], lanes);
            continue;
        }
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) enter(box_of(particles, {i, i + 1}), {i, i + 1});
    }
    if (particles.ghost_clusters == 0) fluid_entries_ = entries_.size();
    if (entries_.empty()) {  // an open domain that has run dry
        origin_.fill(0);
        end_.fill(0);
    }
    choose_cells(entries_.size());

    std::size_t cells = 1;
    for (int d = 0; d < D; ++d) cells *= std::size_t(cells_[d]);
    cell_of_.resize(entries_.size());
    cell_start_.assign(cells + 1, 0);
    for (std::size_t e = 0; e < entries_.size(); ++e) {
        const Box& box = entries_[e].box;
        std::size_t cell = 0;
        for (int d = 0; d < D; ++d)
            cell = cell * std::size_t(cells_[d]) + std::size_t(cell_along(d, 0.5 * (box.low[d] + box.high[d])));
        cell_of_[e] = std::uint32_t(cell);
        ++cell_start_[cell + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) cell_start_[c + 1] += cell_start_[c];
    for (int d = 0; d < D; ++d)
        for (auto* side : {&low_[d], &high_[d]}) side->resize(entries_.size() + boxes_at_once);
    for (auto* of : {&cluster_, &entry_}) of->resize(entries_.size() + boxes_at_once);
    for (std::size_t e = 0; e < entries_.size(); ++e) {
        const std::size_t k = cell_start_[cell_of_[e]]++;
        for (int d = 0; d < D; ++d) {
            low_[d][k] = entries_[e].box.low[d];
            high_[d][k] = entries_[e].box.high[d];
        }
        cluster_[k] = entries_[e].begin / std::uint32_t(W);
        entry_[k] = std::uint32_t(e);
    }
    for (std::size_t c = cells; c > 0; --c) cell_start_[c] = cell_start_[c - 1];
    cell_start_[0] = 0;
}

template <int D>
void ClusterGrid<D>::collect(const Box& box, double reach, const std::vector<std::uint32_t>& what,
                             std::vector<std::uint32_t>& found) const {
    const double reach2 = reach * reach;
    std::int32_t first[D], last[D], row[D];
    for (int d = 0; d < D; ++d) {
        // A hair more: an entry's centre is rounded.
        const double margin = (reach + half_[d]) * (1 + 1e-12) + 1e-12 * std::fabs(box.low[d] + box.high[d]);
        row[d] = first[d] = cell_along(d, box.low[d] - margin);
        last[d] = cell_along(d, box.high[d] + margin);
    }
    std::size_t count = found.size();
    while (true) {  // an odometer over rows of cells
        std::size_t cell = 0;
        for (int d = 0; d + 1 < D; ++d) cell = (cell + std::size_t(row[d])) * std::size_t(cells_[d + 1]);
        const std::uint32_t begin = cell_start_[cell + std::size_t(first[D - 1])],
                            end = cell_start_[cell + std::size_t(last[D - 1]) + 1];
        if (found.size() < count + (end - begin) + boxes_at_once) found.resize(2 * (count + (end - begin)) + 64);
        for (std::uint32_t k = begin; k < end; k += boxes_at_once) {
            double distance2[boxes_at_once];
#pragma omp simd
            for (std::size_t l = 0; l < boxes_at_once; ++l) {
                double r2 = 0;
                for (int d = 0; d < D; ++d) {
                    const double above = low_[d][k + l] - box.high[d], below = box.low[d] - high_[d][k + l];
                    const double gap = std::max(std::max(above, below), 0.0);
                    r2 += gap * gap;
                }
                distance2[l] = r2;
            }
            const std::size_t n = std::min<std::size_t>(boxes_at_once, end - k);
            for (std::size_t l = 0; l < n; ++l) {  // every one is written, and overwritten unless it counts
                found[count] = what[k + l];
                count += distance2[l] < reach2;
            }
        }
        int d = D - 2;
        while (d >= 0 && row[d] == last[d]) {
            row[d] = first[d];
            --d;
        }
        if (d < 0) break;
        ++row[d];
    }
    found.resize(count);
}

template <int D>
void ClusterGrid<D>::candidates(const Particles<D>& particles, std::size_t cluster,
                                std::vector<std::uint32_t>& found) const {
    found.clear();
    if (!is_large(cluster_box_[cluster])) {
        collect(cluster_box_[cluster], reach_, cluster_, found);
    } else {
        const LaneRange lanes = lanes_in_use(particles, cluster);
        for (std::size_t i = lanes.begin; i < lanes.end; ++i)
            collect(box_of(particles, {i, i + 1}), reach_, cluster_, found);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

template <int D>
void ClusterGrid<D>::entries_near(std::size_t entry, double reach, std::vector<std::uint32_t>& found) const {
    found.clear();
    collect(entries_[entry].box, reach, entry_, found);
}

template class ClusterGrid<2>;
template class ClusterGrid<3>;

}  // namespace aquagraph::fluid
