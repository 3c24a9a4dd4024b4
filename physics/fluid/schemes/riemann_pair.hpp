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

// The two states of a pair at the interface between them, along dx.
template <int D>
struct InterfaceSides {
    double p_L, p_R, U_L, U_R, U_i;  // U_i: of particle i itself, not reconstructed
    double v_L[D], v_R[D];
};

template <int D, bool muscl>
[[gnu::always_inline]] inline InterfaceSides<D> reconstruct(const PairState<D>& i, const FluxFields<D>& s,
                                                            std::size_t j, const double (&dx)[D]) {
    InterfaceSides<D> at;
    at.p_L = i.p;
    at.p_R = s.p[j];
    at.U_L = at.U_R = at.U_i = 0;
    if constexpr (muscl) {
        double slope_i = 0, slope_j = 0;
        for (int d = 0; d < D; ++d) {
            slope_i += i.grad_p[d] * dx[d];
            slope_j += s.grad_p[d][j] * dx[d];
        }
        const double dp = at.p_R - at.p_L;
        at.p_L += 0.5 * minmod(slope_i, dp);
        at.p_R -= 0.5 * minmod(slope_j, dp);
    }
    for (int e = 0; e < D; ++e) {
        at.v_L[e] = i.v[e];
        at.v_R[e] = s.v[e][j];
        at.U_i += i.v[e] * dx[e];
        if constexpr (muscl) {
            double slope_i = 0, slope_j = 0;
            for (int d = 0; d < D; ++d) {
                slope_i += i.grad_v[e][d] * dx[d];
                slope_j += s.grad_v[e][d][j] * dx[d];
            }
            const double dv = at.v_R[e] - at.v_L[e];
            at.v_L[e] += 0.5 * minmod(slope_i, dv);
            at.v_R[e] -= 0.5 * minmod(slope_j, dv);
        }
        at.U_L += at.v_L[e] * dx[e];
        at.U_R += at.v_R[e] * dx[e];
    }
    return at;
}

// p_e and U_e = u_e r of the Riemann problem; Z = ρc of the two particles.
template <RiemannSolver solver>
[[gnu::always_inline]] inline void solve_riemann(const Tait& tait, double r, double p_L, double U_L, double Z_L,
                                                 double p_R, double U_R, double Z_R, double& p_e, double& U_e) {
    if constexpr (solver == RiemannSolver::exact) {
        const double inverse_r = 1 / r;
        const InterfaceState state = exact_water_riemann(tait, U_L * inverse_r, p_L, U_R * inverse_r, p_R);
        p_e = state.pressure;
        U_e = state.velocity * r;
    } else {
        // The acoustic solution of riemann.hpp with u = U/r, multiplied out so that one division is left.
        const double Z = Z_L + Z_R, inverse = 1 / (r * Z);
        double jump = U_L - U_R;
        U_e = (Z_L * U_L + Z_R * U_R + (p_L - p_R) * r) * (inverse * r);
        if constexpr (solver == RiemannSolver::low_dissipation)
            jump *= std::min(6 * tait.reference_density * std::max(jump, 0.0) * inverse, 1.0);  // c = ½ Z/ρ0
        p_e = ((Z_R * p_L + Z_L * p_R) * r + Z_L * Z_R * jump) * inverse;
    }
}

template <int D, class Kernel, bool muscl, RiemannSolver solver>
struct RiemannPair {
    Kernel kernel;
    Tait tait;

    [[gnu::always_inline]] PairFlux operator()(const PairState<D>& i, const FluxFields<D>& s, std::size_t j,
                                               double seen, double (&dx)[D]) const {
        double r, w, p_e, U_e;
        pair_geometry<D>(i, s, j, seen, kernel, dx, r, w);
        const auto at = reconstruct<D, muscl>(i, s, j, dx);
        solve_riemann<solver>(tait, r, at.p_L, at.U_L, i.impedance, at.p_R, at.U_R, s.impedance[j], p_e, U_e);
        return {2 * p_e * w, 2 * (U_e - at.U_i) * w};
    }
};

}  // namespace aquagraph::fluid
