// The largest stable step: the fastest sound, the strongest acceleration, whichever is stricter.
#include "physics/fluid/time_step.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

TEST_CASE("the step is limited by the fastest sound and the strongest acceleration") {
    Random random;
    Particles<2> s = place<2>(lattice<2>({20, 10}, 0.05, 0, random), 0.05);
    const double R = 0.2, cfl = 0.375;
    const auto limits = [&] {
        StepLimits all;
        for (std::size_t block = 0; block < s.blocks(); ++block)
            all = combine(all, step_limits(s, cfl, R, lanes_of_block(s, block)));
        return all;
    };
    StepLimits rest = limits();
    CHECK(rest.sound == doctest::Approx(cfl * R / 20).epsilon(1e-14));
    CHECK(std::isinf(rest.acceleration));
    CHECK(rest.step() == rest.sound);
    CHECK(std::string(rest.name()) == "sound speed");

    s.deviation[150] = 50;  // compressed water is faster
    for (std::size_t block = 0; block < s.blocks(); ++block)
        aquagraph::fluid::update_state(s, water, lanes_of_block(s, block));
    CHECK(limits().sound == doctest::Approx(cfl * R / water.sound_speed_at(50)).epsilon(1e-13));

    s.acceleration[0][7] = 3e4;
    s.acceleration[1][7] = -4e4;
    const StepLimits hit = limits();
    CHECK(hit.acceleration == doctest::Approx(0.25 * std::sqrt(R / 5e4)).epsilon(1e-14));
    CHECK(hit.step() == hit.acceleration);
    CHECK(std::string(hit.name()) == "acceleration");
}

namespace {

// Largest eigenvalue of a viscous operator on the lattice of spacing 1 [µ/ρ]: of its Fourier symbol, a D × D matrix.
template <int D, class Kernel>
double largest_decay(const Kernel& kernel, ViscousOperator form) {
    const double R = kernel.radius();
    const int n = int(R) + 1, waves = D == 2 ? 16 : 8;
    std::vector<Vec<D>> neighbours;
    const auto each = [](int from, int to, auto&& f) {
        for (int x = from; x <= to; ++x)
            for (int y = from; y <= to; ++y)
                for (int z = D == 3 ? from : 0; z <= (D == 3 ? to : 0); ++z) {
                    Vec<D> at;
                    at[0] = x, at[1] = y;
                    if constexpr (D == 3) at[2] = z;
                    f(at);
                }
    };
    each(-n, n, [&](const Vec<D>& x) {
        if (x.norm() > 0 && x.norm() < R) neighbours.push_back(x);
    });
    double largest = 0;
    each(0, waves, [&](const Vec<D>& wave) {
        Mat<D> symbol = Mat<D>::Zero();
        for (const Vec<D>& x : neighbours) {
            const double w = kernel.slope(x.norm() / R) * (1 - std::cos(x.dot(wave) * 3.14159265358979 / waves));
            if (form == ViscousOperator::morris)
                symbol += 2 * w * Mat<D>::Identity();
            else
                symbol += (D == 2 ? 8 : 10) * w / x.squaredNorm() * x * x.transpose();
        }
        Eigen::SelfAdjointEigenSolver<Mat<D>> modes;
        modes.computeDirect(symbol, Eigen::EigenvaluesOnly);
        largest = std::max(largest, modes.eigenvalues()[D - 1]);
    });
    return largest;
}

}  // namespace

TEST_CASE("no velocity on a lattice decays faster than the viscous step allows for") {
    for (const ViscousOperator form : {ViscousOperator::morris, ViscousOperator::monaghan_gingold}) {
        double worst = 0;
        for (const double R : {2.6, 3.0, 4.0}) {
            worst = std::max(worst, R * R * largest_decay<2>(WendlandC2<2>(R), form));
            worst = std::max(worst, R * R * largest_decay<3>(WendlandC2<3>(R), form));
            worst = std::max(worst, R * R * largest_decay<2>(CubicSpline<2>(R), form));
            worst = std::max(worst, R * R * largest_decay<3>(CubicSpline<3>(R), form));
        }
        MESSAGE("fastest decay " << worst << " µ/(ρ R²)");
        CHECK(worst < viscous_decay(form));
        CHECK(worst > 0.9 * viscous_decay(form));
    }
}

TEST_CASE("velocities of viscous water die out at the largest step, whatever operator and integration") {
    for (const ViscousOperator form : {ViscousOperator::morris, ViscousOperator::monaghan_gingold})
        for (const auto integration : {IntegrationScheme::rk4, IntegrationScheme::rk3, IntegrationScheme::verlet}) {
            CAPTURE(int(form));
            CAPTURE(int(integration));
            Random random(11);
            Fluid<2> fluid = make_fluid<2>(0.05, Tait{1000, 1});
            fluid.viscosity = {5000, form};  // the step of viscosity is far below that of sound
            fluid.integration.scheme = integration;
            fluid.particles = place<2>(lattice<2>({20, 20}, 0.05, 0.2, random), 0.05);
            for (auto& v : fluid.particles.v)
                for (std::size_t i = 0; i < fluid.particles.count; ++i) v[i] = 1e-3 * random();
            Driver<2> driver(std::move(fluid));
            const auto energy = [&] { return total_energies(driver.fluid).kinetic; };
            const double before = energy();
            driver.start();
            for (int step = 0; step < 60; ++step) driver.step(driver.largest_step());
            CHECK(driver.time < 60 * 0.1 * 0.375 * 0.2);
            CHECK(energy() < 0.05 * before);
        }
}
