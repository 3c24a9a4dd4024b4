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

// The two states of a pair at the interface between them, along dx. Of the velocities twice the values, relative to
// particle i: so the halves of the reconstruction and the factor 2 of the flux cost nothing, nor does i's own velocity.
template <int D>
struct InterfaceSides {
    double p_L, p_R;
    double v_L[D], v_R[D];
    double U_L, U_jump;  // U_jump: U_R - U_L, the same bits from either side of the pair
};

template <int D, bool muscl>
[[gnu::always_inline]] inline InterfaceSides<D> reconstruct(const PairState<D>& i, const FluxFields<D>& s,
                                                            std::size_t j, const double (&dx)[D]) {
    InterfaceSides<D> at;
    at.p_L = i.p;
    at.p_R = s.p[j];
    at.U_L = at.U_jump = 0;
    if constexpr (muscl) {
        double slope_i = 0, slope_j = 0;
        for (int d = 0; d < D; ++d) {
            slope_i += i.grad_p[d] * dx[d];
            slope_j += s.grad_p[d][j] * dx[d];
        }
        const double dp = s.p[j] - i.p;
        at.p_L += 0.5 * minmod(slope_i, dp);
        at.p_R -= 0.5 * minmod(slope_j, dp);
    }
    for (int e = 0; e < D; ++e) {
        const double dv = s.v[e][j] - i.v[e];
        double limited_i = 0, limited_j = 0;
        if constexpr (muscl) {
            double slope_i = 0, slope_j = 0;
            for (int d = 0; d < D; ++d) {
                slope_i += i.grad_v[e][d] * dx[d];
                slope_j += s.grad_v[e][d][j] * dx[d];
            }
            limited_i = minmod(slope_i, dv);
            limited_j = minmod(slope_j, dv);
            at.U_L += limited_i * dx[e];
        }
        at.v_L[e] = limited_i;
        at.v_R[e] = (dv + dv) - limited_j;
        at.U_jump += ((dv + dv) - (limited_i + limited_j)) * dx[e];
    }
    return at;
}

// 2 p_e and 2 U_e = 2 u_e r of the Riemann problem between these states; Z = ρc of the two particles.
template <RiemannSolver solver, int D>
[[gnu::always_inline]] inline void solve_riemann(const Tait& tait, double r, const InterfaceSides<D>& at, double Z_L,
                                                 double Z_R, double& p_e, double& U_e) {
    if constexpr (solver == RiemannSolver::exact) {
        const double half_over_r = 0.5 / r;
        const InterfaceState state =
            exact_water_riemann(tait, at.U_L * half_over_r, at.p_L, (at.U_L + at.U_jump) * half_over_r, at.p_R);
        p_e = 2 * state.pressure;
        U_e = 2 * state.velocity * r;
    } else {
        // The acoustic solution of riemann.hpp with u = U/r and one division. The velocity as the change across the
        // wave that runs into the left state; the pressure, whose force must be the same on both, in what both share:
        //     2 p_e = p_L + p_R - [(Z_R - Z_L)(p_R - p_L) + 2 Z_L Z_R (u_R - u_L)] / (Z_L + Z_R)
        const double inverse = 1 / (r * (Z_L + Z_R)), push = (at.p_R - at.p_L) * r;
        U_e = at.U_L + (Z_R * at.U_jump - (push + push)) * inverse * r;
        double jump = at.U_jump;
        if constexpr (solver == RiemannSolver::low_dissipation)  // c = ½ Z/ρ0
            jump *= std::min(3 * tait.reference_density * std::max(-jump, 0.0) * inverse, 1.0);
        p_e = at.p_L + at.p_R - ((Z_R - Z_L) * push + Z_L * Z_R * jump) * inverse;
    }
}

template <int D, class Kernel, bool muscl, RiemannSolver solver>
struct RiemannPair {
    Kernel kernel;
    Tait tait;

    [[gnu::always_inline]] PairFlux operator()(const PairState<D>& i, const FluxFields<D>& s, std::size_t j,
                                               double seen, double (&dx)[D]) const {
        double r, w, twice_p_e, twice_U_e;
        pair_geometry<D>(i, s, j, seen, kernel, dx, r, w);
        solve_riemann<solver>(tait, r, reconstruct<D, muscl>(i, s, j, dx), i.impedance, s.impedance[j], twice_p_e,
                              twice_U_e);
        return {twice_p_e * w, twice_U_e * w};
    }
};

}  // namespace aquagraph::fluid
