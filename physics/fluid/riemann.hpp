// The Riemann problem between two water states along a line, u positive from left to right.
//
// acoustic: the linearised solver (method 1.4), impedance Z = ρc of each side,
//     u_e = (Z_L u_L + Z_R u_R + p_L - p_R) / (Z_L + Z_R)
//     p_e = (Z_R p_L + Z_L p_R + Z_L Z_R (u_L - u_R)) / (Z_L + Z_R)
// exact: Newton on the two wave curves of Tait's equation: shocks by Rankine–Hugoniot, rarefactions by the Riemann
//     invariant u ± 2c/(γ-1) (Toro, Riemann Solvers, ch. 4; for p(ρ) only: Ivings et al. 1998). Reference for the
//     tests.
#pragma once
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/fluid/equation_of_state.hpp"

namespace aquagraph::fluid {

struct InterfaceState {
    double velocity, pressure;  // u_e [m/s], p_e [Pa]
};

inline InterfaceState acoustic_riemann(double u_L, double p_L, double Z_L, double u_R, double p_R, double Z_R) {
    const double sum = Z_L + Z_R;
    return {(Z_L * u_L + Z_R * u_R + p_L - p_R) / sum, (Z_R * p_L + Z_L * p_R + Z_L * Z_R * (u_L - u_R)) / sum};
}

namespace detail {
// Velocity jump across the wave that takes (p, ρ) to pressure p_e; positive for a shock.
inline double wave_curve(const Tait& tait, double p, double p_e) {
    const double deviation = tait.deviation(p), deviation_e = tait.deviation(p_e);
    const double rho = tait.reference_density + deviation, rho_e = tait.reference_density + deviation_e;
    if (p_e > p) return std::sqrt((p_e - p) * (deviation_e - deviation) / (rho * rho_e));
    return 2 / (tait.exponent - 1) * (tait.sound_speed_at(deviation_e) - tait.sound_speed_at(deviation));
}
}  // namespace detail

// Throws std::runtime_error when the states tear apart faster than water can follow (vacuum).
inline InterfaceState exact_riemann(const Tait& tait, double u_L, double p_L, double u_R, double p_R) {
    const auto impedance = [&](double p) {
        const double deviation = tait.deviation(p);
        return (tait.reference_density + deviation) * tait.sound_speed_at(deviation);
    };
    double p = acoustic_riemann(u_L, p_L, impedance(p_L), u_R, p_R, impedance(p_R)).pressure;
    const double vacuum = -tait.stiffness();
    p = std::max(p, vacuum * (1 - 1e-6));
    const auto residual = [&](double p_e) {
        return detail::wave_curve(tait, p_L, p_e) + detail::wave_curve(tait, p_R, p_e) - (u_L - u_R);
    };
    const double scale = tait.sound_speed;
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double f = residual(p);
        if (std::fabs(f) < 1e-14 * scale) break;
        const double step = 1e-7 * (tait.stiffness() + std::fabs(p));
        const double slope = (residual(p + step) - f) / step;
        double next = p - f / slope;
        if (!(next > vacuum)) next = 0.5 * (p + vacuum);
        if (std::fabs(next - vacuum) < 1e-9 * -vacuum)
            throw std::runtime_error("exact Riemann solver: the two states tear apart and leave a vacuum");
        p = next;
    }
    const double u = 0.5 * (u_L + u_R) + 0.5 * (detail::wave_curve(tait, p_R, p) - detail::wave_curve(tait, p_L, p));
    return {u, p};
}

}  // namespace aquagraph::fluid
