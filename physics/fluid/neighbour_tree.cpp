// The neighbour search by nanoflann's k-d tree over all lanes in use.
#include <algorithm>
#include <nanoflann.hpp>

#include "physics/fluid/neighbour_search.hpp"

namespace aquagraph::fluid {

namespace {
template <int D>
struct Cloud {
    const Particles<D>& particles;
    // nanoflann counts points; ghosts begin at the next cluster boundary after the fluid.
    std::size_t lane(std::size_t point) const {
        return point < particles.count ? point : point - particles.count + particles.ghost_begin();
    }
    std::size_t kdtree_get_point_count() const { return particles.count + particles.ghost_count; }
    double kdtree_get_pt(std::size_t point, std::size_t d) const { return particles.x[d][lane(point)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};
}  // namespace

template <int D>
void build_with_tree(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter,
                     BlockLoop loop) {
    const Cloud<D> cloud{particles};
    if (cloud.kdtree_get_point_count() == 0) return;
    const nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud<D>>, Cloud<D>, D, std::size_t>
        tree(D, cloud);
    // A hair more than the reach: which lanes count is decided below, by the same arithmetic as for the grid.
    const double reach2 = lists.reach() * lists.reach() * (1 + 1e-12);
    loop(particles.blocks(), [&](std::size_t block) {
        std::vector<std::pair<std::size_t, double>> matches;
        std::vector<std::uint32_t> candidates;
        NeighbourBlock& out = lists.blocks[block];
        out.clear();
        out.reciprocal = true;
        const LaneRange lanes = lanes_of_block(particles, block);
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            double x[D];
            for (int d = 0; d < D; ++d) x[d] = particles.x[d][i];
            tree.radiusSearch(x, reach2, matches, nanoflann::SearchParams(0, 0, false));
            candidates.clear();
            for (const auto& match : matches) candidates.push_back(std::uint32_t(cloud.lane(match.first) / W));
            std::sort(candidates.begin(), candidates.end());
            candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
            append_entries(particles, lists, filter, i, candidates, out);
        }
    });
}

template void build_with_tree(const Particles<2>&, NeighbourLists<2>&, const PairFilter<2>*, BlockLoop);
template void build_with_tree(const Particles<3>&, NeighbourLists<3>&, const PairFilter<3>*, BlockLoop);

}  // namespace aquagraph::fluid
