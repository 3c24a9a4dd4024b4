// The second moment of a support, symmetric, inverted for renormalised gradients (gradients.hpp). Without branches:
// loops over particles are to run through it side by side.
#pragma once
#include <cmath>
#include <cstddef>
#include <utility>

namespace aquagraph::fluid {

// B^-1 = m, symmetric: returns its smallest eigenvalue and replaces m by its inverse where that eigenvalue exceeds
// `threshold`. m holds the upper triangle row by row: xx xy yy, or xx xy xz yy yz zz.
template <int D>
double invert_moment(double (&m)[D * (D + 1) / 2], double threshold);

// cos(⅔ acos(s)) on 0 ≤ s ≤ 1: analytic but for s = -1, so that its Chebyshev series falls by 5.8 per term.
class CosineOfTwoThirds {
  public:
    CosineOfTwoThirds();
    [[gnu::always_inline]] double operator()(double s) const {
        return clenshaw(2 * (2 * s - 1), std::make_index_sequence<terms - 1>{});
    }

  private:
    static constexpr int terms = 22;
    // Written out term by term, or lanes side by side would not share their vectors.
    template <std::size_t... k>
    [[gnu::always_inline]] double clenshaw(double x, std::index_sequence<k...>) const {
        double next = 0, after = 0;
        const auto recur = [&](double coefficient) {
            const double here = x * next - after + coefficient;
            after = next;
            next = here;
        };
        (recur(chebyshev_[terms - 1 - k]), ...);
        return 0.5 * x * next - after + chebyshev_[0];
    }
    double chebyshev_[terms] = {};
};
extern const CosineOfTwoThirds cosine_of_two_thirds;

template <>
[[gnu::always_inline]] inline double invert_moment<2>(double (&m)[3], double threshold) {
    const double xx = m[0], xy = m[1], yy = m[2];
    const double mean = 0.5 * (xx + yy);
    const double smallest = mean - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    const bool full = smallest > threshold;
    const double inverse = 1 / (xx * yy - xy * xy);
    m[0] = full ? yy * inverse : xx;
    m[1] = full ? -xy * inverse : xy;
    m[2] = full ? xx * inverse : yy;
    return smallest;
}

// The smallest eigenvalue by the trigonometric solution of the characteristic equation, scaled: A = m + ρ C with
// tr C = 0, tr C² = 6, whose eigenvalues are 2 cos((acos(det C/2) + 2πk)/3). Exact to rounding ε, but where
// the two smallest are close together: there to sqrt(ε) of the largest difference between eigenvalues, at worst.
template <>
[[gnu::always_inline]] inline double invert_moment<3>(double (&m)[6], double threshold) {
    const double mean = (m[0] + m[3] + m[5]) / 3, xx = m[0] - mean, yy = m[3] - mean, zz = m[5] - mean;
    const double xy = m[1], xz = m[2], yz = m[4];
    const double radius2 = (xx * xx + yy * yy + zz * zz + 2 * (xy * xy + xz * xz + yz * yz)) / 6;
    constexpr double equal = 1e-60;  // eigenvalues this close, squared, are one; its power of 3/2 is no underflow yet
    const double radius = std::sqrt(radius2),
                 determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    double half = 0.5 * determinant / (radius2 > equal ? radius2 * radius : 1.0);
    half = half < -1 ? -1.0 : half > 1 ? 1.0 : half;
    const double smallest = mean - 2 * radius * cosine_of_two_thirds(std::sqrt(0.5 - 0.5 * half));
    const bool full = smallest > threshold;
    const double a = m[3] * m[5] - m[4] * m[4], b = m[2] * m[4] - m[1] * m[5], c = m[1] * m[4] - m[2] * m[3];
    const double inverse = 1 / (m[0] * a + m[1] * b + m[2] * c);
    const double d = m[0] * m[5] - m[2] * m[2], e = m[1] * m[2] - m[0] * m[4], f = m[0] * m[3] - m[1] * m[1];
    m[0] = full ? a * inverse : m[0];
    m[1] = full ? b * inverse : m[1];
    m[2] = full ? c * inverse : m[2];
    m[3] = full ? d * inverse : m[3];
    m[4] = full ? e * inverse : m[4];
    m[5] = full ? f * inverse : m[5];
    return smallest;
}

}  // namespace aquagraph::fluid
