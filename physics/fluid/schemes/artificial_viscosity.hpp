// The pair flux of weakly compressible SPH with artificial viscosity (Monaghan 1992; thesis (2.44)-(2.45), R the
// support radius, v_ij = v_j - v_i, x_ij = x_j - x_i):
//     dρ_i/dt = -ρ_i Σ_j (v_j - v_i)·∇W_ij ω_j
//     ρ_i dv_i/dt = ρ_i g - Σ_j (p_i + p_j + ρ_i ρ_j Π_ij) ∇W_ij ω_j
//     Π_ij = -α R c_ij x_ij·v_ij / (ρ_ij (|x_ij|² + ε R²)) where the particles approach, else 0;   ε = 0.01
// ρ_i ρ_j c_ij/ρ_ij is taken as the harmonic mean of the impedances ρc: the same for equal states, symmetric, and
// different only to the second order in the difference of densities.
#pragma once
#include <algorithm>

#include "physics/fluid/schemes/pair_state.hpp"

namespace aquagraph::fluid {

template <int D, class Kernel>
struct ArtificialViscosityPair {
    Kernel kernel;
    double strength;   // α R [m]
    double softening;  // ε R² [m²]

    ArtificialViscosityPair(const Kernel& kernel, double alpha)
        : kernel(kernel), strength(alpha * kernel.radius()), softening(0.01 * kernel.radius() * kernel.radius()) {}

    [[gnu::always_inline]] PairFlux operator()(const PairState<D>& i, const FluxFields<D>& s, std::size_t j,
                                               double weight, double (&dx)[D]) const {
        double r, r2, w, approach = 0;
        pair_geometry<D>(i, s, j, weight, kernel, dx, r, r2, w);
        for (int d = 0; d < D; ++d) approach += (s.v[d][j] - i.v[d]) * dx[d];
        const double Z_i = i.impedance, Z_j = s.impedance[j];
        // One division: 2 Z_i Z_j / ((Z_i + Z_j)(r² + ε R²)).
        const double dissipation =
            -strength * std::min(approach, 0.0) * 2 * Z_i * Z_j / ((Z_i + Z_j) * (r * r + softening));
        return {(i.p + s.p[j] + dissipation) * w, approach * w, approach * w};
    }
};

}  // namespace aquagraph::fluid
