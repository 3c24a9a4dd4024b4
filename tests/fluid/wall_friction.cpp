// Friction on walls of normal fluxes by both viscous operators: the kernel's part behind the wall against quadrature,
// and no viscous force where the velocity is linear.
#include "physics/fluid/walls/wall_friction.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/normal_flux_driver.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

template <class Kernel, int D>
void check_shadow(const Kernel& kernel) {
    const double R = kernel.radius();
    for (const double q : {0.02, 0.3, 0.49, 0.5, 0.7, 0.99}) {
        double integral = 0;
        const int n = 20000;
        for (int k = 0; k < n; ++k) {
            const double s = R * (q + (1 - q) * (k + 0.5) / n);
            integral -= kernel.derivative(s) / (s * s) * R * (1 - q) / n;
        }
        CAPTURE(q);
        CHECK(shear_shadow<D>(kernel, q * R) == doctest::Approx(integral).epsilon(1e-5));
    }
    CHECK(std::fabs(shear_shadow<D>(kernel, 1.2 * R)) < 1e-12 * shear_shadow<D>(kernel, 0.5 * R));
}

// Largest viscous force over that which pairs alone exert, on particles between two plates of which one moves.
template <int D>
double left_over(ViscousOperator form, double spacing, double jitter) {
    Random random(5);
    std::array<int, D> cells;
    for (std::size_t d = 0; d < D; ++d) cells[d] = int(std::lround((d + 1 == D ? 1.0 : 0.8) / spacing));
    Fluid<D> fluid = make_fluid<D>(spacing, water);
    fluid.viscosity = {1, form};
    fluid.particles = place<D>(lattice<D>(cells, spacing, jitter, random), spacing);
    for (std::size_t i = 0; i < fluid.particles.count; ++i) fluid.particles.v[0][i] = 3 * fluid.particles.x[D - 1][i];
    Panels<D> panels;
    if constexpr (D == 2) {
        panels.add_wall("lower", {{-1, 0}, {2, 0}}, false, true);
        panels.add_wall("upper", {{2, 1}, {-1, 1}}, false, true);
    } else {
        panels.add_wall("lower", {{-1, -1, 0}, {2, -1, 0}, {2, 2, 0}, {-1, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}, true);
        panels.add_wall("upper", {{-1, -1, 1}, {-1, 2, 1}, {2, 2, 1}, {2, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}, true);
    }
    FluxDriver<D> driver(std::move(fluid), std::move(panels));
    for (std::size_t k = D == 2 ? 2 : 4; k < (D == 2 ? 4 : 8); ++k) driver.walls.panels.velocity[k][0] = 3;
    driver.rebuild();
    auto& s = driver.fluid.particles;
    double pairs = 0, left = 0;
    for (const bool walls : {false, true}) {
        for (auto& a : s.acceleration) std::fill(a.begin(), a.end(), 0.0);
        for (std::size_t block = 0; block < driver.fluid.blocks(); ++block) {
            add_viscosity(s, driver.fluid.lists, driver.fluid.kernel, driver.fluid.viscosity,
                          driver.fluid.lanes(block));
            if (walls) driver.walls.add_shear(s, driver.fluid.kernel, driver.fluid.viscosity, spacing, block);
        }
        double& largest = walls ? left : pairs;
        for (std::size_t i = 0; i < s.count; ++i) {
            bool inside = true;  // away from the ends, which are open
            for (std::size_t d = 0; d + 1 < D; ++d) inside = inside && std::fabs(s.x[d][i] - 0.4) < 0.1;
            for (std::size_t d = 0; d < D && inside; ++d) largest = std::max(largest, std::fabs(s.acceleration[d][i]));
        }
    }
    return left / pairs;
}

}  // namespace

TEST_CASE("the shadow of a wall in Monaghan and Gingold's operator is the integral of the kernel's slope over s²") {
    check_shadow<WendlandC2<2>, 2>(WendlandC2<2>(0.3));
    check_shadow<WendlandC2<3>, 3>(WendlandC2<3>(0.3));
    check_shadow<CubicSpline<2>, 2>(CubicSpline<2>(0.3));
    check_shadow<CubicSpline<3>, 3>(CubicSpline<3>(0.3));
}

TEST_CASE("between two plates that water sticks to a linear velocity feels no viscous force, by either operator") {
    for (const ViscousOperator form : {ViscousOperator::morris, ViscousOperator::monaghan_gingold}) {
        const double plane = left_over<2>(form, 0.025, 0), space = left_over<3>(form, 0.1, 0);
        MESSAGE(int(form) << ": of what pairs exert " << plane << " is left, in space " << space);
        CHECK(plane < 0.05);
        CHECK(space < 0.05);
    }
}
