// Pair fluxes of Riemann-SPH, locally mass conserving (thesis (2.55)):
//     dρ_i/dt = -ρ_i Σ_j 2 (v_e - v_i)·∇W_ij ω_j
//     dv_i/dt = g - (ω_i/m_i) Σ_j 2 p_e ∇W_ij ω_j
// (v_e·e_ij, p_e) solve the acoustic Riemann problem along e_ij between the reconstructed states of i and j.
//
// pair_flux is the formula itself, for one pair; with ∇W_ij ω_j = w (x_j - x_i) and U = v·(x_j - x_i) the divisions by
// r shrink to one. It is antisymmetric in the pair: what i gets, j loses.
#pragma once
#include "physics/fluid/kernel.hpp"
#include "physics/fluid/neighbour_lists.hpp"
#include "physics/fluid/reconstruction.hpp"

namespace aquagraph::fluid {

template <int D>
struct PairState {
    double x[D], v[D], p, impedance, grad_p[D], grad_v[D][D];
};

// Read-only pointers to what a flux reads: the vectoriser wants them plain.
template <int D>
struct FluxFields {
    const double* x[D];
    const double* v[D];
    const double* p;
    const double* impedance;
    const double* volume;
    const double* grad_p[D];
    const double* grad_v[D][D];

    explicit FluxFields(const Particles<D>& s) : p(s.p.data()), impedance(s.impedance.data()), volume(s.volume.data()) {
        for (int d = 0; d < D; ++d) {
            x[d] = s.x[d].data();
            v[d] = s.v[d].data();
            grad_p[d] = s.grad_p[d].data();
            for (int e = 0; e < D; ++e) grad_v[d][e] = s.grad_v[d][e].data();
        }
    }
    PairState<D> load(std::size_t i) const {
        PairState<D> state;
        state.p = p[i];
        state.impedance = impedance[i];
        for (int d = 0; d < D; ++d) {
            state.x[d] = x[d][i];
            state.v[d] = v[d][i];
            state.grad_p[d] = grad_p[d][i];
            for (int e = 0; e < D; ++e) state.grad_v[d][e] = grad_v[d][e][i];
        }
        return state;
    }
};

struct PairFlux {
    double pressure;  // 2 p_e w     [Pa/m²·m^D…]: the force on i per own volume is -pressure (x_j - x_i)
    double dilation;  // 2 (v_e - v_i)·(x_j - x_i) w: dω_i/dt = ω_i Σ dilation
};

// i: left state, lane j of s: right state. `seen` is 0 where a wall hides j.
template <int D, bool muscl>
[[gnu::always_inline]] inline PairFlux pair_flux(const PairState<D>& i, const FluxFields<D>& s, std::size_t j,
                                                 double seen, double inverse_radius, double slope_factor,
                                                 double (&dx)[D]) {
    double r2 = 1e-200;  // keeps the particle's own lane finite; its dx is zero, and so is its flux
    for (int d = 0; d < D; ++d) {
        dx[d] = s.x[d][j] - i.x[d];
        r2 += dx[d] * dx[d];
    }
    const double r = std::sqrt(r2);
    const double u = std::max(0.0, 1 - r * inverse_radius);
    const double w = slope_factor * u * u * u * s.volume[j] * seen;

    double p_L = i.p, p_R = s.p[j], U_L = 0, U_R = 0, U_i = 0;
    if constexpr (muscl) {
        double slope_i = 0, slope_j = 0;
        for (int d = 0; d < D; ++d) {
            slope_i += i.grad_p[d] * dx[d];
            slope_j += s.grad_p[d][j] * dx[d];
        }
        const double dp = p_R - p_L;
        p_L += 0.5 * minmod(slope_i, dp);
        p_R -= 0.5 * minmod(slope_j, dp);
    }
    for (int e = 0; e < D; ++e) {
        double v_L = i.v[e], v_R = s.v[e][j];
        U_i += v_L * dx[e];
        if constexpr (muscl) {
            double slope_i = 0, slope_j = 0;
            for (int d = 0; d < D; ++d) {
                slope_i += i.grad_v[e][d] * dx[d];
                slope_j += s.grad_v[e][d][j] * dx[d];
            }
            const double dv = v_R - v_L;
            v_L += 0.5 * minmod(slope_i, dv);
            v_R -= 0.5 * minmod(slope_j, dv);
        }
        U_L += v_L * dx[e];
        U_R += v_R * dx[e];
    }
    // The acoustic Riemann solution of riemann.hpp with u = U/r, multiplied out so that one division is left.
    const double Z_L = i.impedance, Z_R = s.impedance[j], Z = Z_L + Z_R;
    const double inverse = 1 / (r * Z);
    const double p_e = ((Z_R * p_L + Z_L * p_R) * r + Z_L * Z_R * (U_L - U_R)) * inverse;
    const double U_e = (Z_L * U_L + Z_R * U_R + (p_L - p_R) * r) * (inverse * r);
    return {2 * p_e * w, 2 * (U_e - U_i) * w};
}

struct FluxParameters {
    bool muscl = true;
    double gravity[3] = {0, 0, 0};  // [m/s²]
};

// Writes acceleration and deviation_rate of these fluid particles (of one block).
template <int D>
void compute_fluxes(Particles<D>& particles, const NeighbourLists<D>& lists, const WendlandC2<D>& kernel,
                    const FluxParameters& parameters, double reference_density, LaneRange lanes);

extern template void compute_fluxes(Particles<2>&, const NeighbourLists<2>&, const WendlandC2<2>&,
                                    const FluxParameters&, double, LaneRange);
extern template void compute_fluxes(Particles<3>&, const NeighbourLists<3>&, const WendlandC2<3>&,
                                    const FluxParameters&, double, LaneRange);

}  // namespace aquagraph::fluid
