#include "physics/solid/materials/uniaxial_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace aquagraph::solid {

namespace {

// Monotone cubic through points: slopes of Fritsch & Carlson's three-point harmonic kind.
class MonotoneCurve {
  public:
    explicit MonotoneCurve(const std::vector<std::array<double, 2>>& points) : x_{0}, y_{0} {
        for (const auto& [x, y] : points) {
            x_.push_back(x);
            y_.push_back(y);
        }
        const std::size_t n = x_.size();
        const auto secant = [&](std::size_t k) { return (y_[k + 1] - y_[k]) / (x_[k + 1] - x_[k]); };
        slope_.resize(n);
        slope_[0] = secant(0);
        slope_[n - 1] = secant(n - 2);
        for (std::size_t k = 1; k + 1 < n; ++k) {
            const double before = secant(k - 1), after = secant(k), h0 = x_[k] - x_[k - 1], h1 = x_[k + 1] - x_[k];
            const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
            slope_[k] = (w0 + w1) / (w0 / before + w1 / after);
        }
        // The first interval's own end slope: that of the parabola through the first three points, kept monotone.
        if (n > 2) {
            const double h0 = x_[1] - x_[0], h1 = x_[2] - x_[1];
            slope_[0] =
                std::clamp(((2 * h0 + h1) * secant(0) - h0 * secant(1)) / (h0 + h1), 0.1 * secant(0), 3 * secant(0));
        }
    }
    double start_slope() const { return slope_[0]; }
    double end() const { return x_.back(); }
    double operator()(double x) const {
        const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
        const auto k = static_cast<std::size_t>(above - x_.begin()) - 1;
        const double h = x_[k + 1] - x_[k], t = (x - x_[k]) / h;
        return (1 + 2 * t) * (1 - t) * (1 - t) * y_[k] + t * (1 - t) * (1 - t) * h * slope_[k] +
               t * t * (3 - 2 * t) * y_[k + 1] - t * t * (1 - t) * h * slope_[k + 1];
    }

  private:
    std::vector<double> x_, y_, slope_;
};

// λ >= 1 with λ² + 2/λ - 3 = x.
double stretch_at(double x) {
    double e = std::sqrt(x / 3);
    for (int k = 0; k < 60; ++k) {
        const double f = e * e * (3 + e) / (1 + e) - x, f_prime = 2 * (1 + e) - 2 / ((1 + e) * (1 + e));
        if (!(f_prime > 0)) break;
        const double step = f / f_prime;
        e -= step;
        if (std::abs(step) <= 1e-16 * e) break;
    }
    return 1 + e;
}

constexpr std::size_t entries = 4096;

}  // namespace

FirstInvariantTable::FirstInvariantTable(const std::vector<std::array<double, 2>>& curve) {
    if (curve.empty()) throw std::invalid_argument("the uniaxial curve has no point");
    double strain = 0, stress = 0;
    for (std::size_t k = 0; k < curve.size(); ++k) {
        if (!(curve[k][0] > strain) || !(curve[k][1] > stress) || !std::isfinite(curve[k][0] + curve[k][1]))
            throw std::invalid_argument("point " + std::to_string(k + 1) +
                                        " of the uniaxial curve is not beyond the one before it: strain and stress "
                                        "must grow from (0, 0), which is not listed");
        strain = curve[k][0];
        stress = curve[k][1];
    }
    const MonotoneCurve T(curve);
    const double last = 1 + T.end();
    spacing_ = std::sqrt(last * last + 2 / last - 3) / (entries - 1);
    for (std::size_t k = 0; k < entries; ++k) {
        const double s = spacing_ * static_cast<double>(k), lambda = stretch_at(s * s);
        slope_.push_back(k == 0 ? T.start_slope() / 6
                                : T(std::min(lambda, last) - 1) / (2 * (lambda - 1 / (lambda * lambda))));
    }
    energy_.push_back(0);  // ∫ (a + b s) 2 s ds
    for (std::size_t k = 0; k + 1 < entries; ++k) {
        const double s0 = spacing_ * static_cast<double>(k), s1 = s0 + spacing_;
        const double b = (slope_[k + 1] - slope_[k]) / spacing_, a = slope_[k] - b * s0;
        energy_.push_back(energy_.back() + a * (s1 * s1 - s0 * s0) + 2.0 / 3 * b * (s1 * s1 * s1 - s0 * s0 * s0));
    }
}

FirstInvariantTable::Value FirstInvariantTable::operator()(double x) const {
    if (!(x > 0)) return {0, slope_.front(), 0};
    const double s = std::sqrt(x), place = s / spacing_;
    if (!(place < entries - 1)) {
        const double end = spacing_ * (entries - 1);
        return {energy_.back() + slope_.back() * (x - end * end), slope_.back(), 0};
    }
    const auto k = static_cast<std::size_t>(place);
    const double s0 = spacing_ * static_cast<double>(k), b = (slope_[k + 1] - slope_[k]) / spacing_,
                 a = slope_[k] - b * s0;
    return {energy_[k] + a * (x - s0 * s0) + 2.0 / 3 * b * (s * x - s0 * s0 * s0), a + b * s, b / (2 * s)};
}

}  // namespace aquagraph::solid
