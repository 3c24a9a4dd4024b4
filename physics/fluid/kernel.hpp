// Smoothing kernels on the support radius R, q = r/R, in two and three dimensions:
//     Wendland C2 (thesis (2.26)), the default:
//         W = β ½ (1-q)⁴ (1+4q),   W' = -10 β q (1-q)³ / R,   β = 14/(πR²), 21/(πR³)
//     cubic spline (thesis (2.24)):
//         W = β (1/3 - 2q² + 2q³), W' = β (-4q + 6q²)/R       for q < ½
//         W = β ⅔ (1-q)³,          W' = -2 β (1-q)²/R         for ½ ≤ q < 1,   β = 120/(7πR²), 24/(πR³)
//     (the thesis's (2.25) has -4 (1-q)² in the outer branch, which jumps at q = ½).
// Pair loops use slope = -W'/r, which is positive: ∇W_ij = slope (x_j - x_i). Wendland's is regular at r = 0.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/fluid/choices.hpp"

namespace aquagraph::fluid {

template <int D>
class WendlandC2 {
  public:
    static constexpr KernelName name = KernelName::wendland_c2;

    explicit WendlandC2(double radius)
        : radius_(radius),
          inverse_radius_(1 / radius),
          beta_(D == 2 ? 14 / (std::numbers::pi * radius * radius)
                       : 21 / (std::numbers::pi * radius * radius * radius)),
          slope_factor_(10 * beta_ / (radius * radius)) {
        static_assert(D == 2 || D == 3);
    }

    double radius() const { return radius_; }
    double inverse_radius() const { return inverse_radius_; }
    [[gnu::always_inline]] double value(double r) const {  // W [1/m^D]
        const double q = r / radius_, u = std::max(0.0, 1 - q);
        return 0.5 * beta_ * (u * u) * (u * u) * (1 + 4 * q);
    }
    double derivative(double r) const {  // W' [1/m^(D+1)]
        return -slope(r / radius_) * r;
    }
    // -W'/r [1/m^(D+2)], zero outside the support, times a factor that costs nothing.
    [[gnu::always_inline]] double slope(double q, double factor = 1) const {
        const double u = 1 - q, twice = u + std::fabs(u);  // 2 max(u, 0), exactly
        return 0.125 * factor * slope_factor_ * twice * twice * twice;
    }
    double slope_factor() const { return slope_factor_; }

  private:
    double radius_, inverse_radius_, beta_, slope_factor_;
};

template <int D>
class CubicSpline {
  public:
    static constexpr KernelName name = KernelName::cubic_spline;

    explicit CubicSpline(double radius)
        : radius_(radius),
          inverse_radius_(1 / radius),
          beta_(D == 2 ? 120 / (7 * std::numbers::pi * radius * radius)
                       : 24 / (std::numbers::pi * radius * radius * radius)),
          slope_factor_(beta_ / (radius * radius)) {
        static_assert(D == 2 || D == 3);
    }

    double radius() const { return radius_; }
    double inverse_radius() const { return inverse_radius_; }
    [[gnu::always_inline]] double value(double r) const {  // W [1/m^D]
        const double q = r / radius_, u = std::max(0.0, 1 - q);
        const double inner = 1.0 / 3 + 2 * q * q * (q - 1), outer = 2.0 / 3 * u * u * u;
        return beta_ * (q < 0.5 ? inner : outer);
    }
    double derivative(double r) const {  // W' [1/m^(D+1)]
        return -slope(r / radius_) * r;
    }
    // -W'/r [1/m^(D+2)], zero outside the support.
    [[gnu::always_inline]] double slope(double q, double factor = 1) const {
        const double u = std::max(0.0, 1 - q);
        const double inner = 4 - 6 * q, outer = 2 * u * u / std::max(q, 0.5);
        return factor * slope_factor_ * (q < 0.5 ? inner : outer);
    }

  private:
    double radius_, inverse_radius_, beta_, slope_factor_;
};

// The kernel that a scene has chosen. For single values; pair loops take the kernel's own type from visit().
template <int D>
class Kernel {
  public:
    Kernel(KernelName name, double radius) : name_(name), radius_(radius) {}
    Kernel(const WendlandC2<D>& kernel) : Kernel(kernel.name, kernel.radius()) {}   // NOLINT: a kernel is a kernel
    Kernel(const CubicSpline<D>& kernel) : Kernel(kernel.name, kernel.radius()) {}  // NOLINT

    KernelName name() const { return name_; }
    double radius() const { return radius_; }
    double value(double r) const {
        return visit([&](const auto& kernel) { return kernel.value(r); });
    }
    double derivative(double r) const {
        return visit([&](const auto& kernel) { return kernel.derivative(r); });
    }

    template <class F>
    decltype(auto) visit(F&& f) const {
        if (name_ == KernelName::cubic_spline) return f(CubicSpline<D>(radius_));
        return f(WendlandC2<D>(radius_));
    }

  private:
    KernelName name_;
    double radius_;
};

}  // namespace aquagraph::fluid
