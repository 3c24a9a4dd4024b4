// What one pair adds to <Δv>_i by the viscous operators of viscosity.hpp, with ∇W_ij ω_j = w x_ij.
#pragma once
#include "physics/fluid/choices.hpp"

namespace aquagraph::fluid {

template <int D, ViscousOperator form>
[[gnu::always_inline]] inline void viscous_pair(const double (&dx)[D], const double (&dv)[D], double r2, double w,
                                                double (&laplacian)[D]) {
    if constexpr (form == ViscousOperator::monaghan_gingold) {
        constexpr double K = D == 2 ? 8 : 10;
        double approach = 0;
        for (int d = 0; d < D; ++d) approach += dx[d] * dv[d];
        const double along = K * approach * w / r2;
        for (int d = 0; d < D; ++d) laplacian[d] = along * dx[d];
    } else {
        for (int d = 0; d < D; ++d) laplacian[d] = 2 * w * dv[d];
    }
}

}  // namespace aquagraph::fluid
