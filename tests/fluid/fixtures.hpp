// What the tests of the fluid share: the same random numbers on every run, disordered particles, bits of a state.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/fluid/fluid.hpp"

namespace aquagraph::fluid::test {

template <int D>
using Point = std::array<double, D>;

// Uniform in [-1, 1[.
class Random {
  public:
    explicit Random(std::uint64_t seed = 42) : state_(seed) {}
    double operator()() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
    }

  private:
    std::uint64_t state_;
};

// The centres of the cells of a box from the origin, each moved by up to `jitter` spacings along every direction.
template <int D>
std::vector<Point<D>> lattice(const std::array<int, D>& cells, double spacing, double jitter, Random& random) {
    std::size_t n = 1;
    for (const int along : cells) n *= static_cast<std::size_t>(along);
    std::vector<Point<D>> points(n);
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t rest = k;
        for (std::size_t d = D; d-- > 0;) {
            const auto along = static_cast<std::size_t>(cells[d]);
            points[k][d] = (static_cast<double>(rest % along) + 0.5 + jitter * random()) * spacing;
            rest /= along;
        }
    }
    return points;
}

inline constexpr Tait water{1000, 20};

// Particles and ghosts at these places, at rest, ω = Δx^D, p = 0.
template <int D>
Particles<D> place(const std::vector<Point<D>>& points, double spacing, const std::vector<Point<D>>& ghosts = {},
                   const Tait& tait = water) {
    Particles<D> s;
    s.resize(points.size(), ghosts.size());
    const auto put = [&](std::size_t lane, const Point<D>& x) {
        for (std::size_t d = 0; d < D; ++d) s.x[d][lane] = x[d];
        s.volume[lane] = std::pow(spacing, D);
        s.impedance[lane] = tait.reference_density * tait.sound_speed;
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        put(i, points[i]);
        s.id[i] = static_cast<std::int64_t>(i);
        s.mass[i] = tait.reference_density * s.volume[i];
        s.fullness[i] = 1;
        for (std::size_t d = 0; d < D; ++d) s.x_built[d][i] = points[i][d];
    }
    for (std::size_t g = 0; g < ghosts.size(); ++g) put(s.ghost_begin() + g, ghosts[g]);
    return s;
}

// Calls f(lane) for the fluid, then for the ghosts.
template <int D, class F>
void each_lane(const Particles<D>& s, F&& f) {
    for (std::size_t i = 0; i < s.count; ++i) f(i);
    for (std::size_t g = 0; g < s.ghost_count; ++g) f(s.ghost_begin() + g);
}

// States in which no two particles agree: velocities of up to 2 m/s, pressures of ±10 %, volumes of ±10 %, and
// gradients that fit none of it, so that the limiter meets all of its cases.
template <int D>
void disorder(Particles<D>& s, double spacing, Random& random) {
    each_lane(s, [&](std::size_t i) {
        s.volume[i] *= 1 + 0.1 * random();
        s.impedance[i] *= 1 + 0.1 * random();
        s.p[i] = 2000 * (1 + 0.1 * random());
        for (std::size_t d = 0; d < D; ++d) {
            s.v[d][i] = 2 * random();
            s.grad_p[d][i] = 200 / spacing * random();
            for (std::size_t e = 0; e < D; ++e) s.grad_v[d][e][i] = 2 / spacing * random();
        }
    });
    for (std::size_t i = 0; i < s.count; ++i) {
        s.mass[i] *= 1 + 0.1 * random();
        s.deviation[i] = 10 * random();
    }
}

template <int D>
NeighbourLists<D> lists_of(const Particles<D>& s, double radius, double skin, BlockLoop loop = serial_loop,
                           const PairFilter<D>* filter = nullptr, SearchMethod method = SearchMethod::cell_grid) {
    NeighbourLists<D> lists;
    lists.radius = radius;
    lists.skin = skin;
    NeighbourSearch<D> search;
    search.method = method;
    search.build(s, lists, filter, loop);
    return lists;
}

template <int D>
double distance(const Particles<D>& s, std::size_t i, std::size_t j) {
    double r2 = 0;
    for (std::size_t d = 0; d < D; ++d) r2 += (s.x[d][j] - s.x[d][i]) * (s.x[d][j] - s.x[d][i]);
    return std::sqrt(r2);
}

// Everything that a step carries on, by particle number: equal vectors are equal bits.
template <int D>
std::vector<double> state_by_id(const Particles<D>& s) {
    constexpr std::size_t fields = 2 * D + 2;
    std::vector<double> state(s.count * fields);
    for (std::size_t i = 0; i < s.count; ++i) {
        double* of = &state[static_cast<std::size_t>(s.id[i]) * fields];
        for (std::size_t d = 0; d < D; ++d) {
            of[d] = s.x[d][i];
            of[D + d] = s.v[d][i];
        }
        of[2 * D] = s.deviation[i];
        of[2 * D + 1] = s.mass[i];
    }
    return state;
}

}  // namespace aquagraph::fluid::test
