// Each law against an independent one written in the full three-dimensional F, and its derivatives against finite
// differences.
#include "physics/solid/materials/mooney_rivlin.hpp"
#include "physics/solid/materials/neo_hookean.hpp"
#include "physics/solid/materials/saint_venant_kirchhoff.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <vector>

using namespace aquagraph::solid;
using Eigen::Matrix3d;

namespace {

template <int D>
using H_ = Tensor<D, double>;

template <int D>
std::vector<H_<D>> gradients() {
    if constexpr (D == 2)
        return {{},
                {{{1e-3, 2e-3}, {-1e-3, -2e-3}}},
                {{{0.2, 0.1}, {-0.3, 0.15}}},
                {{{-0.2, 0.4}, {0.1, 0.3}}},
                {{{-0.5, -0.87}, {0.87, -0.5}}},
                {{{0.6, 0.0}, {0.9, -0.3}}}};
    else
        return {{},
                {{{1e-3, 2e-3, -1e-3}, {-1e-3, -2e-3, 3e-3}, {0, 1e-3, 2e-3}}},
                {{{0.2, 0.1, 0.05}, {-0.3, 0.15, 0.2}, {0.1, -0.2, -0.1}}},
                {{{-0.2, 0.4, -0.3}, {0.1, 0.3, 0.2}, {0.5, -0.1, 0.4}}},
                {{{-0.5, -0.87, 0.1}, {0.87, -0.5, 0}, {0, 0.3, -0.2}}}};
}

template <int D>
Matrix3d deformation(const H_<D>& H, double stretch = 1) {
    Matrix3d F = Matrix3d::Identity();
    F(2, 2) = stretch;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) F(int(i), int(j)) = H(i, j) + (i == j ? 1 : 0);
    return F;
}

template <class Law, int D>
double energy_at(const Law& law, const H_<D>& H) {
    return law.energy(kinematics<Law, D, double>(H));
}

template <int D, class Law>
void check_derivatives(const Law& law, double modulus) {
    constexpr double h = 1e-5;
    for (const H_<D>& H : gradients<D>()) {
        const auto P = first_piola(law, kinematics<Law, D, double>(H));
        const auto A = full_tangent(law, kinematics<Law, D, double>(H));
        for (std::size_t q = 0; q < D * D; ++q) {
            H_<D> above = H, below = H;
            above(q / D, q % D) += h;
            below(q / D, q % D) -= h;
            const double slope = (energy_at(law, above) - energy_at(law, below)) / (2 * h);
            CHECK(std::abs(P(q / D, q % D) - slope) < 1e-8 * modulus);
            const auto P_above = first_piola(law, kinematics<Law, D, double>(above)),
                       P_below = first_piola(law, kinematics<Law, D, double>(below));
            for (std::size_t p = 0; p < D * D; ++p) {
                CHECK(std::abs(A.c[p][q] - (P_above(p / D, p % D) - P_below(p / D, p % D)) / (2 * h)) < 1e-8 * modulus);
                CHECK(A.c[p][q] == A.c[q][p]);
            }
        }
    }
}

// The law at H against P of an independent formula at F, F_33 included.
template <int D, class Law>
void check_against(const Law& law, const H_<D>& H, const Matrix3d& F, const Matrix3d& P, double modulus) {
    const auto k = kinematics<Law, D, double>(H);
    const auto mine = first_piola(law, k);
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) CHECK(std::abs(mine(i, j) - P(int(i), int(j))) < 1e-13 * modulus);
    if constexpr (D == 2) CHECK(std::abs(law.across(k).stretch * law.across(k).stress - P(2, 2)) < 1e-13 * modulus);
    const Matrix3d sigma = Law::small_strain ? P : Matrix3d(P * F.transpose() / F.determinant());
    const Matrix3d deviator = sigma - sigma.trace() / 3 * Matrix3d::Identity();
    CHECK(von_mises(law, k) == doctest::Approx(std::sqrt(1.5) * deviator.norm()).epsilon(1e-10));
}

Matrix3d second_piola_svk(const Matrix3d& F, double E, double nu) {
    const Matrix3d I = Matrix3d::Identity(), strain = 0.5 * (F.transpose() * F - I);
    return E * nu / ((1 + nu) * (1 - 2 * nu)) * strain.trace() * I + E / (1 + nu) * strain;
}

