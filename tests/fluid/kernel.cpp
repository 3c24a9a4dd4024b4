// The kernel: normalised, its derivative its own, nothing outside the support.
#include "physics/fluid/kernel.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace aquagraph::fluid;

namespace {

// ∫ W dx over the support, shell by shell, by Simpson's rule.
template <int D>
double integral(const WendlandC2<D>& kernel) {
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

template <int D>
void check_kernel(double radius) {
    CAPTURE(D);
    CAPTURE(radius);
    const WendlandC2<D> kernel(radius);
    CHECK(kernel.radius() == radius);
    CHECK(std::fabs(integral(kernel) - 1) < 1e-12);
    const double peak = kernel.value(0), h = 1e-5 * radius;
    for (int k = 1; k < 100; ++k) {
        const double r = 0.01 * k * radius;
        const double difference = (kernel.value(r + h) - kernel.value(r - h)) / (2 * h);
        CHECK(std::fabs(kernel.derivative(r) - difference) < 1e-8 * peak / radius);
        CHECK(kernel.derivative(r) < 0);
        CHECK(kernel.value(r) > 0);
        // ∇W = slope (x_j - x_i): slope r = -W', and the form that pair loops multiply out themselves.
        CHECK(std::fabs(kernel.slope(r / radius) * r + kernel.derivative(r)) < 1e-14 * peak / radius);
        CHECK(std::fabs(kernel.slope_factor() * std::pow(1 - r / radius, 3) - kernel.slope(r / radius)) <
              1e-14 * kernel.slope_factor());
    }
    for (const double q : {1.0, 1.0000001, 1.5, 100.0}) {
        CHECK(kernel.value(q * radius) == 0);
        CHECK(kernel.derivative(q * radius) == 0);
        CHECK(kernel.slope(q) == 0);
    }
    // Smooth at the edge: W'' still vanishes there.
    CHECK(std::fabs(kernel.derivative((1 - 1e-4) * radius)) < 1e-9 * peak / radius);
    CHECK(kernel.slope(0) == kernel.slope_factor());
}

}  // namespace

TEST_CASE("the kernel integrates to one, its derivative is that of its value, its support is compact") {
    for (const double radius : {0.008, 1.0, 3.7}) {
        check_kernel<2>(radius);
        check_kernel<3>(radius);
    }
}

TEST_CASE("the kernel's peak is that of Wendland's C2 in the literature") {
    const double h = 0.35;  // support 2h
    CHECK(WendlandC2<2>(2 * h).value(0) == doctest::Approx(7 / (4 * M_PI * h * h)).epsilon(1e-14));
    CHECK(WendlandC2<3>(2 * h).value(0) == doctest::Approx(21 / (16 * M_PI * h * h * h)).epsilon(1e-14));
}
