// Neighbour lists hold exactly the pairs that a double loop and a k-d tree find, whatever the particles look like.
#include "physics/fluid/neighbour_search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <set>

#include "physics/fluid/travel.hpp"
#include "tests/fluid/fixtures.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;
using aquagraph::solid::test::ThreadedLoop;

namespace {

using Neighbours = std::vector<std::vector<std::size_t>>;  // of each fluid particle, ascending

// What a pair loop would visit: every lane of the listed clusters, but for those hidden by a mask.
template <int D>
Neighbours visited(const Particles<D>& s, const NeighbourLists<D>& lists, double within) {
    Neighbours found(s.count);
    for (std::size_t i = 0; i < s.count; ++i) {
        const std::size_t block = i / (clusters_per_block * W);
        const NeighbourBlock& list = lists.visited(block);
        const std::size_t local = i - block * clusters_per_block * W;
        const auto from = list.particle[local], to = list.particle[local + 1];
        const auto visit = [&](std::uint32_t cluster, unsigned mask) {
            for (std::size_t l = 0; l < W; ++l) {
                const std::size_t j = cluster * W + l;
                if (j != i && ((mask >> l) & 1u) && distance(s, i, j) < within) found[i].push_back(j);
            }
        };
        for (auto k = from.open_end; k < to.open_end; ++k) visit(list.open[k], 0xff);
        for (auto k = from.masked_end; k < to.masked_end; ++k) visit(list.masked[k], list.mask[k]);
        std::sort(found[i].begin(), found[i].end());
    }
    return found;
}

template <int D>
Neighbours by_double_loop(const Particles<D>& s, double within) {
    Neighbours found(s.count);
    for (std::size_t i = 0; i < s.count; ++i)
        each_lane(s, [&](std::size_t j) {
            if (j != i && distance(s, i, j) < within) found[i].push_back(j);
        });
    return found;
}

template <int D>
struct Cloud {
    const Particles<D>& s;
    std::vector<std::size_t> lane;
    std::size_t kdtree_get_point_count() const { return lane.size(); }
    double kdtree_get_pt(std::size_t k, std::size_t d) const { return s.x[d][lane[k]]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

template <int D>
Neighbours by_tree(const Particles<D>& s, double within) {
    Cloud<D> cloud{s, {}};
    each_lane(s, [&](std::size_t j) { cloud.lane.push_back(j); });
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud<D>>, Cloud<D>, D, std::size_t> tree(
        D, cloud);
    Neighbours found(s.count);
    std::vector<std::pair<std::size_t, double>> matches;
    for (std::size_t i = 0; i < s.count; ++i) {
        double x[D];
        for (std::size_t d = 0; d < D; ++d) x[d] = s.x[d][i];
        tree.radiusSearch(x, within * within, matches, nanoflann::SearchParams());
        for (const auto& [k, distance2] : matches)
            if (cloud.lane[k] != i) found[i].push_back(cloud.lane[k]);
        std::sort(found[i].begin(), found[i].end());
    }
    return found;
}

std::uint64_t number_of_pairs(const Neighbours& neighbours) {
    std::uint64_t sum = 0;
    for (const auto& of : neighbours) sum += of.size();
    return sum;
}

// The same entries in the same order.
template <int D>
bool same(const NeighbourLists<D>& one, const NeighbourLists<D>& other) {
    if (one.blocks.size() != other.blocks.size()) return false;
    for (std::size_t b = 0; b < one.blocks.size(); ++b) {
        const NeighbourBlock &p = one.blocks[b], &q = other.blocks[b];
        const bool ends =
            std::equal(p.particle.begin(), p.particle.end(), q.particle.begin(), q.particle.end(), [](auto a, auto c) {
                return a.open_end == c.open_end && a.masked_end == c.masked_end && a.mutual == c.mutual &&
                       a.lower == c.lower;
            });
        if (!ends || p.reciprocal != q.reciprocal || p.open != q.open || p.masked != q.masked || p.mask != q.mask ||
            p.pairs != q.pairs)
            return false;
    }
    return true;
}

// The first entries of a particle are clusters of its block behind its own, the last ones those before; together with
// the particle's own cluster, all of its block: so each pair inside a block stands once among the first.
template <int D>
bool in_order(const Particles<D>& s, const NeighbourLists<D>& lists) {
    for (std::size_t i = 0; i < s.count; ++i) {
        const std::size_t block = i / (clusters_per_block * W), own = i / W, local = i - block * clusters_per_block * W;
        const NeighbourBlock& list = lists.visited(block);
        const auto from = list.particle[local], to = list.particle[local + 1];
        for (std::uint32_t k = from.open_end; k < to.open_end; ++k) {
            const std::size_t cluster = list.open[k];
            const bool inside = cluster < s.clusters() && cluster / clusters_per_block == block;
            const bool first = k - from.open_end < to.mutual, last = to.open_end - k <= to.lower;
            if (list.reciprocal && (first != (inside && cluster > own) || last != (inside && cluster < own)))
                return false;
            if (!list.reciprocal && first && !(inside && cluster > own)) return false;
        }
    }
    return true;
}

template <int D>
void check_lists(const Particles<D>& s, double radius, double skin) {
    const auto lists = lists_of<D>(s, radius, skin);
    REQUIRE(lists.blocks.size() == s.blocks());
    const Neighbours expected = by_double_loop(s, radius);
    CHECK(visited(s, lists, radius) == expected);
    CHECK(in_order(s, lists));
    CHECK(by_tree(s, radius) == expected);
    CHECK(lists.pairs() == number_of_pairs(expected));
    CHECK(visited(s, lists, lists.reach()) == by_double_loop(s, lists.reach()));
    CHECK(same(lists, lists_of<D>(s, radius, skin, serial_loop, nullptr, SearchMethod::tree)));
}

template <int D>
std::vector<Point<D>> random_cloud(std::size_t n, double size, Random& random) {
    std::vector<Point<D>> points(n);
    for (auto& x : points)
        for (double& component : x) component = size * random();
    return points;
}

template <int D>
void sorted_check(std::vector<Point<D>> points, double spacing, double radius, double skin,
                  const std::vector<Point<D>>& ghosts = {}) {
    CAPTURE(D);
    CAPTURE(points.size());
    check_lists(place<D>(points, spacing, ghosts), radius, skin);  // in any order …
    Particles<D> s = place<D>(points, spacing, ghosts);            // … and in the order that the solver uses
    SpatialOrder<D> order;
    Reorder<D>().apply(s, order.sort(s.x, s.count, spacing));
    check_lists(s, radius, skin);
}

template <int D>
void check_shapes() {
    Random random;
    // 1500 particles are 12 blocks; 1 and 7 are less than a cluster, 129 begins a second block.
    for (const std::size_t n : {1, 2, 7, 8, 9, 129, 1500})
        sorted_check<D>(random_cloud<D>(n, 1, random), 0.1, 0.27, 0.05);
    // A sheet and a thread.
    auto sheet = random_cloud<D>(600, 1, random);
    for (auto& x : sheet) x[D - 1] = 0.3;
    sorted_check<D>(sheet, 0.05, 0.2, 0.04);
    for (auto& x : sheet) x[0] = 0.7;
    sorted_check<D>(sheet, 0.01, 0.03, 0.01);
    // A few far outliers; without care the grid would have 10^15 cells.
    auto scattered = random_cloud<D>(400, 1, random);
    for (int k = 0; k < 5; ++k)
        for (double& component : scattered[static_cast<std::size_t>(70 * k)]) component = 1e4 * random();
    scattered.push_back(scattered[70]);
    scattered.back()[0] += 0.1;  // two of them are neighbours
    sorted_check<D>(scattered, 0.1, 0.3, 0.06);
    // Ghosts are neighbours, and have none.
    sorted_check<D>(random_cloud<D>(500, 1, random), 0.1, 0.25, 0.05, random_cloud<D>(77, 1.2, random));
    // Coincident particles.
    auto twins = random_cloud<D>(100, 1, random);
    twins.insert(twins.end(), twins.begin(), twins.end());
    sorted_check<D>(twins, 0.1, 0.3, 0.06);
}

template <int D>
void check_after_moves() {
    CAPTURE(D);
    Random random;
    const double radius = 0.25, skin = 0.06;
    Particles<D> s = place<D>(random_cloud<D>(1200, 1, random), 0.08);
    const auto lists = lists_of<D>(s, radius, skin);
    for (std::size_t i = 0; i < s.count; ++i) {
        double move[D], length2 = 0;
        for (double& component : move) {
            component = random();
            length2 += component * component;
        }
        for (std::size_t d = 0; d < D; ++d) s.x[d][i] += 0.4999 * skin * move[d] / std::sqrt(length2);
    }
    Travel most;
    for (std::size_t block = 0; block < s.blocks(); ++block) most = largest(most, travel(s, lanes_of_block(s, block)));
    CHECK(most.so_far() == doctest::Approx(0.4999 * skin).epsilon(1e-10));
    CHECK(visited(s, lists, radius) == by_double_loop(s, radius));
}

template <int D>
void check_threads() {
    CAPTURE(D);
    Random random;
    const Particles<D> s = place<D>(random_cloud<D>(3000, 1, random), 0.05, random_cloud<D>(100, 1, random));
    const auto serial = lists_of<D>(s, 0.2, 0.05);
    for (const unsigned threads : {2u, 4u}) {
        const ThreadedLoop loop{threads};
        const auto threaded = lists_of<D>(s, 0.2, 0.05, loop);
        CHECK(same(threaded, serial));
    }
}

// A pruned list visits all that lie within R until something has moved half of its skin, and walks fewer entries.
template <int D>
void check_pruning(const PairFilter<D>* filter, const Particles<D>& placed, Random& random) {
    CAPTURE(D);
    Particles<D> s = placed;
    const double radius = 0.25, skin = 0.06, inner_skin = 0.02;
    auto lists = lists_of<D>(s, radius, skin, serial_loop, filter);
    const Neighbours before = visited(s, lists, radius + inner_skin);
    std::size_t entries = 0, left = 0;
    prune(s, lists, inner_skin, serial_loop);
    REQUIRE(lists.pruned);
    CHECK(visited(s, lists, radius + inner_skin) == before);
    CHECK(in_order(s, lists));
    for (std::size_t b = 0; b < lists.blocks.size(); ++b) {
        entries += lists.blocks[b].open.size() + lists.blocks[b].masked.size();
        left += lists.inner[b].particle.back().open_end + lists.inner[b].particle.back().masked_end;
    }
    CHECK(left < (D == 2 ? 0.92 : 0.85) * static_cast<double>(entries));
    auto threaded = lists_of<D>(s, radius, skin, serial_loop, filter);
    prune(s, threaded, inner_skin, ThreadedLoop{3});
    CHECK(visited(s, threaded, 1e9) == visited(s, lists, 1e9));

    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t d = 0; d < D; ++d) s.x[d][i] += 0.49 * inner_skin / std::sqrt(double(D)) * random();
    const auto pruned = visited(s, lists, radius);
    lists.pruned = false;
    CHECK(pruned == visited(s, lists, radius));
    prune(s, lists, skin, serial_loop);  // nothing to be gained
    CHECK(!lists.pruned);
}

// Lists pruned with the velocities hold the pairs of the whole step that these take particles through, images or none.
template <int D>
void check_moving(const std::vector<Point<D>>& ghosts, Random& random) {
    CAPTURE(D);
    CAPTURE(ghosts.size());
    const double radius = 0.25, skin = 0.06, dt = 0.01;
    Particles<D> s = place<D>(random_cloud<D>(1300, 1, random), 0.05, ghosts);
    // A stream that shears: neighbours move together, particles far away do not.
    for (std::size_t i = 0; i < s.count; ++i) {
        s.v[0][i] = 3 * s.x[1][i] + 0.1 * random();
        s.v[1][i] = 2 + 0.1 * random();
        for (std::size_t d = 0; d < D; ++d) s.acceleration[d][i] = 5 * random();
    }
    auto lists = lists_of<D>(s, radius, skin);
    Travel most;
    for (std::size_t block = 0; block < s.blocks(); ++block) most = largest(most, travel(s, lanes_of_block(s, block)));
    const StepSkin allowed = skin_of_step(most, dt, 0, radius);
    REQUIRE(allowed.particles < 0.5 * allowed.images);
    prune(s, lists, allowed, serial_loop);
    REQUIRE(lists.pruned);
    CHECK(in_order(s, lists));
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t d = 0; d < D; ++d) s.x[d][i] += dt * s.v[d][i] + 0.5 * dt * dt * s.acceleration[d][i];
    const Neighbours pruned = visited(s, lists, radius);
    std::size_t lanes = 0, all = 0;
    for (const auto& of : visited(s, lists, 1e9)) lanes += of.size();
    lists.pruned = false;
    for (const auto& of : visited(s, lists, 1e9)) all += of.size();
    CHECK(pruned == visited(s, lists, radius));
    CHECK(lanes < all);
}

// Hides every pair whose numbers add up to a multiple of three.
class EveryThird : public PairFilter<2> {
  public:
    explicit EveryThird(const Particles<2>& s) : s_(s) {}
    bool sees_everything(std::size_t i) const override { return i % 2 == 0; }
    std::uint8_t lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const override {
        unsigned seen = 0;
        for (unsigned l = 0; l < W; ++l)
            if (((in_reach >> l) & 1u) && !hidden(i, cluster * W + l)) seen |= 1u << l;
        return static_cast<std::uint8_t>(seen);
    }
    bool hidden(std::size_t i, std::size_t j) const { return i % 2 == 1 && (i + j) % 3 == 0; }

