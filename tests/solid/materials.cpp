// Each law against an independent one written in the full three-dimensional F, and its derivatives against finite
// differences.
#include "physics/solid/materials/neo_hookean.hpp"
#include "physics/solid/materials/saint_venant_kirchhoff.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <vector>

using namespace aquagraph::solid;

namespace {

const std::vector<PlaneTensor> gradients{{0, 0, 0, 0},          {1e-3, 2e-3, -1e-3, -2e-3}, {0.2, 0.1, -0.3, 0.15},
                                         {-0.2, 0.4, 0.1, 0.3}, {-0.5, -0.87, 0.87, -0.5},  {0.6, 0.0, 0.9, -0.3}};

PlaneTensor plus(PlaneTensor H, std::size_t component, double step) {
    (component == 0 ? H.xx : component == 1 ? H.xy : component == 2 ? H.yx : H.yy) += step;
    return H;
}

template <class Material>
void check_derivatives(const Material& material, double modulus) {
    constexpr double h = 1e-5;
    for (const PlaneTensor& H : gradients) {
        const auto P = components(material.first_piola(H));
        const auto A = material.tangent(H);
        for (std::size_t q = 0; q < 4; ++q) {
            const double slope = (material.energy(plus(H, q, h)) - material.energy(plus(H, q, -h))) / (2 * h);
            CHECK(std::abs(P[q] - slope) < 1e-8 * modulus);
            const auto above = components(material.first_piola(plus(H, q, h)));
            const auto below = components(material.first_piola(plus(H, q, -h)));
            for (std::size_t p = 0; p < 4; ++p) {
                CHECK(std::abs(A[p][q] - (above[p] - below[p]) / (2 * h)) < 1e-8 * modulus);
                CHECK(std::abs(A[p][q] - A[q][p]) <= 1e-14 * modulus);
            }
        }
    }
}

Eigen::Matrix3d deformation(const PlaneTensor& H, double stretch) {
    Eigen::Matrix3d F;
    F << 1 + H.xx, H.xy, 0, H.yx, 1 + H.yy, 0, 0, 0, stretch;
    return F;
}

Eigen::Matrix3d second_piola_svk(const Eigen::Matrix3d& F, double E, double nu) {
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity(), strain = 0.5 * (F.transpose() * F - I);
    return E * nu / ((1 + nu) * (1 - 2 * nu)) * strain.trace() * I + E / (1 + nu) * strain;
}

template <class Material>
void check_against(const Material& material, const PlaneTensor& H, const Eigen::Matrix3d& F, const Eigen::Matrix3d& P,
                   double modulus) {
    const PlaneTensor mine = material.first_piola(H);
    CHECK(std::abs(mine.xx - P(0, 0)) < 1e-13 * modulus);
    CHECK(std::abs(mine.xy - P(0, 1)) < 1e-13 * modulus);
    CHECK(std::abs(mine.yx - P(1, 0)) < 1e-13 * modulus);
    CHECK(std::abs(mine.yy - P(1, 1)) < 1e-13 * modulus);
    CHECK(std::abs(material.thickness(H).first_piola - P(2, 2)) < 1e-13 * modulus);
    const Eigen::Matrix3d sigma = P * F.transpose() / F.determinant();
    const Eigen::Matrix3d deviator = sigma - sigma.trace() / 3 * Eigen::Matrix3d::Identity();
    CHECK(von_mises(material, H) == doctest::Approx(std::sqrt(1.5) * deviator.norm()).epsilon(1e-10));
}

}  // namespace

TEST_CASE("Saint Venant–Kirchhoff: stress and tangent are derivatives, in plane strain and plane stress") {
    check_derivatives(SaintVenantKirchhoff::plane_strain(3, 0.3), 3);
    check_derivatives(SaintVenantKirchhoff::plane_stress(3, 0.3), 3);
}

TEST_CASE("neo-Hooke: stress and tangent are derivatives, compressible and nearly not") {
    check_derivatives(NeoHookean::plane_strain(3, 0.3), 3);
    check_derivatives(NeoHookean::plane_strain(3, 0.499), 3 / (3 * (1 - 2 * 0.499)));
}

