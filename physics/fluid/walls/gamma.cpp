#include "physics/fluid/walls/gamma.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace aquagraph::fluid {

template <int D>
KernelMass<D>::KernelMass(double radius, std::span<const KernelPiece> pieces)
    : radius(radius), intervals(int(pieces.size())), interval{} {
    // From outside in, so that H is continuous and ends at 0.
    double beyond = 0;
    for (std::size_t p = pieces.size(); p-- > 0;) {
        Interval& of = interval[p];
        of.end = pieces[p].end;
        double at_end = 0;
        for (std::size_t k = 0; k < pieces[p].w.size(); ++k) {
            of.c[k + D] = -pieces[p].w[k] / double(k + D);
            at_end += of.c[k + D] * std::pow(of.end, double(k + D));
        }
        of.c[0] = beyond - at_end;
        if (p == 0) continue;
        beyond = of.c[0];
        for (std::size_t k = D; k <= degree; ++k) beyond += of.c[k] * std::pow(pieces[p - 1].end, double(k));
    }
}

namespace {
// ½ β (1-q)⁴ (1+4q) = ½ β (1 - 10q² + 20q³ - 15q⁴ + 4q⁵)
template <int D>
std::array<typename KernelMass<D>::KernelPiece, 1> pieces_of(const WendlandC2<D>&) {
    const double b = (D == 2 ? 7 : 10.5) / std::numbers::pi;
    return {{{1.0, {b, 0, -10 * b, 20 * b, -15 * b, 4 * b}}}};
}
// β (1/3 - 2q² + 2q³) and ⅔ β (1-q)³ = ⅔ β (1 - 3q + 3q² - q³)
template <int D>
std::array<typename KernelMass<D>::KernelPiece, 2> pieces_of(const CubicSpline<D>&) {
    const double b = (D == 2 ? 120.0 / 7 : 24) / std::numbers::pi, b2 = 2 * b / 3;
    return {{{0.5, {b / 3, 0, -2 * b, 2 * b, 0, 0}}, {1.0, {b2, -3 * b2, 3 * b2, -b2, 0, 0}}}};
}
}  // namespace

template <int D>
KernelMass<D>::KernelMass(const Kernel<D>& kernel)
    : KernelMass(kernel.visit([](const auto& k) { return KernelMass(k.radius(), pieces_of(k)); })) {}

template <int D>
double KernelMass<D>::operator()(double r) const {
    const double q = r / radius;
    if (q >= 1) return 0;
    int p = 0;
    while (q > interval[std::size_t(p)].end) ++p;
    double h = 0;
    for (std::size_t k = degree + 1; k-- > 0;) h = h * q + interval[std::size_t(p)].c[k];
    return h;
}

namespace {

// Closer than this to a panel's plane (or an edge's line), in R, is on it.
constexpr double on_it = 1e-13;

// ∫_0^t H(r) d/r² dt for 0 <= t <= sqrt(1 - d²), everything in units of R.
double along_segment(const KernelMass<2>& mass, double d, double t) {
    constexpr int n = KernelMass<2>::degree;
    const auto antiderivative = [&](const std::array<double, n + 1>& c, double s) {
        if (s == 0) return 0.0;
        const double r = std::sqrt(d * d + s * s);
        double J[n + 1], power = 1;  // r^(k-2)
        J[0] = std::atan2(s, d);
        J[1] = d * std::asinh(s / d);
        double sum = c[0] * J[0];
        for (int k = 2; k <= n; ++k) {
            J[k] = (d * s * power + (k - 2) * d * d * J[k - 2]) / (k - 1);
            sum += c[std::size_t(k)] * J[k];
            power *= r;
        }
        return sum;
    };
    double sum = 0, from = 0;
    for (int p = 0; p < mass.intervals; ++p) {
        const auto& part = mass.interval[std::size_t(p)];
        const double room = part.end * part.end - d * d;
        if (room <= 0) continue;
        const double to = std::min(t, std::sqrt(room));
        sum += antiderivative(part.c, to) - antiderivative(part.c, from);
        if (to == t) break;
        from = to;
    }
    return sum;
}

// F(r) = d ∫_d^r H/s² ds of the plane at distance d, interval by interval, in units of R.
class RadialIntegral {
  public:
    static constexpr int n = KernelMass<3>::degree;

    RadialIntegral(const KernelMass<3>& mass, double d) : mass_(mass), d_(d) {
        double value = 0, from = d;
        for (int p = 0; p < mass.intervals; ++p) {
            const double end = mass.interval[std::size_t(p)].end;
            if (end <= from) continue;
            constant_[std::size_t(p)] = value - polynomial(p, from);
            value = constant_[std::size_t(p)] + polynomial(p, end);
            from = end;
        }
        whole_ = value;
    }

