// What a material law says, and how a deformation reaches it.
//
// A law is a small value type for one dimension D with
//   T energy(k)                    W per reference volume [J/m³]
//   Tensor<D, T> stress(k)         S = ∂W/∂E [Pa], second Piola–Kirchhoff
//   SymmetricTangent<D, T> tangent(k)   C = ∂S/∂E [Pa]
//   Across<T> across(k)            D = 2 only: what happens across the plane, for the output of stresses
//   static constexpr bool small_strain   true: E is the linear strain and S the stress of linear elasticity
// of the kinematics k of a point, or of the points of a pack of elements side by side (T = Lane). The tensors are D by
// D; D = 2 is plane strain, F_33 = 1, unless the law says otherwise. Everything is formed from H = ∂u/∂X, not from
// F = I + H: strains of 1e-7 in a stiff plate would lose half of their digits in FᵀF - I.
#pragma once
#include <array>
#include <cstddef>

#include "physics/solid/lanes.hpp"

namespace aquagraph::solid {

template <int D, class T>
struct Tensor {
    T c[D][D] = {};
    T& operator()(std::size_t i, std::size_t j) { return c[i][j]; }
    const T& operator()(std::size_t i, std::size_t j) const { return c[i][j]; }
};

// Pairs of indices of a symmetric tensor, and the place of (i, j) among them.
template <int D>
inline constexpr std::size_t pair_count = D*(D + 1) / 2;
template <int D>
constexpr std::array<std::array<std::size_t, 2>, pair_count<D>> index_pairs() {
    if constexpr (D == 2)
        return {{{0, 0}, {1, 1}, {0, 1}}};
    else
        return {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
}
template <int D>
constexpr std::size_t pair_index(std::size_t i, std::size_t j) {
    if (i == j) return i;
    if (D == 2) return 2;
    return i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

// C_IJKL by pairs (tensor components: the stress of a shear E_12 = E_21 is 2 C_.. 12 E_12).
template <int D, class T>
struct SymmetricTangent {
    T c[pair_count<D>][pair_count<D>] = {};
};

template <class T>
struct Across {
    T stretch{};  // F_33
    T stress{};   // S_33 [Pa]
};

template <int D, class T>
struct Kinematics {
    Tensor<D, T> H;  // ∂u/∂X
    Tensor<D, T> E;  // ½ (H + Hᵀ + HᵀH), Green–Lagrange; of a law for small strain ½ (H + Hᵀ)
    T J_minus_1{};   // det(I + H) - 1
    T trace{};       // tr E
};

template <int D, class T>
inline T double_dot(const Tensor<D, T>& A, const Tensor<D, T>& B) {
    T sum{};
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) sum += A.c[i][j] * B.c[i][j];
    return sum;
}

template <int D, class T>
inline T determinant_minus_1(const Tensor<D, T>& H) {
    if constexpr (D == 2) {
        return H(0, 0) + H(1, 1) + (H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0));
    } else {
        const T m01 = H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0), m12 = H(1, 1) * H(2, 2) - H(1, 2) * H(2, 1),
                m02 = H(0, 0) * H(2, 2) - H(0, 2) * H(2, 0);
        const T det = H(0, 0) * m12 - H(0, 1) * (H(1, 0) * H(2, 2) - H(1, 2) * H(2, 0)) +
                      H(0, 2) * (H(1, 0) * H(2, 1) - H(1, 1) * H(2, 0));
        return (H(0, 0) + H(1, 1) + H(2, 2)) + (m01 + m12 + m02) + det;
    }
}

template <class Law, int D, class T>
inline Kinematics<D, T> kinematics(const Tensor<D, T>& H) {
    Kinematics<D, T> k;
    k.H = H;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = i; j < D; ++j) {
            T e = H(i, j) + H(j, i);
            if constexpr (!Law::small_strain)
                for (std::size_t m = 0; m < D; ++m) e += H(m, i) * H(m, j);
            k.E(i, j) = k.E(j, i) = 0.5 * e;
        }
    for (std::size_t i = 0; i < D; ++i) k.trace += k.E(i, i);
    k.J_minus_1 = determinant_minus_1(H);
    return k;
}

