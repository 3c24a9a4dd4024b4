// The kernel: normalised, its derivative its own, nothing outside the support.
#include "physics/fluid/kernel.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace aquagraph::fluid;

namespace {

// ∫ W dx over the support, shell by shell, by Simpson's rule.
template <int D>
double integral(const Kernel<D>& kernel) {
    constexpr int intervals = 4000;
    const double h = kernel.radius() / intervals;
    double sum = 0;
    for (int k = 0; k <= intervals; ++k) {
        const double r = k * h, weight = k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2;
        const double shell = D == 2 ? 2 * M_PI * r : 4 * M_PI * r * r;
        sum += weight * h / 3 * shell * kernel.value(r);
    }
    return sum;
}

template <int D, template <int> class K>
void check_kernel(double radius) {
    CAPTURE(D);
    CAPTURE(radius);
    const K<D> kernel(radius);
    CHECK(kernel.radius() == radius);
    CHECK(std::fabs(integral<D>(kernel) - 1) < 1e-12);
    const double peak = kernel.value(0), h = 1e-5 * radius;
    for (int k = 1; k < 100; ++k) {
        const double r = 0.01 * k * radius;
        const double difference = (kernel.value(r + h) - kernel.value(r - h)) / (2 * h);
        CHECK(std::fabs(kernel.derivative(r) - difference) < 1e-8 * peak / radius);
        CHECK(kernel.derivative(r) < 0);
        CHECK(kernel.value(r) > 0);
        // ∇W = slope (x_j - x_i): slope r = -W'.
        CHECK(std::fabs(kernel.slope(r / radius) * r + kernel.derivative(r)) < 1e-14 * peak / radius);
    }
    for (const double q : {1.0, 1.0000001, 1.5, 100.0}) {
        CHECK(kernel.value(q * radius) == 0);
        CHECK(kernel.derivative(q * radius) == 0);
        CHECK(kernel.slope(q) == 0);
    }
    CHECK(std::fabs(kernel.derivative((1 - 1e-4) * radius)) < 1e-6 * peak / radius);
    // Continuous where the cubic spline's branches meet, with its slope.
    for (const double q : {0.5 - 1e-12, 0.5}) {
        CHECK(std::fabs(kernel.value(q * radius) - kernel.value((q + 1e-12) * radius)) < 1e-10 * peak);
        CHECK(std::fabs(kernel.slope(q) - kernel.slope(q + 1e-12)) < 1e-10 * peak / (radius * radius));
    }
}

}  // namespace

TEST_CASE("every kernel integrates to one, its derivative is that of its value, its support is compact") {
    for (const double radius : {0.008, 1.0, 3.7}) {
        check_kernel<2, WendlandC2>(radius);
        check_kernel<3, WendlandC2>(radius);
        check_kernel<2, CubicSpline>(radius);
        check_kernel<3, CubicSpline>(radius);
    }
}

TEST_CASE("the kernel's peak is that of Wendland's C2 in the literature") {
    const double h = 0.35;  // support 2h
    CHECK(WendlandC2<2>(2 * h).value(0) == doctest::Approx(7 / (4 * M_PI * h * h)).epsilon(1e-14));
    CHECK(WendlandC2<3>(2 * h).value(0) == doctest::Approx(21 / (16 * M_PI * h * h * h)).epsilon(1e-14));
}

TEST_CASE("the cubic spline's peak is that of the literature") {
    const double h = 0.35;  // support 2h: 10/(7πh²) in 2D, 1/(πh³) in 3D
    CHECK(CubicSpline<2>(2 * h).value(0) == doctest::Approx(10 / (7 * M_PI * h * h)).epsilon(1e-14));
    CHECK(CubicSpline<3>(2 * h).value(0) == doctest::Approx(1 / (M_PI * h * h * h)).epsilon(1e-14));
}

TEST_CASE("the kernel chosen by name is the kernel") {
    const Kernel<2> spline(KernelName::cubic_spline, 0.3), wendland(KernelName::wendland_c2, 0.3);
    CHECK(spline.value(0.1) == CubicSpline<2>(0.3).value(0.1));
    CHECK(spline.derivative(0.2) == CubicSpline<2>(0.3).derivative(0.2));
    CHECK(wendland.value(0.1) == WendlandC2<2>(0.3).value(0.1));
}
