// What a material says about a plane deformation. In the plane the tensors are two by two; the third direction is part
// of the law (plane strain: F_33 = 1; plane stress: P_33 = 0), so that the three-dimensional F is known in both cases.
//
// A law is a small value type with
//   double energy(H)                W per reference volume [J/m³]
//   PlaneTensor first_piola(H)      P_iJ = ∂W/∂F_iJ [Pa]; called on lanes of elements: branch-free, inlined
//   PlaneTangent tangent(H)         A = ∂P/∂F [Pa], symmetric
//   Thickness thickness(H)          what happens across the plane, for the output of stresses
// in terms of the displacement gradient H = ∂u/∂X = F - I. H and not F: strains of 1e-7 in a stiff plate would lose
// half of their digits in FᵀF - I.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace aquagraph::solid {

struct PlaneTensor {
    double xx = 0, xy = 0, yx = 0, yy = 0;  // first index: direction in space; second: reference direction
};

// Rows and columns in the order xx, xy, yx, yy of PlaneTensor.
using PlaneTangent = std::array<std::array<double, 4>, 4>;

struct Thickness {
    double stretch = 1;      // F_33
    double first_piola = 0;  // P_33 [Pa]
};

inline double determinant(const PlaneTensor& H) {
    return (1 + H.xx) * (1 + H.yy) - H.xy * H.yx;
}  // of I + H

inline std::array<double, 4> components(const PlaneTensor& T) {
    return {T.xx, T.xy, T.yx, T.yy};
}

// Von Mises equivalent [Pa] of the Cauchy stress σ = P Fᵀ / J.
template <class Material>
double von_mises(const Material& material, const PlaneTensor& H) {
    const PlaneTensor P = material.first_piola(H);
    const Thickness across = material.thickness(H);
    const double j = determinant(H);
    const double J = j * across.stretch;
    const double xx = (P.xx * (1 + H.xx) + P.xy * H.xy) / J;
    const double xy = (P.xx * H.yx + P.xy * (1 + H.yy)) / J;
    const double yy = (P.yx * H.yx + P.yy * (1 + H.yy)) / J;
    const double zz = across.first_piola / j;
    return std::sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) + 3 * xy * xy);
}

}  // namespace aquagraph::solid
