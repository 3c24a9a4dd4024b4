// What a particle and a point of a wall exchange: the innermost part of normal_flux.hpp.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/fluid/pair_loop.hpp"
#include "physics/fluid/time_integration.hpp"
#include "physics/fluid/walls/normal_flux.hpp"

namespace aquagraph::fluid {

// Between the fullness at which a support counts as open and that at which it counts as full, the corrections fade in.
inline double fade(double fullness) {
    const double s = std::clamp((fullness - 0.8) / 0.15, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

// Quadrature points as a lane loop reads them.
template <int D>
struct PointFields {
    const double* x[D];
    const double* n[D];
    const double* v[D];
    const double* area;

    explicit PointFields(const WallPoints<D>& points) : area(points.area.data()) {
        for (std::size_t d = 0; d < D; ++d) {
            x[d] = points.x[d].data();
            n[d] = points.normal[d].data();
            v[d] = points.velocity[d].data();
        }
    }
};

// One particle at its walls.
template <int D>
struct WallFlux {
    double x[D], v[D], p, grad_p[D], grad_v[D][D];
    double impedance;       // Z of the partial Riemann problem
    double sound_speed;     // c
    double most_pressure;   // limit of |p_L - p_i|: 0.01 ρ c²
    double least_pressure;  // of p_s

    WallFlux(const Particles<D>& s, std::size_t i, const FluxParameters& parameters, double inverse_density)
        : p(s.p[i]),
          impedance(s.impedance[i]),
          sound_speed(s.impedance[i] * inverse_density),
          most_pressure(0.01 * s.impedance[i] * sound_speed),
          least_pressure(s.fullness[i] < fullness_of_interior ? 0.0 : -std::numeric_limits<double>::max()) {
        const bool reconstruct = parameters.muscl || !parameters.is_riemann();
        for (std::size_t d = 0; d < D; ++d) {
            x[d] = s.x[d][i];
            v[d] = s.v[d][i];
            grad_p[d] = reconstruct ? s.grad_p[d][i] : parameters.gravity[d] / inverse_density;
            for (std::size_t e = 0; e < D; ++e) grad_v[e][d] = reconstruct ? s.grad_v[e][d][i] : 0.0;
        }
    }

    // Z, lowered where the walls would stop the particle faster than Runge–Kutta can follow.
    template <class Kernel>
    void lower_impedance(const PointFields<D>& s, const std::uint32_t* list, std::size_t n, const Kernel& kernel,
                         double gamma) {
        constexpr double fastest_decay = 4;  // c/R
        double lane[W] = {};
        for (std::size_t begin = 0; begin < n; begin += W)
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                const std::size_t k = list[begin + l];
                double r2 = 0;
                for (int d = 0; d < D; ++d) r2 += (s.x[d][k] - x[d]) * (s.x[d][k] - x[d]);
                lane[l] += kernel.value(std::sqrt(r2)) * s.area[k];
            }
        const double decay = add_lanes(lane) / gamma * kernel.radius();
        impedance *= std::min(1.0, fastest_decay / std::max(decay, 1e-9));
    }

    // Point k: weight = W_is A_s, p_s, and dilation = (u_s - v_i·n_s) W_is A_s.
    template <class Kernel>
    [[gnu::always_inline]] void operator()(const PointFields<D>& s, std::size_t k, const Kernel& kernel, double& weight,
                                           double& p_s, double& dilation) const {
        double dx[D], r2 = 0, p_L = p, u_w = 0, u_i = 0, u_L = 0, relative2 = 0;
        for (int d = 0; d < D; ++d) {
            dx[d] = s.x[d][k] - x[d];
            r2 += dx[d] * dx[d];
            p_L += grad_p[d] * dx[d];
            u_w += s.v[d][k] * s.n[d][k];
            u_i += v[d] * s.n[d][k];
        }
        for (int e = 0; e < D; ++e) {
            double v_L = v[e];
            for (int d = 0; d < D; ++d) v_L += grad_v[e][d] * dx[d];
            u_L += v_L * s.n[e][k];
            relative2 += (v_L - s.v[e][k]) * (v_L - s.v[e][k]);
        }
        p_L = std::fabs(p_L - p) < most_pressure ? p_L : p;
        u_L = relative2 < 0.01 * sound_speed * sound_speed ? u_L : u_i;
        weight = kernel.value(std::sqrt(r2)) * s.area[k];
        p_s = std::max(least_pressure, p_L + impedance * (u_L - u_w));
        dilation = weight * (u_w - u_i);
    }
};

}  // namespace aquagraph::fluid
