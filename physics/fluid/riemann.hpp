// The Riemann problem between two water states along a line, u positive from left to right.
//
// acoustic: the linearised solver (method 1.4), impedance Z = ρc of each side,
//     u_e = (Z_L u_L + Z_R u_R + p_L - p_R) / (Z_L + Z_R)
//     p_e = (Z_R p_L + Z_L p_R + Z_L Z_R (u_L - u_R)) / (Z_L + Z_R)
// exact: Newton on the two wave curves of Tait's equation: shocks by Rankine–Hugoniot, rarefactions by the Riemann
//     invariant u ± 2c/(γ-1) (Toro, Riemann Solvers, ch. 4; for p(ρ) only: Ivings et al. 1998). exact_riemann is for
//     any γ; exact_water_riemann for γ = 7, in powers of the density only and without branches, so that lanes of pairs
//     can be computed side by side.
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

namespace detail {
// x = ρ/ρ0 of water at pressure p: x⁷ = 1 + p/B. The start is exact to (p/B)², four Newton steps to rounding for
// -0.5 < p/B < 2, far beyond what weakly compressible water meets.
[[gnu::always_inline]] inline double water_compression(double p_over_B) {
    const double target = 1 + std::max(p_over_B, -0.5);
    double x = 1 + (target - 1) / (7 + 3 * (target - 1));
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
        const double x2 = x * x, x6 = x2 * x2 * x2;
        x -= (x6 * x - target) / (7 * x6);
    }
    return x;
}

// Velocity jump over c0 across the wave from compression x to y, and its slope in y. The shock's
// sqrt((p_y - p_x)(y - x)/(ρ0 x y)) is written with the divided difference S = Σ_k y^k x^(6-k) of y⁷, so that it stays
// exact for the weakest of shocks: (y - x) sqrt(S/(7 x y)), B = ρ0 c0²/7.
[[gnu::always_inline]] inline void water_wave(double x, double y, double& jump, double& slope) {
    double S = 1, dS = 0, power = 1;  // Horner in y with coefficients 1, x, … x⁶
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
        power *= x;
        dS = dS * y + S;
        S = S * y + power;
    }
    const double g = std::sqrt(S / (7 * x * y)), dg = 0.5 * g * (dS / S - 1 / y);
    const double shock = (y - x) * g, rarefaction = (y * y * y - x * x * x) / 3;
    jump = y > x ? shock : rarefaction;
    slope = y > x ? g + (y - x) * dg : y * y;
}
}  // namespace detail

// As exact_riemann for γ = 7. Where the states tear apart faster than c0/10 the interface density stays at half of ρ0.
[[gnu::always_inline]] inline InterfaceState exact_water_riemann(const Tait& tait, double u_L, double p_L, double u_R,
                                                                 double p_R) {
    const double B = tait.stiffness(), inverse_B = 1 / B, c0 = tait.sound_speed;
    const double x_L = detail::water_compression(p_L * inverse_B), x_R = detail::water_compression(p_R * inverse_B);
    const double approach = (u_L - u_R) / c0;
    double y = 0.5 * (x_L + x_R) + 0.5 * approach, f_L = 0, f_R = 0, slope_L, slope_R;
#pragma GCC unroll 5
    for (int k = 0; k < 5; ++k) {
        y = std::max(y, 0.5);
        detail::water_wave(x_L, y, f_L, slope_L);
        detail::water_wave(x_R, y, f_R, slope_R);
        y -= (f_L + f_R - approach) / (slope_L + slope_R);
    }
    y = std::max(y, 0.5);
    const double z = y - 1;
    return {0.5 * (u_L + u_R) + 0.5 * c0 * (f_R - f_L),
            B * z * (7 + z * (21 + z * (35 + z * (35 + z * (21 + z * (7 + z))))))};
}

}  // namespace aquagraph::fluid
