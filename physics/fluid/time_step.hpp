// Largest stable step: Δt = K min_i(R/c_i) (thesis (2.61)), K' sqrt(R/|a|) with K' = 0.25 where accelerations are what
// limits, and where viscosity does, so short that velocities decay by at most 2 per step
// (TimeIntegration::decay_of_step), which is where (2.64), 0.125 R² ρ0/µ, would be too long (viscous_decay). K = 0.375
// for RK4.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

struct StepLimits {
    double sound = std::numeric_limits<double>::infinity();         // [s]
    double acceleration = std::numeric_limits<double>::infinity();  // [s]
    double viscosity = std::numeric_limits<double>::infinity();     // [s]
    double step() const { return std::min({sound, acceleration, viscosity}); }
    const char* name() const {
        return viscosity < std::min(sound, acceleration) ? "viscosity"
               : sound <= acceleration                   ? "sound speed"
                                                         : "acceleration";
    }
};

inline StepLimits combine(const StepLimits& a, const StepLimits& b) {
    return {std::min(a.sound, b.sound), std::min(a.acceleration, b.acceleration), std::min(a.viscosity, b.viscosity)};
}

// Over these particles; the impedance ρc of each gives its sound speed. viscous_rate [1/s]: the step is at most its
// inverse (Fluid::viscous_rate).
template <int D>
StepLimits step_limits(const Particles<D>& s, double cfl, double radius, LaneRange lanes, double viscous_rate = 0) {
    double fastest = 0, strongest = 0;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        double a2 = 0;
        for (std::size_t d = 0; d < D; ++d) a2 += s.acceleration[d][i] * s.acceleration[d][i];
        strongest = std::max(strongest, a2);
        fastest = std::max(fastest, s.impedance[i] * s.volume[i] / s.mass[i]);
    }
    StepLimits limits;
    if (fastest > 0) limits.sound = cfl * radius / fastest;
    if (strongest > 0) limits.acceleration = 0.25 * std::sqrt(radius / std::sqrt(strongest));
    if (viscous_rate > 0) limits.viscosity = 1 / viscous_rate;
    return limits;
}

}  // namespace aquagraph::fluid