  private:
    const Particles<2>& s_;
};

}  // namespace

TEST_CASE("lists hold the pairs that a double loop and a tree find, once each") {
    check_shapes<2>();
    check_shapes<3>();
}

TEST_CASE("lists stay complete while nothing moves further than half the skin") {
    check_after_moves<2>();
    check_after_moves<3>();
}

TEST_CASE("lists are the same bits on several threads") {
    check_threads<2>();
    check_threads<3>();
}

TEST_CASE("pruned lists visit every pair of the coming step") {
    Random random;
    const Particles<2> plane = place<2>(random_cloud<2>(1300, 1, random), 0.05, random_cloud<2>(100, 1, random));
    const EveryThird filter(plane);
    check_pruning<2>(nullptr, plane, random);
    check_pruning<2>(&filter, plane, random);
    check_pruning<3>(nullptr, place<3>(random_cloud<3>(1300, 1, random), 0.1), random);
}

TEST_CASE("lists pruned with velocities hold every pair of the step that these make") {
    Random random(5);
    check_moving<2>({}, random);
    check_moving<2>(random_cloud<2>(60, 1, random), random);
    check_moving<3>({}, random);
}

TEST_CASE("the skin of a step covers what particles and walls move in it") {
    Random random;
    Particles<2> s = place<2>(random_cloud<2>(100, 1, random), 0.1);
    const StepSkin unknown = skin_of_step(travel(s, lanes_of_block(s, 0)), 0.1, 0, 1);
    CHECK(unknown.images == std::numeric_limits<double>::infinity());
    CHECK(unknown.particles == std::numeric_limits<double>::infinity());
    s.v[0][17] = 3;
    s.acceleration[1][50] = -2;
    const Travel most = travel(s, lanes_of_block(s, 0));
    CHECK(most.of_step(0.1) == doctest::Approx(0.32));
    CHECK(skin_of_step(most, 0.1, 0.05, 1).images >= 2 * (0.32 + 0.05));
    CHECK(skin_of_step(most, 1e-9, 0, 1).images == 0.02);
    CHECK(skin_of_step(most, 1e-9, 0, 1).particles == 0.02);
    // Two particles under accelerations of 2 at most: ½ Δt² (2 + 2), and what their relative velocity takes them.
    CHECK(skin_of_step(most, 0.1, 0.05, 1).particles >= 0.02 + 2 * 0.05);
    CHECK(skin_of_step(most, 0.1, 0.05, 1).step >= 0.1);
    CHECK(!outran(most, 0.1, skin_of_step(most, 0.1, 0, 1)));
    CHECK(outran(most, 0.1, StepSkin(0.59, 1, 0)));   // an image, at 3 m/s each
    CHECK(outran(most, 0.1, StepSkin(1, 0.019, 0)));  // a particle
}