    // ∫_0^t F(r) h/(h² + t²) dt with r² = d² + h² + t²; F is whole beyond the support.
    double along_edge(double h, double t) const {
        const double a2 = d_ * d_ + h * h;
        double sum = 0, from = 0;
        for (int p = 0; p < mass_.intervals; ++p) {
            const double end = mass_.interval[std::size_t(p)].end, room = end * end - a2;
            if (room <= 0) continue;
            const double to = std::min(t, std::sqrt(room));
            sum += antiderivative(p, h, a2, to) - antiderivative(p, h, a2, from);
            from = to;
            if (to == t) return sum;
        }
        return sum + whole_ * (std::atan2(t, h) - std::atan2(from, h));
    }

  private:
    // d times the antiderivative of H/r²: d (-c_0/r + Σ c_k r^(k-1)/(k-1)).
    double polynomial(int p, double r) const {
        const auto& c = mass_.interval[std::size_t(p)].c;
        double sum = 0, power = r;
        for (int k = 2; k <= n; ++k) {
            sum += c[std::size_t(k)] * power / (k - 1);
            power *= r;
        }
        return d_ * sum - c[0] * (d_ / r);
    }

    double antiderivative(int p, double h, double a2, double t) const {
        if (t == 0) return 0;
        const auto& c = mass_.interval[std::size_t(p)].c;
        const double r = std::sqrt(a2 + t * t), angle = std::atan2(t, h), seen = std::atan2(t * d_, h * r);
        // L[m + 1], K[m + 1] for m = -1, 0, …
        double L[n + 1], K[n + 1], power = r;
        L[0] = std::asinh(t / std::sqrt(a2));
        L[1] = t;
        for (int m = 1; m <= n - 3; ++m) {
            L[m + 1] = (t * power + m * a2 * L[m - 1]) / (m + 1);
            power *= r;
        }
        K[1] = angle;
        K[2] = h * L[0] + d_ * seen;
        for (int m = 2; m <= n - 1; ++m) K[m + 1] = h * L[m - 1] + d_ * d_ * K[m - 1];
        double sum = 0;
        for (int k = 2; k <= n; ++k) sum += c[std::size_t(k)] * K[k] / (k - 1);
        return constant_[std::size_t(p)] * angle + d_ * sum - c[0] * seen;
    }

    const KernelMass<3>& mass_;
    double d_, whole_ = 0;
    std::array<double, KernelMass<3>::most_intervals> constant_{};
};

}  // namespace

double missing_mass(const KernelMass<2>& mass, const std::array<Eigen::Vector2d, 2>& corner,
                    const Eigen::Vector2d& normal) {
    const double scale = 1 / mass.radius;
    const double d = std::max(-corner[0].dot(normal) * scale, on_it);
    if (d >= 1) return 0;
    const double end = std::sqrt(1 - d * d);
    const Eigen::Vector2d tangent(normal.y(), -normal.x());  // first -> second, fluid on the left
    const auto from_foot = [&](const Eigen::Vector2d& x) {
        const double t = x.dot(tangent) * scale, s = along_segment(mass, d, std::min(std::fabs(t), end));
        return t < 0 ? -s : s;
    };
    return std::max(0.0, from_foot(corner[1]) - from_foot(corner[0]));
}

double missing_mass(const KernelMass<3>& mass, const std::array<Eigen::Vector3d, 3>& corner,
                    const Eigen::Vector3d& normal) {
    const double scale = 1 / mass.radius;
    const double d = std::max(-corner[0].dot(normal) * scale, on_it);
    if (d >= 1) return 0;
    const RadialIntegral radial(mass, d);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3d &a = corner[k], &b = corner[(k + 1) % 3];
        const Eigen::Vector3d along = (b - a).normalized();
        // The foot lies on the inner side of an edge where h > 0.
        const double h = along.cross(normal).dot(a) * scale, t_a = a.dot(along) * scale, t_b = b.dot(along) * scale;
        if (std::fabs(h) < on_it) continue;
        const auto from_foot = [&](double t) {
            const double s = radial.along_edge(std::fabs(h), std::fabs(t));
            return t < 0 ? -s : s;
        };
        const double edge = from_foot(t_b) - from_foot(t_a);
        sum += h > 0 ? edge : -edge;
    }
    return std::max(0.0, sum);
}

template struct KernelMass<2>;
template struct KernelMass<3>;

}  // namespace aquagraph::fluid
