// Neo-Hookean rubber, compressible or nearly not, volumetric and isochoric parts decoupled (Bonet & Wood, 2nd ed.,
// (6.55) and (6.59)):
//   W = µ/2 (Ī_1 - 3) + κ/2 (J - 1)²
// Parameters: E > 0 [Pa], ν in ]-1, 1/2[; µ = E/(2(1+ν)), κ = E/(3(1-2ν)). Three dimensions or plane strain. (Plane
// stress would need F_33 from a local iteration; Saint Venant–Kirchhoff offers it.)
#pragma once
#include "physics/solid/materials/decoupled.hpp"

namespace aquagraph::solid {

template <int D>
struct NeoHookean {
    static constexpr bool small_strain = false;
    double mu = 0;     // shear modulus [Pa]
    double kappa = 0;  // bulk modulus [Pa]

    static NeoHookean solid(double E, double nu) { return {E / (2 * (1 + nu)), E / (3 * (1 - 2 * nu))}; }

    template <class T>
    T energy(const Kinematics<D, T>& k) const {
        return 0.5 * mu * IsochoricKinematics(k).I1_bar_minus_3 + 0.5 * kappa * k.J_minus_1 * k.J_minus_1;
    }
    template <class T>
    Tensor<D, T> stress(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        Tensor<D, T> S;
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = 0; q < D; ++q) S(p, q) = mu * i.D1(p, q);
        add_volumetric_stress(kappa, k, i, S);
        return S;
    }
    template <class T>
    SymmetricTangent<D, T> tangent(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        SymmetricTangent<D, T> C;
        add_first_invariant_tangent(T{} + 0.5 * mu, T{}, i, C);
        add_volumetric_tangent(kappa, k, i, C);
        return C;
    }
    template <class T>
    Across<T> across(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        return {T{} + 1.0, mu * i.D1_across() + kappa * k.J_minus_1 * i.J};
    }
};

}  // namespace aquagraph::solid
