// Laws of time for whatever is prescribed: motions of walls and of nodes, loads. Value, rate and acceleration are
// exact.
//
// Each law counts from t = 0, where it is 0:
//     constant   u = c ∫ r dt
//     harmonic   u = r(t) A sin(2π f t + φ) - u0
//     table      u(t_k) - u(0) given, in between a cubic that meets its neighbours with the same slope: rates are
//                continuous, accelerations jump at the rows. Slopes are Fritsch and Carlson's (SIAM J. Numer. Anal. 17,
//                1980; in the form of Brodlie's weighted harmonic mean): where the values do not turn, the curve does
//                not either.
// with the ramp r(t) = 10 τ³ - 15 τ⁴ + 6 τ⁵, τ = t/T <= 1, so that neither rate nor acceleration jumps at t = 0 and T;
// r = 1 without one.
#pragma once
#include <variant>
#include <vector>

namespace aquagraph {

struct Ramp {
    double duration = 0;               // T [s]; 0: none
    double value(double t) const;      // r
    double slope(double t) const;      // r' [1/s]
    double curvature(double t) const;  // r'' [1/s²]
    double integral(double t) const;   // ∫ r dt from 0 [s]
};

// Value of a law and its first two derivatives.
struct ValueAndRates {
    double value = 0, rate = 0, acceleration = 0;
};

struct ConstantRate {
    double rate;  // c [m/s], [rad/s]
    Ramp ramp;
    ValueAndRates at(double t) const;
};

struct Harmonic {
    double amplitude;  // A [m], [rad]
    double frequency;  // f [Hz]
    double phase = 0;  // φ [rad]
    Ramp ramp;
    ValueAndRates at(double t) const;
};

class TimeTable {
  public:
    // Throws std::invalid_argument where there are fewer than two rows, where time does not increase (naming the row,
    // counted from 1), or where t = 0 lies outside the table.
    TimeTable(std::vector<double> time, std::vector<double> value);
    // Before the first and after the last row the value is held.
    ValueAndRates at(double t) const;
    double end() const { return time_.back(); }
    double start() const { return start_; }  // u(0), which at() subtracts

  private:
    std::vector<double> time_, value_, slope_;
    double start_ = 0;
};

using TimeLaw = std::variant<ConstantRate, Harmonic, TimeTable>;
ValueAndRates evaluate(const TimeLaw& law, double t);

// A value at t = 0 and laws that change it.
struct TimeFunction {
    double initial = 0;
    std::vector<TimeLaw> changes;

    ValueAndRates at(double t) const;
    static TimeFunction constant(double value) { return {value, {}}; }
    static TimeFunction table(std::vector<double> time, std::vector<double> value);  // throws as TimeTable does
};

}  // namespace aquagraph
