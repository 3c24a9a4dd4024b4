// Rubber whose energy is a sum of an isochoric and a volumetric part (Simo, Taylor & Pister, Comput. Methods Appl.
// Mech. Eng. 51, 1985; Bonet & Wood, 2nd ed., 6.5; Holzapfel, Nonlinear Solid Mechanics, 6.4):
//   W = w(Ī_1, Ī_2) + κ/2 (J - 1)²,   Ī_1 = J^(-2/3) tr C,   Ī_2 = J^(-4/3) ½ ((tr C)² - C:C)
// Plane strain: C_33 = 1. Valid for 0.05 < J < 20, far beyond what κ lets happen. Here are the pieces that the laws
// put together, each without the cancellation that forming C or J first would bring.
#pragma once
#include "physics/solid/materials/law.hpp"

namespace aquagraph::solid {

template <int D, class T>
struct IsochoricKinematics {
    T J, m;            // J, J^(-2/3)
    T I1_minus_3;      // tr C - 3
    T I1_bar_minus_3;  // J^(-2/3) tr C - 3
    Tensor<D, T> B;    // C⁻¹
    Tensor<D, T> D1;   // ∂Ī_1/∂C = J^(-2/3) (I - tr C/3 C⁻¹)

    explicit IsochoricKinematics(const Kinematics<D, T>& k) {
        J = k.J_minus_1 + 1.0;
        const T y = inverse_cube_root(J);
        m = y * y;
        I1_minus_3 = 2.0 * k.trace;
        // J^(-2/3) I_1 - 3 = J^(-2/3) (I_1 - 3 J^(2/3)), and 1 - J^(2/3) = (1 - J²) / (1 + J^(2/3) + J^(4/3)).
        const T root = 1.0 / m, j = k.J_minus_1;
        I1_bar_minus_3 = m * (I1_minus_3 - 3.0 * j * (j + 2.0) / (1.0 + root + root * root));
        B = inverse_right_cauchy_green(k);
        // I - C⁻¹ = 2E C⁻¹; E and C⁻¹ commute
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = p; q < D; ++q) {
                T EB{};
                for (std::size_t n = 0; n < D; ++n) EB += k.E(p, n) * B(n, q);
                D1(p, q) = D1(q, p) = m * (2.0 * EB - (I1_minus_3 / 3.0) * B(p, q));
            }
    }
    // Its component across the plane, times C_33 = 1.
    T D1_across() const { return -m * I1_minus_3 / 3.0; }
};

// C += f (X⊗Y + Y⊗X) of symmetric tensors.
template <int D, class T>
inline void add_dyads(SymmetricTangent<D, T>& C, const T& f, const Tensor<D, T>& X, const Tensor<D, T>& Y) {
    constexpr auto pairs = index_pairs<D>();
    for (std::size_t p = 0; p < pair_count<D>; ++p)
        for (std::size_t q = 0; q < pair_count<D>; ++q)
            C.c[p][q] += f * (X(pairs[p][0], pairs[p][1]) * Y(pairs[q][0], pairs[q][1]) +
                              Y(pairs[p][0], pairs[p][1]) * X(pairs[q][0], pairs[q][1]));
}

// C += f/2 (B_IK B_JL + B_IL B_JK), which is -f ∂C⁻¹/∂C.
template <int D, class T>
inline void add_inverse_slope(SymmetricTangent<D, T>& C, const T& f, const Tensor<D, T>& B) {
    constexpr auto pairs = index_pairs<D>();
    for (std::size_t p = 0; p < pair_count<D>; ++p)
        for (std::size_t q = 0; q < pair_count<D>; ++q) {
            const auto [i, j] = pairs[p];
            const auto [n, l] = pairs[q];
            C.c[p][q] += 0.5 * f * (B(i, n) * B(j, l) + B(i, l) * B(j, n));
        }
}

// U = κ/2 (J - 1)²: S += κ (J - 1) J C⁻¹
template <int D, class T>
inline void add_volumetric_stress(double kappa, const Kinematics<D, T>& k, const IsochoricKinematics<D, T>& i,
                                  Tensor<D, T>& S) {
    for (std::size_t p = 0; p < D; ++p)
        for (std::size_t q = 0; q < D; ++q) S(p, q) += kappa * k.J_minus_1 * i.J * i.B(p, q);
}

// C += κ J (2J - 1) C⁻¹⊗C⁻¹ - 2 κ (J - 1) J 𝕀,   𝕀 = -∂C⁻¹/∂C
template <int D, class T>
inline void add_volumetric_tangent(double kappa, const Kinematics<D, T>& k, const IsochoricKinematics<D, T>& i,
                                   SymmetricTangent<D, T>& C) {
    add_dyads<D, T>(C, 0.5 * kappa * i.J * (2.0 * i.J - 1.0), i.B, i.B);
    add_inverse_slope<D, T>(C, -2.0 * kappa * k.J_minus_1 * i.J, i.B);
}

// w = w(Ī_1): C += 4 w' ∂²Ī_1/∂C² + 4 w'' D1⊗D1, with
// ∂²Ī_1/∂C² = -1/3 (D1⊗C⁻¹ + C⁻¹⊗D1) - Ī_1/9 C⁻¹⊗C⁻¹ + Ī_1/3 𝕀
template <int D, class T>
inline void add_first_invariant_tangent(const T& slope, const T& curvature, const IsochoricKinematics<D, T>& i,
                                        SymmetricTangent<D, T>& C) {
    const T I1_bar = i.I1_bar_minus_3 + 3.0;
    add_dyads<D, T>(C, -4.0 / 3 * slope, i.D1, i.B);
    add_dyads<D, T>(C, -2.0 / 9 * slope * I1_bar, i.B, i.B);
    add_inverse_slope<D, T>(C, 4.0 / 3 * slope * I1_bar, i.B);
    add_dyads<D, T>(C, 2.0 * curvature, i.D1, i.D1);
}

}  // namespace aquagraph::solid