// W = C10 (Ī_1 - 3) + C01 (Ī_2 - 3) + κ/2 (J-1)², with P from invariants of C (Holzapfel, (6.32)), nothing rearranged.
Matrix3d mooney_rivlin_piola(const Matrix3d& F, double c10, double c01, double kappa) {
    const double J = F.determinant();
    const Matrix3d C = F.transpose() * F, C_inverse = C.inverse(), I = Matrix3d::Identity();
    const double I1 = C.trace(), I2 = 0.5 * (I1 * I1 - (C * C).trace());
    const Matrix3d S = 2 * c10 * std::pow(J, -2.0 / 3) * (I - I1 / 3 * C_inverse) +
                       2 * c01 * std::pow(J, -4.0 / 3) * (I1 * I - C - 2 * I2 / 3 * C_inverse) +
                       kappa * (J - 1) * J * C_inverse;
    return F * S;
}

double mooney_rivlin_energy(const Matrix3d& F, double c10, double c01, double kappa) {
    const double J = F.determinant();
    const Matrix3d C = F.transpose() * F;
    const double I1 = C.trace(), I2 = 0.5 * (I1 * I1 - (C * C).trace());
    return c10 * (std::pow(J, -2.0 / 3) * I1 - 3) + c01 * (std::pow(J, -4.0 / 3) * I2 - 3) +
           kappa / 2 * (J - 1) * (J - 1);
}

struct Plane {
    static constexpr int value = 2;
};
struct Space {
    static constexpr int value = 3;
};

}  // namespace

TEST_CASE_TEMPLATE("stress and tangent are derivatives", Dimension, Plane, Space) {
    constexpr int D = Dimension::value;
    check_derivatives<D>(SaintVenantKirchhoff<D>::solid(3, 0.3), 3);
    check_derivatives<D>(LinearElastic<D>::solid(3, 0.3), 3);
    check_derivatives<D>(NeoHookean<D>::solid(3, 0.3), 3);
    check_derivatives<D>(NeoHookean<D>::solid(3, 0.499), 3 / (3 * (1 - 2 * 0.499)));
    check_derivatives<D>(MooneyRivlin<D>{0.4, 0.25, 10}, 10);
    if constexpr (D == 2) {
        check_derivatives<2>(SaintVenantKirchhoff<2>::plane_stress(3, 0.3), 3);
        check_derivatives<2>(LinearElastic<2>::plane_stress(3, 0.3), 3);
    }
}

TEST_CASE_TEMPLATE("Saint Venant–Kirchhoff is the law in the full F", Dimension, Plane, Space) {
    constexpr int D = Dimension::value;
    constexpr double E = 3, nu = 0.3;
    for (const H_<D>& H : gradients<D>()) {
        const Matrix3d F = deformation<D>(H);
        check_against<D>(SaintVenantKirchhoff<D>::solid(E, nu), H, F, F * second_piola_svk(F, E, nu), E);
        if constexpr (D == 2) {
            const auto stress = SaintVenantKirchhoff<2>::plane_stress(E, nu);
            const double stretch = stress.across(kinematics<SaintVenantKirchhoff<2>, 2, double>(H)).stretch;
            if (!(stretch > 0)) continue;  // not a number where a large strain leaves no thickness
            const Matrix3d F_stress = deformation<2>(H, stretch), S = second_piola_svk(F_stress, E, nu);
            CHECK(std::abs(S(2, 2)) < 1e-14 * E);
            check_against<2>(stress, H, F_stress, F_stress * S, E);
        }
    }
}

TEST_CASE_TEMPLATE("linear elasticity is Hooke's law in the linear strain", Dimension, Plane, Space) {
    constexpr int D = Dimension::value;
    constexpr double E = 3, nu = 0.3;
    for (const H_<D>& H : gradients<D>()) {
        const Matrix3d F = deformation<D>(H), strain = 0.5 * (F + F.transpose()) - Matrix3d::Identity();
        const Matrix3d sigma =
            E * nu / ((1 + nu) * (1 - 2 * nu)) * strain.trace() * Matrix3d::Identity() + E / (1 + nu) * strain;
        check_against<D>(LinearElastic<D>::solid(E, nu), H, F, sigma, E);
    }
}

TEST_CASE_TEMPLATE("neo-Hooke and Mooney–Rivlin are the laws in the full F", Dimension, Plane, Space) {
    constexpr int D = Dimension::value;
    constexpr double E = 3, nu = 0.45, mu = E / (2 * (1 + nu)), kappa = E / (3 * (1 - 2 * nu));
    for (const H_<D>& H : gradients<D>()) {
        const Matrix3d F = deformation<D>(H);
        check_against<D>(NeoHookean<D>::solid(E, nu), H, F, mooney_rivlin_piola(F, mu / 2, 0, kappa), kappa);
        CHECK(energy_at(NeoHookean<D>::solid(E, nu), H) ==
              doctest::Approx(mooney_rivlin_energy(F, mu / 2, 0, kappa)).epsilon(1e-12));
        const MooneyRivlin<D> rubber{0.4, 0.25, 7};
        check_against<D>(rubber, H, F, mooney_rivlin_piola(F, 0.4, 0.25, 7), 7);
        CHECK(energy_at(rubber, H) == doctest::Approx(mooney_rivlin_energy(F, 0.4, 0.25, 7)).epsilon(1e-12));
    }
}

