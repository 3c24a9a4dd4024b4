// The pair flux of δ-SPH (Antuono et al. 2010; thesis (2.46)-(2.48), R the support radius):
//     dρ_i/dt = -ρ_i Σ_j (v_j - v_i)·∇W_ij ω_j + Σ_j ψ_ij·∇W_ij ω_j
//     ρ_i dv_i/dt = ρ_i g - Σ_j (p_i + p_j - Π_ij) ∇W_ij ω_j
//     ψ_ij = δ R c0 [(ρ_j - ρ_i) - ½ (∇ρ_i + ∇ρ_j)·x_ij] x_ij/|x_ij|²,   Π_ij = α R c0 ρ0/2  x_ij·v_ij/|x_ij|²
// Densities enter the diffusion alone, as ρ0 + p/c0²: the same to first order in the compression, and the renormalised
// gradient of p serves both.
#pragma once
#include <cmath>

#include "physics/fluid/schemes/pair_state.hpp"

namespace aquagraph::fluid {

template <int D, class Kernel>
struct DeltaSphPair {
    Kernel kernel;
    double diffusion;  // δ R c0/(ρ0 c0²), so that the dilation below has the unit 1/s [m³ s/kg … per Pa]
    double viscosity;  // ½ α R c0 ρ0 [Pa s]

    DeltaSphPair(const Kernel& kernel, const Tait& tait, double delta, double alpha)
        : kernel(kernel),
          diffusion(delta * kernel.radius() / (tait.reference_density * tait.sound_speed)),
          viscosity(0.5 * alpha * kernel.radius() * tait.sound_speed * tait.reference_density) {}

    [[gnu::always_inline]] PairFlux operator()(const PairState<D>& i, const FluxFields<D>& s, std::size_t j,
                                               double weight, double (&dx)[D]) const {
        double r, r2, w;
        pair_geometry<D>(i, s, j, weight, kernel, dx, r, r2, w);
        double approach = 0, slopes = 0;  // x_ij·v_ij, (∇p_i + ∇p_j)·x_ij
        for (int d = 0; d < D; ++d) {
            approach += (s.v[d][j] - i.v[d]) * dx[d];
            slopes += (s.grad_p[d][j] + i.grad_p[d]) * dx[d];
        }
        // Π ∇W and ψ·∇W: ∇W_ij ω_j = w x_ij, so ψ·∇W ω_j = w × the bracket, and Π has 1/|x_ij|² left.
        const double dissipation = viscosity * approach / r2;
        const double jump = s.p[j] - i.p - 0.5 * slopes;
        return {(i.p + s.p[j] - dissipation) * w, (approach - diffusion * jump) * w, approach * w};
    }
};

}  // namespace aquagraph::fluid
