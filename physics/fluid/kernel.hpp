// Wendland's C2 kernel on the support radius R (thesis (2.26)), q = r/R:
//     W = β ½ (1-q)⁴ (1+4q),   W' = -10 β q (1-q)³ / R,   β = 14/(πR²) in 2D, 21/(πR³) in 3D.
// Pair loops use slope(q) = -W'/r = 10 β (1-q)³ / R², which is positive and regular at r = 0: ∇W_ij = slope (x_j -
// x_i).
#pragma once
#include <algorithm>
#include <numbers>

namespace aquagraph::fluid {

template <int D>
class WendlandC2 {
  public:
    explicit WendlandC2(double radius)
        : radius_(radius),
          beta_(D == 2 ? 14 / (std::numbers::pi * radius * radius)
                       : 21 / (std::numbers::pi * radius * radius * radius)) {
        static_assert(D == 2 || D == 3);
    }

    double radius() const { return radius_; }
    double value(double r) const {  // W [1/m^D]
        const double q = r / radius_, u = std::max(0.0, 1 - q);
        return 0.5 * beta_ * u * u * u * u * (1 + 4 * q);
    }
    double derivative(double r) const {  // W' [1/m^(D+1)]
        return -slope(r / radius_) * r;
    }
    // -W'/r [1/m^(D+2)], zero outside the support.
    [[gnu::always_inline]] double slope(double q) const {
        const double u = std::max(0.0, 1 - q);
        return slope_factor() * u * u * u;
    }
    double slope_factor() const { return 10 * beta_ / (radius_ * radius_); }

  private:
    double radius_, beta_;
};

}  // namespace aquagraph::fluid
