// How much of a particle's kernel lies in the fluid, exactly (thesis (2.81), which leaves γ = 1 in 3D):
//     γ_i = ∫_fluid W(x_i - y) dV = 1 - Σ_k ∫_{panel k} H(r) (n·r̂)/r^(D-1) dS,     H(r) = ∫_r^R W(s) s^(D-1) ds:
// along every ray from x_i the kernel's mass behind the wall is missing. n points out of the fluid, r̂ from x_i to the
// wall. Both integrals are elementary for kernels that are piecewise polynomials, so nothing is left to quadrature:
//   2D, a segment at distance d, t along it from the foot of the perpendicular, r² = d² + t²:
//     ∫ H(r) d/r² dt,   from  J_k = d ∫ r^(k-2) dt = [d t r^(k-2) + (k-2) d² J_(k-2)]/(k-1),  J_0 = arctan(t/d),
//     J_1 = d arsinh(t/d);
//   3D, a triangle at distance d, as the signed sum of three triangles between the foot and an edge: with polar
//     coordinates about the foot the radial integral d ∫ H/r² dr is a polynomial F(r), and along an edge whose distance
//     from the foot is h, a² = d² + h², r² = a² + t², F is integrated over the angle with
//     K_m = ∫ r^m h/(h² + t²) dt = h L_(m-2) + d² K_(m-2),   K_0 = arctan(t/h),  d K_-1 = arctan(t d/(h r)),
//     L_m = ∫ r^m dt = [t r^m + m a² L_(m-2)]/(m+1),         L_0 = t,            L_-1 = arsinh(t/a).
// The constant term of H is the angle (solid angle) under which the panel is seen. (In 2D for Wendland kernels: Leroy
// et al. 2014; the reduction of triangles to edges is that of Violeau et al. 2014.) All recurrences add terms of one
// sign; the error is that of rounding, about 1e-15, however close the panel.
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>

#include "physics/fluid/kernel.hpp"

namespace aquagraph::fluid {

// H(r) of a kernel, as polynomials of q = r/R on consecutive intervals: H = Σ_k c_k q^k. [-] (W s^(D-1) ds integrates
// to 1/(2π) in 2D, 1/(4π) in 3D.)
template <int D>
struct KernelMass {
    static constexpr int degree = 5 + D, most_intervals = 2;
    struct Interval {
        double end;  // q
        std::array<double, degree + 1> c;
    };
    double radius;  // R [m]
    int intervals = 0;
    std::array<Interval, most_intervals> interval;

    // W R^D = Σ_k w[k] q^k up to q = end, piece by piece; the last one ends at 1.
    struct KernelPiece {
        double end;
        std::array<double, 6> w;
    };
    KernelMass(double radius, std::span<const KernelPiece> pieces);
    explicit KernelMass(const Kernel<D>& kernel);

    double operator()(double r) const;  // H(r)
};

// ∫ H(r) (n·r̂)/r^(D-1) dS over one panel, in [0, 1]: what the panel takes from γ. `corner` are the panel's vertices
// seen from the particle, x_k - x_i [m], `normal` the unit normal into the fluid. A particle behind the panel is
// taken to be on it: what lies behind a wall by a hair is still fluid. The sign of the result is that of a panel seen
// from its front, never negative.
double missing_mass(const KernelMass<2>& mass, const std::array<Eigen::Vector2d, 2>& corner,
                    const Eigen::Vector2d& normal);
double missing_mass(const KernelMass<3>& mass, const std::array<Eigen::Vector3d, 3>& corner,
                    const Eigen::Vector3d& normal);

extern template struct KernelMass<2>;
extern template struct KernelMass<3>;

}  // namespace aquagraph::fluid
