// Linear between Green–Lagrange strain E = ½ (FᵀF - I) and second Piola–Kirchhoff stress S (Saint Venant–Kirchhoff;
// Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., (6.28)), or between linear strain
// and stress (linear elasticity, for small displacements and rotations only):
//   W = λ/2 (tr E)² + µ E:E,   S = λ tr E I + 2 µ E
// Parameters: E > 0 [Pa], ν in ]-1, 1/2[. Saint Venant–Kirchhoff is for large rotations and small strains: under strong
// compression the law softens and finally resists no more (at a stretch of 0.58 in uniaxial strain). Plane strain:
// E_33 = 0. Plane stress: S_33 = 0 gives E_33 = -λ/(λ+2µ) tr E, which leaves the same form in the plane with λ replaced
// by 2λµ/(λ+2µ).
#pragma once
#include "physics/solid/materials/law.hpp"

namespace aquagraph::solid {

template <int D, bool SmallStrain = false>
struct HookeanLaw {
    static constexpr bool small_strain = SmallStrain;
    double lambda = 0;         // of the law in D dimensions: already reduced in plane stress [Pa]
    double mu = 0;             // [Pa]
    double lambda_across = 0;  // S_33 = lambda_across tr E: λ in plane strain, 0 in plane stress [Pa]
    double strain_across = 0;  // E_33 = strain_across tr E: 0 in plane strain, -λ/(λ+2µ) in plane stress

    // Three dimensions, or plane strain.
    static HookeanLaw solid(double E, double nu) {
        const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
        return {lambda, E / (2 * (1 + nu)), lambda, 0};
    }
    static HookeanLaw plane_stress(double E, double nu) requires(D == 2) {
        return {E * nu / (1 - nu * nu), E / (2 * (1 + nu)), 0, -nu / (1 - nu)};
    }

    template <class T>
    T energy(const Kinematics<D, T>& k) const {
        return 0.5 * lambda * k.trace * k.trace + mu * double_dot(k.E, k.E);
    }
    template <class T>
    Tensor<D, T> stress(const Kinematics<D, T>& k) const {
        Tensor<D, T> S;
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t j = 0; j < D; ++j) S(i, j) = 2 * mu * k.E(i, j) + (i == j ? lambda * k.trace : T{});
        return S;
    }
    template <class T>
    SymmetricTangent<D, T> tangent(const Kinematics<D, T>&) const {
        SymmetricTangent<D, T> C;
        for (std::size_t p = 0; p < pair_count<D>; ++p) C.c[p][p] = T{} + (p < D ? 2 * mu : mu);
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = 0; q < D; ++q) C.c[p][q] += lambda;
        return C;
    }
    template <class T>
    Across<T> across(const Kinematics<D, T>& k) const {
        const T stretch = SmallStrain ? strain_across * k.trace + 1.0 : square_root(2 * strain_across * k.trace + 1.0);
        return {stretch, lambda_across * k.trace};
    }
};

template <int D>
using SaintVenantKirchhoff = HookeanLaw<D, false>;
template <int D>
using LinearElastic = HookeanLaw<D, true>;

}  // namespace aquagraph::solid
