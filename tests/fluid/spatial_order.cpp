// The order of particles: a permutation, the same everywhere, that makes clusters compact.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/fluid/spatial_order.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

template <int D>
void check_order(const std::array<int, D>& cells) {
    CAPTURE(D);
    const double spacing = 0.1;
    Random random;
    auto points = lattice<D>(cells, spacing, 0.1, random);
    for (std::size_t k = points.size(); k-- > 1;)  // shuffled
        std::swap(points[k], points[static_cast<std::size_t>(0.5 * (1 + random()) * static_cast<double>(k + 1))]);
    points.push_back(points[3]);  // a tie
    Particles<D> s = place<D>(points, spacing);
    for (std::size_t i = 0; i < s.count; ++i) {
        s.mass[i] = static_cast<double>(i) + 0.25;
        s.deviation[i] = static_cast<double>(i) + 0.5;
        s.fullness[i] = static_cast<double>(i) + 0.75;
        for (std::size_t d = 0; d < D; ++d) s.v[d][i] = static_cast<double>(10 * i + d);
    }

    SpatialOrder<D> sorter, fresh;
    const auto first = sorter.sort(s.x, s.count, spacing);
    const std::vector<std::uint32_t> order(first.begin(), first.end());
    const auto again = sorter.sort(s.x, s.count, spacing), other = fresh.sort(s.x, s.count, spacing);
    CHECK(std::equal(order.begin(), order.end(), again.begin(), again.end()));
    CHECK(std::equal(order.begin(), order.end(), other.begin(), other.end()));
    auto sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> all(points.size());
    std::iota(all.begin(), all.end(), 0u);
    CHECK(sorted == all);

    Reorder<D>().apply(s, order);
    for (std::size_t i = 0; i < s.count; ++i) {  // everything goes along
        const auto from = static_cast<std::size_t>(s.id[i]);
        CHECK(from == order[i]);
        CHECK(s.mass[i] == static_cast<double>(from) + 0.25);
        CHECK(s.deviation[i] == static_cast<double>(from) + 0.5);
        CHECK(s.fullness[i] == static_cast<double>(from) + 0.75);
        for (std::size_t d = 0; d < D; ++d) {
            CHECK(s.x[d][i] == points[from][d]);
            CHECK(s.v[d][i] == static_cast<double>(10 * from + d));
        }
    }
    // Mean size of a cluster, by its largest extent.
    double mean = 0;
    for (std::size_t c = 0; c < s.clusters(); ++c) {
        double extent = 0;
        const auto lanes = lanes_of_cluster(s, c);
        for (std::size_t d = 0; d < D; ++d) {
            const auto [low, high] =
                std::minmax_element(s.x[d].begin() + long(lanes.begin), s.x[d].begin() + long(lanes.end));
            extent = std::max(extent, *high - *low);
        }
        mean += extent / static_cast<double>(s.clusters());
    }
    CAPTURE(mean / spacing);
    CHECK(mean < 4 * spacing);
}

}  // namespace

TEST_CASE("the order is a deterministic permutation into compact clusters, and everything goes along") {
    check_order<2>({40, 33});
    check_order<3>({12, 11, 10});
}

TEST_CASE("no particles need no order") {
    Vectors<2> none;
    CHECK(SpatialOrder<2>().sort(none, 0, 0.1).empty());
}

TEST_CASE("a few far particles cost no memory") {
    Random random;
    auto points = lattice<3>({6, 6, 6}, 0.1, 0.1, random);
    points[17] = {1e6, -1e6, 3e5};
    Particles<3> s = place<3>(points, 0.1);
    SpatialOrder<3> sorter;
    const auto order = sorter.sort(s.x, s.count, 0.1);  // columns of 0.2 m would take 100 TB
    std::vector<std::uint32_t> sorted(order.begin(), order.end());
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); ++k) CHECK(sorted[k] == k);
    CHECK(sorted.size() == points.size());
}
