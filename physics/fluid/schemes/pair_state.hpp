// What the flux of a pair reads of its two particles, and what it gives.
#pragma once
#include "physics/fluid/particles.hpp"

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
    [[gnu::always_inline]] PairState<D> load(std::size_t i) const {
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
    double pressure;  // [Pa/m^2·m^D…]: the force on i per own volume is -pressure (x_j - x_i)
    double dilation;  // dω_i/dt = ω_i Σ dilation [1/s]
    double
        closing;  // (v_j - v_i)·∇W_ij ω_j; what j gets is -pressure (x_i - x_j) and 2 closing - dilation, times ω_i/ω_j
};

// The vector from i to j = lane j, its length and its square, and w with factor ∇W_ij weight = w (x_j - x_i). The
// weight is ω_j, or 0 where a wall hides j.
template <int D, class Kernel>
[[gnu::always_inline]] inline void pair_geometry(const PairState<D>& i, const FluxFields<D>& s, std::size_t j,
                                                 double weight, const Kernel& kernel, double (&dx)[D], double& r,
                                                 double& r2, double& w, double factor = 1) {
    r2 = 1e-200;  // keeps the particle's own lane finite; its dx is zero, and so is its flux
    for (int d = 0; d < D; ++d) {
        dx[d] = s.x[d][j] - i.x[d];
        r2 += dx[d] * dx[d];
    }
    r = std::sqrt(r2);
    w = kernel.slope(r * kernel.inverse_radius(), factor) * weight;
}

}  // namespace aquagraph::fluid
