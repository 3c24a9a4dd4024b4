// The pair flux of Riemann-SPH in ALE form, with mass exchange (thesis (2.53), Vila 1999; with shifting (2.93), Oger et
// al. 2016): particles move with the transport velocity v0 = v + δv, the interface with v0_ij = ½ (v0_i + v0_j), and
//     dω_i/dt = ω_i Σ 2 (v0_ij - v0_i)·∇W_ij ω_j
//     dm_i/dt = -Σ 2 ρ_e (v_e - v0_ij)·∇W_ij ω_i ω_j
//     d(m_i v_i)/dt = m_i g - Σ 2 [ρ_e v_e (v_e - v0_ij) + p_e]·∇W_ij ω_i ω_j
// v_e is the velocity of the side that the mass comes from, its component along e_ij replaced by the Riemann problem's;
// ρ_e follows from p_e by Tait's equation.
//
// No mass passes a wall: between a particle and its mirror image the interface moves with the water, v0_ij = v_e
// (exchange = 0), which is the mass-conserving scheme. The volume stays consistent, since Σ ∇W_ij ω_j vanishes over
// fluid and images together.
#pragma once
#include "physics/fluid/schemes/riemann_pair.hpp"

namespace aquagraph::fluid {

template <int D>
struct AleFlux {
    double dilation;     // dω_i/dt = ω_i Σ dilation [1/s]
    double mass;         // dm_i/dt = -ω_i Σ mass [kg/(m^D s)]
    double momentum[D];  // d(m_i v_i)/dt = m_i g - ω_i Σ momentum
};

// ρ of Tait's equation from p, to the fourth order in s = p/(ρ0 c0²): smooth, without a root, for any γ.
struct DensitySeries {
    double rho_0, inverse_modulus, c2, c3, c4;
    explicit DensitySeries(const Tait& tait)
        : rho_0(tait.reference_density),
          inverse_modulus(1 / (tait.reference_density * tait.sound_speed * tait.sound_speed)),
          c2((1 - tait.exponent) / 2),
          c3(c2 * (1 - 2 * tait.exponent) / 3),
          c4(c3 * (1 - 3 * tait.exponent) / 4) {}
    [[gnu::always_inline]] double operator()(double p) const {
        const double s = p * inverse_modulus;
        return rho_0 * (1 + s * (1 + s * (c2 + s * (c3 + s * c4))));
    }
};

template <int D, class Kernel, bool muscl, RiemannSolver solver>
struct AlePair {
    Kernel kernel;
    Tait tait;
    DensitySeries density;

    // δv: the shift of i and j; exchange: 1, or 0 where j is i's or another's image in a wall.
    [[gnu::always_inline]] AleFlux<D> operator()(const PairState<D>& i, const double (&shift_i)[D],
                                                 const FluxFields<D>& s, const double* const (&shift)[D], std::size_t j,
                                                 double seen, double exchange) const {
        double dx[D], r, r2, w, p_e, U_e;
        pair_geometry<D>(i, s, j, s.volume[j] * seen, kernel, dx, r, r2, w);
        // All velocities relative to v_i.
        const auto at = reconstruct<D, muscl>(i, s, j, dx);
        constexpr double to_v = 1 / at.scale, to_U = 0.5 * to_v;
        solve_riemann<solver>(tait, r, r2, at, i.impedance, s.impedance[j], p_e, U_e);
        p_e *= to_U;
        U_e *= to_U;
        double U0_i = 0, U0_j = 0;
        for (int d = 0; d < D; ++d) {
            U0_i += shift_i[d] * dx[d];
            U0_j += (s.v[d][j] - i.v[d] + shift[d][j]) * dx[d];
        }
        const double U0 = exchange > 0 ? 0.5 * (U0_i + U0_j) : U_e;
        const double flow = U_e - U0;  // > 0: from i to j
        const double rho_flow = density(p_e) * flow;
        const double correction = (U_e - to_U * (flow > 0 ? at.U_L : at.U_L + at.U_jump)) / r2;
        AleFlux<D> flux;
        flux.dilation = 2 * (U0 - U0_i) * w;
        flux.mass = 2 * rho_flow * w;
        for (int d = 0; d < D; ++d) {
            const double v_e = i.v[d] + to_v * (flow > 0 ? at.v_L[d] : at.v_R[d]) + correction * dx[d];
            flux.momentum[d] = 2 * (rho_flow * v_e + p_e * dx[d]) * w;
        }
        return flux;
    }
};

}  // namespace aquagraph::fluid
