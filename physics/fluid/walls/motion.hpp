// Prescribed rigid motion of walls: where their vertices are at a time, and exactly how fast.
//
// A vertex drawn at X is at
//     x(t) = C + s(t) + R(θ(t)) (X - C),     v(t) = s'(t) + θ'(t) e × (x(t) - C - s(t)),
// C being the centre, e the axis of the rotation (2D: out of the plane, counter-clockwise). s and θ are counted from
// t = 0: walls start where they are drawn.
//
// Each of s and θ is one law of time:
//     constant   u = c ∫ r dt
//     harmonic   u = r(t) A sin(2π f t + φ) - u0
//     table      u(t_k) given, in between a cubic that meets its neighbours with the same slope: velocities are
//                continuous. Slopes are Fritsch and Carlson's (SIAM J. Numer. Anal. 17, 1980; in the form of Brodlie's
//                weighted harmonic mean): where the values do not turn, the curve does not either.
// with the ramp r(t) = 10 τ³ - 15 τ⁴ + 6 τ⁵, τ = t/T <= 1, so that neither velocity nor acceleration jumps at t = 0 and
// T; r = 1 without one.
#pragma once
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

struct Ramp {
    double duration = 0;              // T [s]; 0: none
    double value(double t) const;     // r
    double slope(double t) const;     // r' [1/s]
    double integral(double t) const;  // ∫ r dt from 0 [s]
};

// Value of a law and its derivative.
struct ValueAndRate {
    double value = 0, rate = 0;
};

struct ConstantRate {
    double rate;  // c [m/s], [rad/s]
    Ramp ramp;
    ValueAndRate at(double t) const;
};

struct Harmonic {
    double amplitude;  // A [m], [rad]
    double frequency;  // f [Hz]
    double phase = 0;  // φ [rad]
    Ramp ramp;
    ValueAndRate at(double t) const;
};

class TimeTable {
  public:
    // Throws std::invalid_argument where there are fewer than two rows, where time does not increase (naming the row,
    // counted from 1), or where t = 0 lies outside the table.
    TimeTable(std::vector<double> time, std::vector<double> value);
    // Before the first and after the last row the value is held.
    ValueAndRate at(double t) const;
    double end() const { return time_.back(); }

  private:
    std::vector<double> time_, value_, slope_;
    double start_ = 0;
};

using MotionLaw = std::variant<ConstantRate, Harmonic, TimeTable>;
ValueAndRate evaluate(const MotionLaw& law, double t);

template <int D>
struct RigidMotion {
    struct Translation {
        Vec<D> direction;  // any length: multiplies the law
        MotionLaw law;
    };
    std::vector<Translation> translations;
    std::vector<MotionLaw> rotations;  // about the same centre and axis; angles add up
    Vec<D> centre = Vec<D>::Zero();    // C, as drawn
    Vec3 axis = Vec3::UnitZ();         // e, a unit vector; 3D only

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
