// Rigid ground: how far a point is from it, and in which direction is away.
//   plane                g = n·(x - c)
//   cylinder, sphere     g = ±(|r| - R), r from the axis or centre to the point; - if the body is inside
// and the curvature ∂n/∂x = ±(P - r̂⊗r̂)/|r|, with P = I, or I - a⊗a for an axis a.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "physics/solid/options.hpp"

namespace aquagraph::solid {

template <int D>
class GroundSurface {
  public:
    using Vector = std::array<double, D>;

    struct Place {
        double gap = 0;  // [m], negative inside the ground
        Vector normal{};
        double curvature = 0;  // ±1/|r| [1/m]
    };

    // Throws std::invalid_argument for a direction of no length or a radius that is not positive.
    explicit GroundSurface(const Ground<D>& ground) : ground_(ground) {
        const bool directed = ground.shape == GroundShape::plane || (D == 3 && ground.shape == GroundShape::cylinder);
        double length = 0;
        for (const double x : ground.direction) length += x * x;
        length = std::sqrt(length);
        if (directed && !(length > 0))
            throw std::invalid_argument(
                "solid: the ground needs a direction: the normal of a plane, the axis of a cylinder");
        for (double& x : ground_.direction) x = directed ? x / length : 0;
        if (ground.shape != GroundShape::plane && !(ground.radius > 0))
            throw std::invalid_argument("solid: the radius of the ground must be positive");
    }

    Vector displacement(double t) const {
        Vector shift;
        for (std::size_t i = 0; i < D; ++i) shift[i] = ground_.displacement[i].at(t).value;
        return shift;
    }

    // Of a point of space, the ground being displaced by `shift`.
    Place at(const Vector& x, const Vector& shift) const {
        Place place;
        Vector r;
        double along = 0, square = 0;
        for (std::size_t i = 0; i < D; ++i) r[i] = x[i] - ground_.point[i] - shift[i];
        for (std::size_t i = 0; i < D; ++i) along += r[i] * ground_.direction[i];
        if (ground_.shape == GroundShape::plane) return {along, ground_.direction, 0};
        for (std::size_t i = 0; i < D; ++i) {
            r[i] -= along * ground_.direction[i];
            square += r[i] * r[i];
        }
        const double distance = std::sqrt(square), sign = ground_.hollow ? -1 : 1;
        if (!(distance > 0)) return place;  // on the axis: as far inside as can be, and no way out better than another
        place.gap = sign * (distance - ground_.radius);
        place.curvature = sign / distance;
        for (std::size_t i = 0; i < D; ++i) place.normal[i] = sign * r[i] / distance;
        return place;
    }

    // ∂n_i/∂x_j
    double normal_slope(const Place& place, std::size_t i, std::size_t j) const {
        return place.curvature *
               ((i == j ? 1 : 0) - ground_.direction[i] * ground_.direction[j] - place.normal[i] * place.normal[j]);
    }

  private:
    Ground<D> ground_;
};

}  // namespace aquagraph::solid