TEST_CASE("a filter hides lanes, and only those it names") {
    Random random;
    const Particles<2> s = place<2>(random_cloud<2>(700, 1, random), 0.05);
    const EveryThird filter(s);
    const auto lists = lists_of<2>(s, 0.2, 0.05, serial_loop, &filter);
    Neighbours expected = by_double_loop(s, 0.2);
    for (std::size_t i = 0; i < s.count; ++i)
        std::erase_if(expected[i], [&](std::size_t j) { return filter.hidden(i, j); });
    CHECK(visited(s, lists, 0.2) == expected);
    CHECK(lists.pairs() == number_of_pairs(expected));
}

TEST_CASE("no particle at all: lists of nothing") {
    Particles<2> plane;
    Particles<3> space;
    plane.resize(0, 0);
    space.resize(0, 0);
    NeighbourLists<2> plane_lists{.radius = 1, .skin = 0.1, .blocks = {}};
    NeighbourLists<3> space_lists{.radius = 1, .skin = 0.1, .blocks = {}};
    NeighbourSearch<2>().build(plane, plane_lists, nullptr, serial_loop);
    NeighbourSearch<3>().build(space, space_lists, nullptr, serial_loop);
    CHECK(plane_lists.pairs() == 0);
    CHECK(space_lists.pairs() == 0);
}
