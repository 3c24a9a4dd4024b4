// The pair flux of Riemann-SPH, locally mass conserving (thesis (2.55)):
//     dω_i/dt = ω_i Σ_j 2 (v_e - v_i)·∇W_ij ω_j
//     dv_i/dt = g - (ω_i/m_i) Σ_j 2 p_e ∇W_ij ω_j
// (v_e·e_ij, p_e) solve the Riemann problem along e_ij between the reconstructed states of i (left) and j (right).
//
// With ∇W_ij ω_j = w (x_j - x_i) and U = v·(x_j - x_i) = u r the divisions by r shrink to one. The flux is
// antisymmetric in the pair: what i gets, j loses.
#pragma once
#include <algorithm>
#include <cmath>

#include "physics/fluid/choices.hpp"
#include "physics/fluid/reconstruction.hpp"
#include "physics/fluid/riemann.hpp"
#include "physics/fluid/schemes/pair_state.hpp"

namespace aquagraph::fluid {

// The two states of a pair at the interface between them, along dx, as multiples of what they are: so the halves of the
// reconstruction, the factor 2 of the flux and i's own velocity cost nothing. Powers of two change no digit.
template <int D, bool muscl>
struct InterfaceSides {
    static constexpr double scale = muscl ? 4 : 1;
    double p_L, p_R;        // scale × p
    double v_L[D], v_R[D];  // scale × v, relative to particle i
    double approach;        // scale × (v_j - v_i)·dx
    double U_L, U_jump;  // 2 scale × (v_L - v_i)·dx and (v_R - v_L)·dx; the jump's bits are the same from either side
};

template <int D, bool muscl>
[[gnu::always_inline]] inline InterfaceSides<D, muscl> reconstruct(const PairState<D>& i, const FluxFields<D>& s,
                                                                   std::size_t j, const double (&dx)[D]) {
    InterfaceSides<D, muscl> at;
    double twice_dx[D];
    for (int d = 0; d < D; ++d) twice_dx[d] = dx[d] + dx[d];
    at.approach = at.U_L = at.U_jump = 0;
    if constexpr (muscl) {
        double slope_i = 0, slope_j = 0;  // twice ∇φ·dx
        for (int d = 0; d < D; ++d) {
            slope_i += i.grad_p[d] * twice_dx[d];
            slope_j += s.grad_p[d][j] * twice_dx[d];
        }
        const double dp = s.p[j] - i.p;
        at.p_L = at.scale * i.p + twice_minmod(slope_i, dp);
        at.p_R = at.scale * s.p[j] - twice_minmod(slope_j, dp);
        for (int e = 0; e < D; ++e) {
            const double dv = s.v[e][j] - i.v[e], size = std::fabs(dv);
            slope_i = slope_j = 0;
            for (int d = 0; d < D; ++d) {
                slope_i += i.grad_v[e][d] * twice_dx[d];
                slope_j += s.grad_v[e][d][j] * twice_dx[d];
            }
            const double limited_i = twice_minmod(slope_i, dv), limited_j = twice_minmod(slope_j, dv);
            at.v_L[e] = limited_i;
            at.v_R[e] = at.scale * dv - limited_j;
            at.U_L += limited_i * twice_dx[e];
            // v_R - v_L, from the parts of the limiter: GCC makes a multiplication of dv + dv.
            const double twice_dv = (dv + size) + (dv - size);
            at.approach += twice_dv * twice_dx[e];
            at.U_jump += ((twice_dv - limited_i) + (twice_dv - limited_j)) * twice_dx[e];
        }
    } else {
        at.p_L = i.p;
        at.p_R = s.p[j];
        for (int e = 0; e < D; ++e) {
            at.v_L[e] = 0;
            at.v_R[e] = s.v[e][j] - i.v[e];
            at.approach += at.v_R[e] * dx[e];
            at.U_jump += at.v_R[e] * twice_dx[e];
        }
    }
    return at;
}

// 2 scale × p_e and U_e = u_e r of the Riemann problem between these states; Z = ρc of the two particles.
template <RiemannSolver solver, int D, bool muscl>
[[gnu::always_inline]] inline void solve_riemann(const Tait& tait, double r, double r_squared,
                                                 const InterfaceSides<D, muscl>& at, double Z_L, double Z_R,
                                                 double& p_e, double& U_e) {
    constexpr double scale = InterfaceSides<D, muscl>::scale;
    if constexpr (solver == RiemannSolver::exact) {
        const double to_u = 0.5 / (scale * r);
        const InterfaceState state =
            exact_water_riemann(tait, at.U_L * to_u, at.p_L / scale, (at.U_L + at.U_jump) * to_u, at.p_R / scale);
        p_e = 2 * scale * state.pressure;
        U_e = 2 * scale * state.velocity * r;
    } else {
        // The acoustic solution of riemann.hpp with u = U/r and one division. The velocity as the change across the
        // wave that runs into the left state; the pressure, whose force must be the same on both, in what both share:
        //     2 p_e = p_L + p_R - [(Z_R - Z_L)(p_R - p_L) + 2 Z_L Z_R (u_R - u_L)] / (Z_L + Z_R)
        const double r2 = r_squared, inverse_2 = 1 / (r2 * (Z_L + Z_R)), push = (at.p_R - at.p_L) * r,
                     inverse = inverse_2 * r;
        U_e = at.U_L + (Z_R * at.U_jump - (push + push)) * (inverse_2 * r2);
        double jump = at.U_jump;
        if constexpr (solver == RiemannSolver::low_dissipation)  // c = ½ Z/ρ0
            jump *= std::min(3 / scale * tait.reference_density * std::max(-jump, 0.0) * inverse, 1.0);
        p_e = at.p_L + at.p_R - ((Z_R - Z_L) * push + Z_L * Z_R * jump) * inverse;
    }
}

template <int D, class Kernel, bool muscl, RiemannSolver solver>
struct RiemannPair {
    Kernel kernel;
    Tait tait;

    [[gnu::always_inline]] PairFlux operator()(const PairState<D>& i, const FluxFields<D>& s, std::size_t j,
                                               double weight, double (&dx)[D]) const {
        constexpr double scale = InterfaceSides<D, muscl>::scale;
        double r, r2, w, p_e, U_e;
        pair_geometry<D>(i, s, j, weight, kernel, dx, r, r2, w, 1 / scale);
        const auto at = reconstruct<D, muscl>(i, s, j, dx);
        solve_riemann<solver>(tait, r, r2, at, i.impedance, s.impedance[j], p_e, U_e);
        return {p_e * w, U_e * w, at.approach * w};
    }
};

}  // namespace aquagraph::fluid
