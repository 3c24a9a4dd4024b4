// What the fluid is at a place that no particle follows: interpolated values, and the height of the surface over a
// point. For diagnostics, a few places at a time: every call looks at all particles.
//
// Shepard's interpolation <φ>(x) = Σ_j φ_j W(x - x_j) ω_j / Σ_j W(x - x_j) ω_j over fluid particles, without ghosts, is
// exact for constants. A linear field comes out as its value at the particles' weighted centre: inside, for R ≥ 2.6 Δx,
// within 0.01 Δx of x on a lattice and 0.15 Δx where particles stand up to 0.2 Δx beside it; on a wall or at the
// surface 0.21 R inside (the centre of half a Wendland kernel; 0.24 R on a lattice of R = 2.6 Δx). The linear form
// (moving least squares, Lancaster and Salkauskas, Math. Comp. 37, 1981, with weights W ω) is exact for linear fields
// everywhere; where the particles do not span the space (a sheet, a jet tip) it falls back to Shepard's.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "physics/fluid/fluid.hpp"

namespace aquagraph::fluid {

enum class Interpolation { shepard, linear };

// The weights of the particles around one place. Made once, used for several fields.
template <int D>
class PlaceInFluid {
  public:
    using Vector = Eigen::Matrix<double, D, 1>;

    // side: if given, only particles in front of the plane through x with this normal count, those up to half a spacing
    // behind it included: the wetted side of a thin wall.
    void look(const Fluid<D>& fluid, const Vector& x, const std::optional<Vector>& side, Interpolation interpolation);

    // False where no particle is within the support: in the air.
    bool wet() const { return !lane_.empty(); }
    // Interpolated value of a field of particles; 0 in the air.
    double of(const Scalars& field) const;

  private:
    std::vector<std::uint32_t> lane_;
    std::vector<double> weight_;  // sum to 1
};

// Height of the free surface (the last coordinate) over `foot`, on the line upwards from it: the highest place where
// s = Σ_j W ω_j has fallen to half of its largest value on the line, which is taken as ½ at least and 1 at most: less
// is spray, and on a wall the support of water without a surface is half full. Found by going down from above the
// highest particle in steps of Δx/2, then by bisection. On a lattice that fills a half space it lies within 0.02 Δx of
// its face. Without water over it: the height of `foot`.
template <int D>
class SurfaceOver {
  public:
    double height(const Fluid<D>& fluid, const std::array<double, D>& foot);

  private:
    struct Near {
        double height, across2, volume;
    };
    double fullness(const Fluid<D>& fluid, double height) const;
    std::vector<Near> near_;  // sorted by height
};

extern template class PlaceInFluid<2>;
extern template class PlaceInFluid<3>;
extern template class SurfaceOver<2>;
extern template class SurfaceOver<3>;

}  // namespace aquagraph::fluid
