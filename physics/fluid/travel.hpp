// How far particles have gone since the lists were built, and how far they will go in the coming step.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

struct Travel {
    // Largest ones, squared [m², m²/s², m²/s⁴]; speed2 counts the shift too.
    double displacement2 = 0, speed2 = 0, acceleration2 = 0, shift2 = 0;

    double so_far() const { return std::sqrt(displacement2); }
    // No stage of Runge–Kutta takes a particle further than Δt |v| + ½ Δt² |a|; the acceleration is that of the step
    // before and counts twice, for it may grow.
    double of_step(double dt) const { return dt * (std::sqrt(speed2) + dt * std::sqrt(acceleration2)); }
};

inline Travel largest(const Travel& a, const Travel& b) {
    return {std::max(a.displacement2, b.displacement2), std::max(a.speed2, b.speed2),
            std::max(a.acceleration2, b.acceleration2), std::max(a.shift2, b.shift2)};
}

template <int D>
Travel travel(const Particles<D>& s, LaneRange lanes) {
    Travel most;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        Travel own;
        for (std::size_t d = 0; d < D; ++d) {
            const double dx = s.x[d][i] - s.x_built[d][i];
            own.displacement2 += dx * dx;
            own.speed2 += s.v[d][i] * s.v[d][i];
            own.acceleration2 += s.acceleration[d][i] * s.acceleration[d][i];
            if (s.has_shift) own.shift2 += s.shift[d][i] * s.shift[d][i];
        }
        if (s.has_shift) {  // it is renewed in every step, and may grow
            const double speed = std::sqrt(own.speed2) + 2 * std::sqrt(own.shift2);
            own.speed2 = speed * speed;
        }
        most = largest(most, own);
    }
    return most;
}

// The skin of the lists of one step. A particle and the mirror image of another come closer by at most twice what a
// particle moves plus twice what a wall does. Two particles by no more than their relative velocity takes them, and
// what accelerations add to that: of the speed itself a fifth is allowed for, lest water at the moment of an impact
// outrun the acceleration of the step before. Before the first step, when no acceleration is known, there is no bound.
inline StepSkin skin_of_step(const Travel& travel, double dt, double wall_travel, double radius) {
    constexpr double none = std::numeric_limits<double>::infinity();
    if (travel.acceleration2 == 0) return {none, none, 0};
    const double least = 0.02 * radius, speed = std::sqrt(travel.speed2), shift = 2 * std::sqrt(travel.shift2),
                 gained = dt * std::sqrt(travel.acceleration2);
    return {std::max(least, 2.2 * (travel.of_step(dt) + wall_travel)),
            std::max(least, 2.2 * (dt * (0.2 * speed + shift + gained) + wall_travel)), 1.1 * dt};
}

// Whether particles whose largest speed and acceleration are known by now may have gone further in the step before than
// its lists allowed for.
inline bool outran(const Travel& travel, double dt, const StepSkin& allowed) {
    return 2 * dt * std::sqrt(travel.speed2) > allowed.images ||
           dt * dt * std::sqrt(travel.acceleration2) > allowed.particles;
}

}  // namespace aquagraph::fluid
