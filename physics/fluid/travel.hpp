// How far particles have gone since the lists were built, and how far they will go in the coming step.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

struct Travel {
    double displacement2 = 0, speed2 = 0, acceleration2 = 0;  // largest ones, squared [m², m²/s², m²/s⁴]

    double so_far() const { return std::sqrt(displacement2); }
    // No stage of Runge–Kutta takes a particle further than Δt |v| + ½ Δt² |a|; the acceleration is that of the step
    // before and counts twice, for it may grow.
    double of_step(double dt) const { return dt * (std::sqrt(speed2) + dt * std::sqrt(acceleration2)); }
};

inline Travel largest(const Travel& a, const Travel& b) {
    return {std::max(a.displacement2, b.displacement2), std::max(a.speed2, b.speed2),
            std::max(a.acceleration2, b.acceleration2)};
}

template <int D>
Travel travel(const Particles<D>& s, LaneRange lanes) {
    Travel most;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        Travel own;
        double shift2 = 0;
        for (std::size_t d = 0; d < D; ++d) {
            const double dx = s.x[d][i] - s.x_built[d][i];
            own.displacement2 += dx * dx;
            own.speed2 += s.v[d][i] * s.v[d][i];
            own.acceleration2 += s.acceleration[d][i] * s.acceleration[d][i];
            if (s.has_shift) shift2 += s.shift[d][i] * s.shift[d][i];
        }
        if (s.has_shift) {  // it is renewed in every step, and may grow
            const double speed = std::sqrt(own.speed2) + 2 * std::sqrt(shift2);
            own.speed2 = speed * speed;
        }
        most = largest(most, own);
    }
    return most;
}

// The skin of the lists of one step: two particles, or a particle and the mirror image of another, come closer by at
// most twice what a particle moves plus twice what a wall does. Before the first step, when no acceleration is known,
// there is no bound.
inline double skin_of_step(const Travel& travel, double dt, double wall_travel, double radius) {
    if (travel.acceleration2 == 0) return std::numeric_limits<double>::infinity();
    return std::max(0.02 * radius, 2.2 * (travel.of_step(dt) + wall_travel));
}

}  // namespace aquagraph::fluid
