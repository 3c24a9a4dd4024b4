// Mooney–Rivlin rubber, volumetric and isochoric parts decoupled (Bonet & Wood, 2nd ed., 6.6; Holzapfel, Nonlinear
// Solid Mechanics, (6.147)):
//   W = C_10 (Ī_1 - 3) + C_01 (Ī_2 - 3) + κ/2 (J - 1)²
// Parameters: C_10, C_01 [Pa] with C_10 + C_01 > 0, κ > 0 [Pa]; the shear modulus at small strain is 2 (C_10 + C_01).
// Three dimensions or plane strain.
#pragma once
#include "physics/solid/materials/decoupled.hpp"

namespace aquagraph::solid {

template <int D>
struct MooneyRivlin {
    static constexpr bool small_strain = false;
    double c10 = 0, c01 = 0;  // [Pa]
    double kappa = 0;         // bulk modulus [Pa]

    template <class T>
    T energy(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        const T second = 4.0 * k.trace + 2.0 * (k.trace * k.trace - double_dot(k.E, k.E));  // I_2 - 3
        // J^(-4/3) I_2 - 3 = J^(-4/3) (I_2 - 3 J^(4/3)), and 1 - J^(4/3) = (1 - J⁴)/(1 + J^(4/3) + J^(8/3))
        const T m2 = i.m * i.m, root = 1.0 / m2, j = k.J_minus_1;
        const T one_minus = -j * (j + 2.0) * (i.J * i.J + 1.0) / (1.0 + root + root * root);
        return c10 * i.I1_bar_minus_3 + c01 * m2 * (second + 3.0 * one_minus) + 0.5 * kappa * j * j;
    }
    template <class T>
    Tensor<D, T> stress(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        const Tensor<D, T> D2 = second_invariant_slope(k, i);
        Tensor<D, T> S;
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = 0; q < D; ++q) S(p, q) = 2 * c10 * i.D1(p, q) + 2 * c01 * D2(p, q);
        add_volumetric_stress(kappa, k, i, S);
        return S;
    }
    // ∂²Ī_2/∂C² = -2/3 (D2⊗C⁻¹ + C⁻¹⊗D2) - 4/9 Ī_2 C⁻¹⊗C⁻¹ + 2/3 Ī_2 𝕀 + J^(-4/3) (I⊗I - 𝕀_s)
    template <class T>
    SymmetricTangent<D, T> tangent(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        const Tensor<D, T> D2 = second_invariant_slope(k, i);
        SymmetricTangent<D, T> C;
        add_first_invariant_tangent(T{} + c10, T{}, i, C);
        const T I2_bar = i.m * i.m * (second_invariant(k));
        add_dyads<D, T>(C, T{} - 8.0 / 3 * c01, D2, i.B);
        add_dyads<D, T>(C, -8.0 / 9 * c01 * I2_bar, i.B, i.B);
        add_inverse_slope<D, T>(C, 8.0 / 3 * c01 * I2_bar, i.B);
        const T f = 4 * c01 * i.m * i.m;
        for (std::size_t p = 0; p < pair_count<D>; ++p) C.c[p][p] -= (p < D ? 1.0 : 0.5) * f;
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = 0; q < D; ++q) C.c[p][q] += f;
        add_volumetric_tangent(kappa, k, i, C);
        return C;
    }
    template <class T>
    Across<T> across(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        // D2_33 = J^(-4/3) (I_1 - C_33 - 2/3 I_2)
        const T second = i.m * i.m * (2.0 * k.trace + 2.0 - 2.0 / 3 * second_invariant(k));
        return {T{} + 1.0, 2 * c10 * i.D1_across() + 2 * c01 * second + kappa * k.J_minus_1 * i.J};
    }

  private:
    template <class T>
    static T second_invariant(const Kinematics<D, T>& k) {
        return 3.0 + 4.0 * k.trace + 2.0 * (k.trace * k.trace - double_dot(k.E, k.E));
    }
    // ∂Ī_2/∂C = J^(-4/3) (I_1 I - C - 2/3 I_2 C⁻¹), with I_2 = 3 + i_2 and C⁻¹ = I - 2E C⁻¹:
    // = J^(-4/3) ((2 tr E - 2/3 i_2) I - 2E + 4/3 I_2 E C⁻¹)
    template <class T>
    static Tensor<D, T> second_invariant_slope(const Kinematics<D, T>& k, const IsochoricKinematics<D, T>& i) {
        const T i2 = 4.0 * k.trace + 2.0 * (k.trace * k.trace - double_dot(k.E, k.E)), m2 = i.m * i.m;
        Tensor<D, T> D2;
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = p; q < D; ++q) {
                T EB{};
                for (std::size_t n = 0; n < D; ++n) EB += k.E(p, n) * i.B(n, q);
                T x = 4.0 / 3 * (i2 + 3.0) * EB - 2.0 * k.E(p, q);
                if (p == q) x += 2.0 * k.trace - 2.0 / 3 * i2;
                D2(p, q) = D2(q, p) = m2 * x;
            }
        return D2;
    }
};

}  // namespace aquagraph::solid