// C⁻¹ = (I + 2E)⁻¹, by cofactors over J².
template <int D, class T>
inline Tensor<D, T> inverse_right_cauchy_green(const Kinematics<D, T>& k) {
    Tensor<D, T> C, B;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) C(i, j) = 2.0 * k.E(i, j) + (i == j ? 1.0 : 0.0);
    const T J = k.J_minus_1 + 1.0, over = 1.0 / (J * J);
    if constexpr (D == 2) {
        B(0, 0) = C(1, 1) * over;
        B(1, 1) = C(0, 0) * over;
        B(0, 1) = B(1, 0) = -C(0, 1) * over;
    } else {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = i; j < 3; ++j) {
                const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
                B(i, j) = B(j, i) = (C(i1, j1) * C(i2, j2) - C(i1, j2) * C(i2, j1)) * over;
            }
    }
    return B;
}

// P = F S, first Piola–Kirchhoff.
template <class Law, int D, class T>
inline Tensor<D, T> first_piola(const Law& law, const Kinematics<D, T>& k) {
    const Tensor<D, T> S = law.stress(k);
    if constexpr (Law::small_strain) return S;
    Tensor<D, T> P;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) {
            P(i, j) = S(i, j);
            for (std::size_t m = 0; m < D; ++m) P(i, j) += k.H(i, m) * S(m, j);
        }
    return P;
}

// A = ∂P/∂F: A_iJkL = δ_ik S_JL + F_iM C_MJNL F_kN, rows and columns D i + J.
template <int D, class T>
struct FullTangent {
    T c[D * D][D * D] = {};
};

template <class Law, int D, class T>
inline FullTangent<D, T> full_tangent(const Law& law, const Kinematics<D, T>& k) {
    constexpr std::size_t m = pair_count<D>;
    const SymmetricTangent<D, T> C = law.tangent(k);
    FullTangent<D, T> A;
    if constexpr (Law::small_strain) {
        for (std::size_t i = 0; i < D; ++i)
            for (std::size_t J = 0; J < D; ++J)
                for (std::size_t n = 0; n < D; ++n)
                    for (std::size_t L = 0; L < D; ++L)
                        A.c[D * i + J][D * n + L] = C.c[pair_index<D>(i, J)][pair_index<D>(n, L)];
        return A;
    }
    Tensor<D, T> F = k.H;
    for (std::size_t i = 0; i < D; ++i) F(i, i) += 1.0;
    const Tensor<D, T> S = law.stress(k);
    T G[D * D][m] = {};  // F_iM C_MJ,q
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t J = 0; J < D; ++J)
            for (std::size_t M = 0; M < D; ++M)
                for (std::size_t q = 0; q < m; ++q) G[D * i + J][q] += F(i, M) * C.c[pair_index<D>(M, J)][q];
    for (std::size_t row = 0; row < D * D; ++row)
        for (std::size_t n = 0; n < D; ++n)
            for (std::size_t L = 0; L < D; ++L) {
                const std::size_t column = D * n + L;
                if (column > row) continue;
                T sum{};
                for (std::size_t N = 0; N < D; ++N) sum += F(n, N) * G[row][pair_index<D>(N, L)];
                if (row / D == n) sum += S(row % D, L);
                A.c[row][column] = A.c[column][row] = sum;
            }
    return A;
}

// Von Mises equivalent [Pa] of the Cauchy stress σ = F S Fᵀ / J.
template <class Law, int D, class T>
inline T von_mises(const Law& law, const Kinematics<D, T>& k) {
    const Tensor<D, T> P = first_piola(law, k);
    Tensor<3, T> sigma;
    T J = k.J_minus_1 + 1.0;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) {
            sigma(i, j) = P(i, j);
            if constexpr (!Law::small_strain)
                for (std::size_t m = 0; m < D; ++m) sigma(i, j) += P(i, m) * k.H(j, m);
        }
    if constexpr (D == 2) {
        const Across<T> across = law.across(k);
        sigma(2, 2) = Law::small_strain ? across.stress : across.stretch * across.stretch * across.stress;
        if constexpr (!Law::small_strain) J *= across.stretch;
    }
    const T d01 = sigma(0, 0) - sigma(1, 1), d12 = sigma(1, 1) - sigma(2, 2), d20 = sigma(2, 2) - sigma(0, 0);
    const T shear = sigma(0, 1) * sigma(0, 1) + sigma(1, 2) * sigma(1, 2) + sigma(2, 0) * sigma(2, 0);
    const T equivalent = square_root(0.5 * (d01 * d01 + d12 * d12 + d20 * d20) + 3.0 * shear);
    if constexpr (Law::small_strain) return equivalent;
    return equivalent / J;
}

}  // namespace aquagraph::solid
