// The same water in one period along x and in two: what tests of periodic domains compare.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/fluid/fixtures.hpp"

namespace aquagraph::fluid::test {

// At the places of one period, and one `length` further on where there are two; v: of one period's particles.
template <int D>
Particles<D> in_periods(int periods, std::vector<Point<D>> points, const std::vector<Vec<D>>& v, double length,
                        double spacing) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n && periods == 2; ++i) {
        points.push_back(points[i]);
        points.back()[0] += length;
    }
    Particles<D> particles = place<D>(points, spacing);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t d = 0; d < D; ++d) particles.v[d][i] = v[i % n][int(d)];
    return particles;
}

// Every particle of two periods does what its twin in one does, and something happens at all.
template <int D>
void check_same_in_both(const Particles<D>& in_one, const Particles<D>& in_two, double length) {
    const auto one = state_by_id(in_one), two = state_by_id(in_two);
    double difference = 0, largest = 0;
    for (std::size_t k = 0; k < two.size(); ++k) {
        double a = one[k % one.size()], b = two[k];
        if (k % (2 * D + 2) == 0) a = b - length * std::round((b - a) / length) - a, b = 0;
        difference = std::max(difference, std::fabs(a - b));
        if (k % (2 * D + 2) == 2 * D) largest = std::max(largest, std::fabs(b));
    }
    CHECK(largest > 0.1);  // [kg/m³]
    CAPTURE(difference);
    CHECK(difference < 1e-8);
}

}  // namespace aquagraph::fluid::test
