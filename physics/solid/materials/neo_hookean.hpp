// Nearly incompressible neo-Hookean rubber, volumetric and isochoric parts decoupled (Simo, Taylor & Pister, Comput.
// Methods Appl. Mech. Eng. 51, 1985; Bonet & Wood, 2nd ed., (6.55) and (6.59)):
//   W = µ/2 (J^(-2/3) I_1 - 3) + κ/2 (J - 1)²,   I_1 = tr FᵀF,  J = det F
//   P = µ J^(-2/3) (F - I_1/(3J) G) + κ (J - 1) G,   G = ∂J/∂F = J F^(-T)
// Parameters: E > 0 [Pa], ν in ]-1, 1/2[; µ = E/(2(1+ν)), κ = E/(3(1-2ν)). Plane strain, F_33 = 1. (Plane stress would
// need F_33 from a local iteration; Saint Venant–Kirchhoff offers it.) Valid for 0.05 < J < 20, far beyond what κ lets
// happen.
#pragma once
#include "physics/solid/materials/plane.hpp"

namespace aquagraph::solid {

// J^(-1/3) by Halley's iteration from 1, a fixed number of times: no branch and no call, so that lanes of elements
// vectorise. To rounding for 0.05 < J < 20.
inline double inverse_cube_root(double J) {
    double y = 1;
    for (int k = 0; k < 5; ++k) {
        const double Jy3 = J * y * y * y;
        y *= (Jy3 + 2) / (2 * Jy3 + 1);
    }
    return y;
}

struct NeoHookean {
    double mu = 0;     // shear modulus [Pa]
    double kappa = 0;  // bulk modulus [Pa]

    static NeoHookean plane_strain(double E, double nu) { return {E / (2 * (1 + nu)), E / (3 * (1 - 2 * nu))}; }

    // I_1 - 3 and J - 1 without the cancellation that forming I_1 and J first would bring.
    struct Invariants {
        double I1_minus_3, J_minus_1;
    };
    static Invariants invariants(const PlaneTensor& H) {
        const double trace = H.xx + H.yy;
        return {2 * trace + H.xx * H.xx + H.xy * H.xy + H.yx * H.yx + H.yy * H.yy, trace + H.xx * H.yy - H.xy * H.yx};
    }

    // J^(-2/3) I_1 - 3 = J^(-2/3) (I_1 - 3 J^(2/3)), and 1 - J^(2/3) = (1 - J^2) / (1 + J^(2/3) + J^(4/3)).
    double energy(const PlaneTensor& H) const {
        const auto [i1, j] = invariants(H);
        const double y = inverse_cube_root(1 + j), m = y * y, J_two_thirds = 1 / m;
        const double one_minus = -j * (2 + j) / (1 + J_two_thirds + J_two_thirds * J_two_thirds);
        return 0.5 * mu * m * (i1 + 3 * one_minus) + 0.5 * kappa * j * j;
    }

    // With c = I_1/(3J) = 1 + c': F - c G = (F - G) - c' G.
    PlaneTensor first_piola(const PlaneTensor& H) const {
        const auto [i1, j] = invariants(H);
        const double y = inverse_cube_root(1 + j), mu_m = mu * y * y;
        const double c_minus_1 = (i1 / 3 - j) / (1 + j);
        const double along_G = kappa * j - mu_m * c_minus_1;
        const double difference = mu_m * (H.xx - H.yy), shear = mu_m * (H.xy + H.yx);
        return {difference + along_G * (1 + H.yy), shear - along_G * H.yx, shear - along_G * H.xy,
                -difference + along_G * (1 + H.xx)};
    }

    // A = µ J^(-2/3) [1 - c D - 2/(3J) (G⊗F + F⊗G) + 5c/(3J) G⊗G] + κ G⊗G + κ (J-1) D,   D = ∂G/∂F
    PlaneTangent tangent(const PlaneTensor& H) const {
        const auto [i1, j] = invariants(H);
        const double J = 1 + j, y = inverse_cube_root(J), mu_m = mu * y * y, c = (3 + i1) / (3 * J);
        const std::array<double, 4> F{1 + H.xx, H.xy, H.yx, 1 + H.yy}, G{1 + H.yy, -H.yx, -H.xy, 1 + H.xx};
        PlaneTangent A{};
        for (std::size_t p = 0; p < 4; ++p)
            for (std::size_t q = 0; q < 4; ++q)
                A[p][q] =
                    -mu_m * 2 / (3 * J) * (G[p] * F[q] + F[p] * G[q]) + (mu_m * 5 * c / (3 * J) + kappa) * G[p] * G[q];
        const double along_D = kappa * j - mu_m * c;
        for (std::size_t p = 0; p < 4; ++p) A[p][p] += mu_m;
        A[0][3] += along_D;
        A[3][0] += along_D;
        A[1][2] -= along_D;
        A[2][1] -= along_D;
        return A;
    }

    Thickness thickness(const PlaneTensor& H) const {  // P_33 = µ J^(-2/3) (1 - I_1/3) + κ (J - 1) J
        const auto [i1, j] = invariants(H);
        const double y = inverse_cube_root(1 + j);
        return {1, -mu * y * y * i1 / 3 + kappa * j * (1 + j)};
    }
};

}  // namespace aquagraph::solid
