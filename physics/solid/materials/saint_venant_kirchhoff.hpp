// Saint Venant–Kirchhoff: linear between Green–Lagrange strain E = ½ (FᵀF - I) and second Piola–Kirchhoff stress S
// (Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., (6.28)):
//   W = λ/2 (tr E)² + µ E:E,   S = λ tr E I + 2 µ E,   P = F S
// Parameters: E > 0 [Pa], ν in ]-1, 1/2[. For large rotations and small strains: under strong compression the law
// softens and finally resists no more (at a stretch of 0.58 in uniaxial strain). Plane strain: E_33 = 0. Plane stress:
// S_33 = 0 gives E_33 = -λ/(λ+2µ) tr E, which leaves the same form in the plane with λ replaced by 2λµ/(λ+2µ).
#pragma once
#include <cmath>

#include "physics/solid/materials/plane.hpp"

namespace aquagraph::solid {

struct SaintVenantKirchhoff {
    double lambda = 0;         // of the plane law: already reduced in plane stress [Pa]
    double mu = 0;             // [Pa]
    double lambda_across = 0;  // S_33 = lambda_across tr E: λ in plane strain, 0 in plane stress [Pa]
    double strain_across = 0;  // E_33 = strain_across tr E: 0 in plane strain, -λ/(λ+2µ) in plane stress

    static SaintVenantKirchhoff plane_strain(double E, double nu) {
        const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
        return {lambda, E / (2 * (1 + nu)), lambda, 0};
    }
    static SaintVenantKirchhoff plane_stress(double E, double nu) {
        return {E * nu / (1 - nu * nu), E / (2 * (1 + nu)), 0, -nu / (1 - nu)};
    }

    struct Strain {
        double xx, yy, xy;  // E_xy, not the engineering shear
    };
    static Strain green_lagrange(const PlaneTensor& H) {
        return {H.xx + 0.5 * (H.xx * H.xx + H.yx * H.yx), H.yy + 0.5 * (H.xy * H.xy + H.yy * H.yy),
                0.5 * (H.xy + H.yx + H.xx * H.xy + H.yx * H.yy)};
    }

    double energy(const PlaneTensor& H) const {
        const Strain E = green_lagrange(H);
        const double trace = E.xx + E.yy;
        return 0.5 * lambda * trace * trace + mu * (E.xx * E.xx + E.yy * E.yy + 2 * E.xy * E.xy);
    }

    PlaneTensor first_piola(const PlaneTensor& H) const {
        const Strain E = green_lagrange(H);
        const double pressure_part = lambda * (E.xx + E.yy);
        const double S_xx = pressure_part + 2 * mu * E.xx, S_yy = pressure_part + 2 * mu * E.yy, S_xy = 2 * mu * E.xy;
        return {(1 + H.xx) * S_xx + H.xy * S_xy, (1 + H.xx) * S_xy + H.xy * S_yy, H.yx * S_xx + (1 + H.yy) * S_xy,
                H.yx * S_xy + (1 + H.yy) * S_yy};
    }

    // A_iJkL = δ_ik S_JL + λ F_iJ F_kL + µ ((F Fᵀ)_ik δ_JL + F_iL F_kJ)
    PlaneTangent tangent(const PlaneTensor& H) const {
        const Strain E = green_lagrange(H);
        const double pressure_part = lambda * (E.xx + E.yy);
        const double S[2][2] = {{pressure_part + 2 * mu * E.xx, 2 * mu * E.xy},
                                {2 * mu * E.xy, pressure_part + 2 * mu * E.yy}};
        const double F[2][2] = {{1 + H.xx, H.xy}, {H.yx, 1 + H.yy}};
        PlaneTangent A{};
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t J = 0; J < 2; ++J)
                for (std::size_t k = 0; k < 2; ++k)
                    for (std::size_t L = 0; L < 2; ++L) {
                        const double F_Ft_ik = F[i][0] * F[k][0] + F[i][1] * F[k][1];
                        A[2 * i + J][2 * k + L] = (i == k ? S[J][L] : 0) + lambda * F[i][J] * F[k][L] +
                                                  mu * ((J == L ? F_Ft_ik : 0) + F[i][L] * F[k][J]);
                    }
        return A;
    }

    Thickness thickness(const PlaneTensor& H) const {
        const Strain E = green_lagrange(H);
        const double trace = E.xx + E.yy;
        const double stretch = std::sqrt(1 + 2 * strain_across * trace);
        return {stretch, stretch * lambda_across * trace};
    }
};

}  // namespace aquagraph::solid
