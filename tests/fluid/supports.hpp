// How full the supports of particles beside walls are, and whether a place behind a wall counts twice: for the tests of
// corners in the plane and in space.
#pragma once
#include <algorithm>
#include <cmath>

#include "tests/fluid/basins.hpp"

namespace aquagraph::fluid::test {

// Fullness and partition of unity of some particles.
struct Spread {
    double least = 10, most = 0, least_unity = 10, most_unity = 0, mean_unity = 0;
    std::size_t count = 0;
};

// Of the particles that `chosen` picks, by place.
template <int D, class Chosen>
Spread spread(const Driver<D>& driver, Chosen&& chosen) {
    Spread found;
    const auto& s = driver.fluid.particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (!chosen(position(s, i))) continue;
        ++found.count;
        found.least = std::min(found.least, s.fullness[i]);
        found.most = std::max(found.most, s.fullness[i]);
        const double unity = partition_of_unity(driver.fluid, i);
        found.least_unity = std::min(found.least_unity, unity);
        found.most_unity = std::max(found.most_unity, unity);
        found.mean_unity += unity;
    }
    found.mean_unity /= double(found.count);
    return found;
}

// Seen places closer than 0.3 Δx to each other: each would count twice, unless the two share it
// (walls/edge_shares.hpp). Not counted are those of a line of sight that grazes, for which grazes(i, j): rounding
// decides where it enters the wall.
template <int D, class Grazes>
std::size_t places_seen_twice(const Driver<D>& driver, Grazes&& grazes) {
    const auto& s = driver.fluid.particles;
    const double once = 1.001 * std::pow(driver.fluid.spacing, D);
    std::size_t twice = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const auto seen = neighbours_of(driver.fluid, i);
        for (std::size_t a = 0; a < seen.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                twice += distance(s, seen[a], seen[b]) < 0.3 * driver.fluid.spacing &&
                         s.volume[seen[a]] + s.volume[seen[b]] > once && !grazes(i, seen[a]);
    }
    return twice;
}

}  // namespace aquagraph::fluid::test
