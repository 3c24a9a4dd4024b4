// Prescribed rigid motion of walls: where their vertices are at a time, and exactly how fast.
//
// A vertex drawn at X is at
//     x(t) = C + s(t) + R(θ(t)) (X - C),     v(t) = s'(t) + θ'(t) e × (x(t) - C - s(t)),
// C being the centre, e the axis of the rotation (2D: out of the plane, counter-clockwise). s and θ are counted from
// t = 0: walls start where they are drawn.
//
// Each of s and θ is a law of time (time_law.hpp).
#pragma once
#include <vector>

#include "physics/fluid/walls/panels.hpp"
#include "physics/time_law.hpp"

namespace aquagraph::fluid {

template <int D>
struct RigidMotion {
    struct Translation {
        Vec<D> direction;  // any length: multiplies the law
        TimeLaw law;
    };
    std::vector<Translation> translations;
    std::vector<TimeLaw> rotations;  // about the same centre and axis; angles add up
    Vec<D> centre = Vec<D>::Zero();  // C, as drawn
    Vec3 axis = Vec3::UnitZ();       // e, a unit vector; 3D only

    struct State {
        Mat<D> rotation;        // R
        Vec<D> centre, shift;   // C and C + s
        Vec<D> velocity;        // s'
        Vec3 angular_velocity;  // θ' e
        Vec<D> place(const Vec<D>& drawn) const { return shift + rotation * (drawn - centre); }
        Vec<D> velocity_at(const Vec<D>& place) const;
    };
    State at(double t) const;
};

// The walls of a scene that move by themselves. The vertices belong to Panels; this knows which, and where they were
// drawn.
template <int D>
class MovingWalls {
  public:
    // All vertices of the panels of this wall, as they stand now.
    void add(const Panels<D>& panels, int wall, RigidMotion<D> motion);
    bool empty() const { return walls_.empty(); }

    // Places and velocities of the moving vertices at time t; the geometry of panels is not updated.
    void place(Panels<D>& panels, double t) const;
    // The largest distance of a moving vertex at time t from where it is in `positions` [m].
    double largest_distance(const std::vector<Vec<D>>& positions, double t) const;
    double largest_speed(double t) const;  // [m/s]

  private:
    struct Wall {
        RigidMotion<D> motion;
        std::vector<int> vertices;
        std::vector<Vec<D>> drawn;
    };
    std::vector<Wall> walls_;
};

extern template struct RigidMotion<2>;
extern template struct RigidMotion<3>;
extern template class MovingWalls<2>;
extern template class MovingWalls<3>;

}  // namespace aquagraph::fluid