TEST_CASE("Saint Venant–Kirchhoff in the plane is the three-dimensional law") {
    constexpr double E = 3, nu = 0.3;
    for (const PlaneTensor& H : gradients) {
        const Eigen::Matrix3d F = deformation(H, 1);
        check_against(SaintVenantKirchhoff::plane_strain(E, nu), H, F, F * second_piola_svk(F, E, nu), E);
        const auto stress = SaintVenantKirchhoff::plane_stress(E, nu);
        if (stress.thickness(H).stretch > 0) {  // not a number where a large strain leaves no thickness
            const Eigen::Matrix3d F_stress = deformation(H, stress.thickness(H).stretch);
            const Eigen::Matrix3d S = second_piola_svk(F_stress, E, nu);
            CHECK(std::abs(S(2, 2)) < 1e-14 * E);
            check_against(stress, H, F_stress, F_stress * S, E);
        }
    }
}

TEST_CASE("neo-Hooke in the plane is the three-dimensional law") {
    constexpr double E = 3, nu = 0.45, mu = E / (2 * (1 + nu)), kappa = E / (3 * (1 - 2 * nu));
    for (const PlaneTensor& H : gradients) {
        const Eigen::Matrix3d F = deformation(H, 1), F_inverse_transposed = F.inverse().transpose();
        const double J = F.determinant(), I_1 = (F.transpose() * F).trace();
        const Eigen::Matrix3d P = mu * std::pow(J, -2.0 / 3) * (F - I_1 / 3 * F_inverse_transposed) +
                                  kappa * (J - 1) * J * F_inverse_transposed;
        check_against(NeoHookean::plane_strain(E, nu), H, F, P, kappa);
        CHECK(
            NeoHookean::plane_strain(E, nu).energy(H) ==
            doctest::Approx(mu / 2 * (std::pow(J, -2.0 / 3) * I_1 - 3) + kappa / 2 * (J - 1) * (J - 1)).epsilon(1e-12));
    }
}

TEST_CASE("both laws are linear elasticity at small strain") {
    constexpr double E = 2, nu = 0.35, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
    const auto svk = SaintVenantKirchhoff::plane_strain(E, nu).tangent({});
    const auto neo = NeoHookean::plane_strain(E, nu).tangent({});
    for (const auto& A : {svk, neo}) {
        CHECK(A[0][0] == doctest::Approx(lambda + 2 * mu).epsilon(1e-14));
        CHECK(A[0][3] == doctest::Approx(lambda).epsilon(1e-14));
        CHECK(A[1][1] == doctest::Approx(mu).epsilon(1e-14));
        CHECK(A[1][2] == doctest::Approx(mu).epsilon(1e-14));
    }
}

TEST_CASE("tiny strains keep their digits") {  // 1e-10: formed from FᵀF or J they would have six
    constexpr double strain = 1e-10, E = 1;
    const NeoHookean neo = NeoHookean::plane_strain(E, 0.3);
    const SaintVenantKirchhoff svk = SaintVenantKirchhoff::plane_strain(E, 0.3);
    const PlaneTensor H{strain, 0.3 * strain, -0.2 * strain, 0.5 * strain};
    CHECK(neo.first_piola(H).xx == doctest::Approx(svk.first_piola(H).xx).epsilon(1e-9));
    CHECK(neo.first_piola(H).xy == doctest::Approx(svk.first_piola(H).xy).epsilon(1e-8));
}

TEST_CASE("a rotation costs nothing") {
    const PlaneTensor H{std::cos(2.0) - 1, -std::sin(2.0), std::sin(2.0), std::cos(2.0) - 1};
    for (const double stress : components(SaintVenantKirchhoff::plane_strain(1, 0.3).first_piola(H)))
        CHECK(std::abs(stress) < 1e-15);
    for (const double stress : components(NeoHookean::plane_strain(1, 0.3).first_piola(H)))
        CHECK(std::abs(stress) < 1e-15);
}

TEST_CASE("the inverse cube root holds where the law is said to hold") {
    for (double J = 0.05; J < 20; J *= 1.01)
        CHECK(inverse_cube_root(J) == doctest::Approx(1 / std::cbrt(J)).epsilon(4e-16));
}