TEST_CASE_TEMPLATE("all laws are linear elasticity at small strain", Dimension, Plane, Space) {
    constexpr int D = Dimension::value;
    constexpr double E = 2, nu = 0.35, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
    const auto check = [&](const auto& law) {
        using Law = std::remove_cvref_t<decltype(law)>;
        const auto A = full_tangent(law, kinematics<Law, D, double>({}));
        CHECK(A.c[0][0] == doctest::Approx(lambda + 2 * mu).epsilon(1e-14));
        CHECK(A.c[0][D * D - 1] == doctest::Approx(lambda).epsilon(1e-14));
        CHECK(A.c[1][1] == doctest::Approx(mu).epsilon(1e-14));
        CHECK(A.c[1][D] == doctest::Approx(mu).epsilon(1e-14));
        CHECK(A.c[0][1] == 0);
    };
    check(SaintVenantKirchhoff<D>::solid(E, nu));
    check(LinearElastic<D>::solid(E, nu));
    check(NeoHookean<D>::solid(E, nu));
    check(MooneyRivlin<D>{0.3 * mu, 0.2 * mu, lambda + 2 * mu / 3});
}

TEST_CASE_TEMPLATE("tiny strains keep their digits", Dimension, Plane, Space) {  // formed from FᵀF they would have six
    constexpr int D = Dimension::value;
    constexpr double strain = 1e-10, E = 1, nu = 0.3, mu = E / (2 * (1 + nu)), kappa = E / (3 * (1 - 2 * nu));
    H_<D> H;
    for (std::size_t i = 0; i < D; ++i)
        for (std::size_t j = 0; j < D; ++j) H(i, j) = strain * (1 - 0.4 * double(i) + 0.3 * double(j));
    const auto stress = [&](const auto& law) {
        return first_piola(law, kinematics<std::remove_cvref_t<decltype(law)>, D, double>(H));
    };
    const auto expected = stress(LinearElastic<D>::solid(E, nu));
    for (const auto& P : {stress(NeoHookean<D>::solid(E, nu)), stress(MooneyRivlin<D>{0.3 * mu, 0.2 * mu, kappa})})
        for (std::size_t q = 0; q < D * D; ++q)
            CHECK(P(q / D, q % D) == doctest::Approx(expected(q / D, q % D)).epsilon(1e-8));
}

TEST_CASE_TEMPLATE("a rotation costs nothing", Dimension, Plane, Space) {
    constexpr int D = Dimension::value;
    H_<D> H;
    H(0, 0) = H(1, 1) = std::cos(2.0) - 1;
    H(1, 0) = std::sin(2.0);
    H(0, 1) = -std::sin(2.0);
    const auto check = [&](const auto& law) {
        const auto P = first_piola(law, kinematics<std::remove_cvref_t<decltype(law)>, D, double>(H));
        for (std::size_t q = 0; q < D * D; ++q) CHECK(std::abs(P(q / D, q % D)) < 2e-15);
    };
    check(SaintVenantKirchhoff<D>::solid(1, 0.3));
    check(NeoHookean<D>::solid(1, 0.3));
    check(MooneyRivlin<D>{0.2, 0.1, 1});
}

TEST_CASE("packs of lanes compute what single numbers compute") {
    const auto states = gradients<3>();
    Tensor<3, Lane> H;
    for (std::size_t l = 0; l < lanes; ++l)
        for (std::size_t q = 0; q < 9; ++q) H(q / 3, q % 3)[l] = states[l % states.size()](q / 3, q % 3);
    const MooneyRivlin<3> law{0.4, 0.25, 7};
    const auto packed = full_tangent(law, kinematics<MooneyRivlin<3>, 3, Lane>(H));
    for (std::size_t l = 0; l < lanes; ++l) {
        const auto single = full_tangent(law, kinematics<MooneyRivlin<3>, 3, double>(states[l % states.size()]));
        for (std::size_t p = 0; p < 9; ++p)
            for (std::size_t q = 0; q < 9; ++q) CHECK(std::abs(packed.c[p][q][l] - single.c[p][q]) < 1e-13 * 7);
    }
}

TEST_CASE("the inverse cube root holds where the law is said to hold") {
    for (double J = 0.05; J < 20; J *= 1.01)
        CHECK(inverse_cube_root(J) == doctest::Approx(1 / std::cbrt(J)).epsilon(4e-16));
}
