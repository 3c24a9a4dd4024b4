// What water feels of a wall point that it sticks to, for the viscous operators of viscosity.hpp, whose sums over pairs
// end at the wall. What they miss behind it, where the velocity goes on linearly,  v(x) = v_i + (v_w - v_i) y/h  with
// the distance y along -n, is a sum over wall points (n the normal out of the fluid, h = x_is·n, t = x_is - h n, u the
// slip v_i - v_w along the wall):
//     morris            -∫ 2 µ (y/h) u W'/r dV over the missing part = Σ_s 2 µ u/h W_is A_s     (Ferrand et al. 2013)
//     monaghan_gingold  -∫ K µ (y/h) (x·u) x W'/r³ dV                = Σ_s K µ t (t·u)/h P_is A_s,  K = 8 or 10,
//                       with P(r) = ∫_r^R |W'(s)|/s² ds
// The second follows in the same way as the first: y |W'|/r³ is -dP/dy at fixed t, as y |W'|/r is -dW/dy. Both make
// pairs and walls together vanish where the velocity is linear, next to flat walls.
#pragma once
#include "physics/fluid/viscosity.hpp"
#include "physics/fluid/walls/wall_points.hpp"

namespace aquagraph::fluid {

// P(r) [1/m^(D+2)], 0 < r; 0 beyond the support.
template <int D>
double shear_shadow(const WendlandC2<D>& kernel, double r) {
    const double q = std::min(1.0, r * kernel.inverse_radius());  // ∫_q^1 (1 - s)³/s ds
    return kernel.slope(0) * (-std::log(q) + q * (3 + q * (-1.5 + q / 3)) - 11.0 / 6);
}
template <int D>
double shear_shadow(const CubicSpline<D>& kernel, double r) {
    const double q = std::min(1.0, r * kernel.inverse_radius());
    const auto outer = [](double s) { return 2 * s - 2 / s - 4 * std::log(s); };  // of 2 (1 - s)²/s²
    const double beyond = outer(1) - outer(std::max(q, 0.5));
    return kernel.slope(0.5) * (beyond + (q < 0.5 ? 4 * std::log(0.5 / q) - 6 * (0.5 - q) : 0.0));
}

// The force per volume on a particle by a wall point [N/m^D]: dx from particle to point, n and area of the point, shear
// the slip over the distance [1/s]. Symmetric and positive in the slip, so that friction only ever takes energy.
template <int D, class Kernel>
Vec<D> wall_friction(const Kernel& kernel, const Viscosity& viscosity, const Vec<D>& dx, const Vec<D>& n, double area,
                     const Vec<D>& shear) {
    const double r = dx.norm();
    if (viscosity.form == ViscousOperator::morris) return -2 * viscosity.dynamic * kernel.value(r) * area * shear;
    constexpr double K = D == 2 ? 8 : 10;
    const Vec<D> t = dx - dx.dot(n) * n;
    return -K * viscosity.dynamic * shear_shadow<D>(kernel, std::max(r, 1e-9 * kernel.radius())) * area * t.dot(shear) *
           t;
}

// How fast that slows a particle down, at most [µ/(ρ R²)]: next to a flat wall Σ_s W_is A_s = 1.5/R and γ = ½, and h is
// taken as at least half a spacing; Monaghan and Gingold's sum is 4/3 of Morris' there (5/4 in 3D). 0 where no panel is
// no-slip.
template <class Panels>
double wall_decay(const Panels& panels, double support_ratio, ViscousOperator form) {
    for (const auto& panel : panels.panels)
        if (panel.no_slip) return (form == ViscousOperator::morris ? 12 : 16) * support_ratio;
    return 0;
}

}  // namespace aquagraph::fluid
