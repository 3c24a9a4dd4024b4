// Still water between walls of normal fluxes, and how far it is from rest.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tests/fluid/basins.hpp"
#include "tests/fluid/normal_flux_driver.hpp"

namespace aquagraph::fluid::test {

inline constexpr double g = 9.81;

// Water of this depth in boxes, R = ratio Δx, hydrostatic.
template <int D>
Fluid<D> still_fluid(double spacing, double depth, const std::vector<FillBox<D>>& boxes, double ratio = 4,
                     FluxParameters flux = {}) {
    flux.gravity[D - 1] = -g;
    Fluid<D> fluid = make_fluid<D>(spacing, Tait{1000, 10 * std::sqrt(g * depth)}, flux);
    fluid.kernel = WendlandC2<D>(ratio * spacing);
    fluid.lists.radius = ratio * spacing;
    fluid.lists.skin = skin_ratio<D>(true) * ratio * spacing;
    fill<D>(fluid.particles, boxes, spacing, fluid.tait, g, depth);
    return fluid;
}

// An open tank whose corner is the origin.
template <int D>
Panels<D> box_tank(const Vec<D>& size) {
    Panels<D> panels;
    if constexpr (D == 2) {
        panels = tank(size.x(), size.y());
    } else {
        const double a = size.x(), b = size.y(), h = size.z();
        panels.add_wall("tank",
                        {{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}, {0, 0, h}, {a, 0, h}, {a, b, h}, {0, b, h}},
                        {{0, 1, 2},
                         {0, 2, 3},
                         {0, 4, 5},
                         {0, 5, 1},
                         {1, 5, 6},
                         {1, 6, 2},
                         {2, 6, 7},
                         {2, 7, 3},
                         {3, 7, 4},
                         {3, 4, 0}},
                        false);
    }
    return panels;
}

// Fastest and root mean square of the velocity over √(gH), largest error over ρ g H of the pressure deeper than R
// against the hydrostatic one, error of the volume of all.
struct Rest {
    double fastest = 0, mean = 0, pressure_error = 0, volume_error = 0;
};

template <int D>
Rest rest_of(const FluxDriver<D>& driver, double depth, double volume) {
    const auto& s = driver.fluid.particles;
    Rest rest;
    double total = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        double v2 = 0;
        for (std::size_t d = 0; d < D; ++d) v2 += s.v[d][i] * s.v[d][i];
        v2 /= g * depth;
        rest.fastest = std::max(rest.fastest, std::sqrt(v2));
        rest.mean += v2 / double(s.count);
        const double below = depth - s.x[D - 1][i];
        const double expected = driver.fluid.tait.pressure(hydrostatic_deviation(driver.fluid.tait, g, below));
        if (below > driver.fluid.kernel.radius())
            rest.pressure_error = std::max(rest.pressure_error, std::fabs(s.p[i] - expected) / (1000 * g * depth));
        total += s.volume[i];
    }
    rest.mean = std::sqrt(rest.mean);
    rest.volume_error = std::fabs(total / volume - 1);
    return rest;
}

// The worst of all after each of these times that sound needs from the bottom to the surface.
template <int D>
Rest worst_rest(FluxDriver<D>& driver, double depth, double volume, int acoustic_times) {
    const double start = driver.time;
    Rest worst;
    for (int k = 1; k <= acoustic_times; ++k) {
        driver.run(start + k * depth / driver.fluid.tait.sound_speed);
        const Rest rest = rest_of(driver, depth, volume);
        worst.fastest = std::max(worst.fastest, rest.fastest);
        worst.mean = std::max(worst.mean, rest.mean);
        worst.pressure_error = std::max(worst.pressure_error, rest.pressure_error);
        worst.volume_error = std::max(worst.volume_error, rest.volume_error);
    }
    CAPTURE(worst.fastest);
    CAPTURE(worst.mean);
    CAPTURE(worst.pressure_error);
    MESSAGE("fastest " << worst.fastest << ", mean " << worst.mean << ", pressure " << worst.pressure_error
                       << ", volume " << worst.volume_error);
    return worst;
}

}  // namespace aquagraph::fluid::test
