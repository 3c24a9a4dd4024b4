#include "physics/time_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace aquagraph {

double Ramp::value(double t) const {
    if (t >= duration) return 1;
    if (t <= 0) return 0;
    const double u = t / duration;
    return u * u * u * (10 + u * (-15 + 6 * u));
}

double Ramp::slope(double t) const {
    if (t >= duration || t <= 0) return 0;
    const double u = t / duration;
    return 30 * u * u * (1 - u) * (1 - u) / duration;
}

double Ramp::curvature(double t) const {
    if (t >= duration || t <= 0) return 0;
    const double u = t / duration;
    return 60 * u * (1 - u) * (1 - 2 * u) / (duration * duration);
}

double Ramp::integral(double t) const {
    if (t >= duration) return t - duration / 2;
    if (t <= 0) return 0;
    const double u = t / duration;
    return duration * u * u * u * u * (2.5 + u * (-3 + u));
}

ValueAndRates ConstantRate::at(double t) const {
    return {rate * ramp.integral(t), rate * ramp.value(t), rate * ramp.slope(t)};
}

ValueAndRates Harmonic::at(double t) const {
    const double omega = 2 * std::numbers::pi * frequency, start = ramp.value(0) * std::sin(phase);
    const double sine = std::sin(omega * t + phase), cosine = std::cos(omega * t + phase);
    return {amplitude * (ramp.value(t) * sine - start),
            amplitude * (ramp.slope(t) * sine + ramp.value(t) * omega * cosine),
            amplitude *
                (ramp.curvature(t) * sine + 2 * ramp.slope(t) * omega * cosine - ramp.value(t) * omega * omega * sine)};
}

TimeTable::TimeTable(std::vector<double> time, std::vector<double> value)
    : time_(std::move(time)), value_(std::move(value)) {
    const std::size_t n = time_.size();
    if (n < 2 || value_.size() != n) throw std::invalid_argument("a table needs at least two rows");
    for (std::size_t k = 1; k < n; ++k)
        if (!(time_[k] > time_[k - 1]))
            throw std::invalid_argument("time does not increase in row " + std::to_string(k + 1) + ": " +
                                        std::to_string(time_[k]) + " s after " + std::to_string(time_[k - 1]) + " s");
    if (time_.front() > 0 || time_.back() < 0)
        throw std::invalid_argument("the table begins at " + std::to_string(time_.front()) + " s and ends at " +
                                    std::to_string(time_.back()) + " s: it must hold t = 0");
    // Slope of the table between rows k and k + 1.
    const auto chord = [&](std::size_t k) { return (value_[k + 1] - value_[k]) / (time_[k + 1] - time_[k]); };
    slope_.resize(n);
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const double before = chord(k - 1), after = chord(k);
        if (before * after <= 0) continue;  // it turns here: flat
        const double h0 = time_[k] - time_[k - 1], h1 = time_[k + 1] - time_[k], w = (h0 + 2 * h1) / (3 * (h0 + h1));
        slope_[k] = before * after / (w * after + (1 - w) * before);
    }
    // At the ends the slope of the chord: a table of two rows is a straight line.
    slope_[0] = chord(0);
    slope_[n - 1] = chord(n - 2);
    start_ = at(0).value;
}

ValueAndRates TimeTable::at(double t) const {
    if (t < time_.front()) return {value_.front() - start_};
    if (t > time_.back()) return {value_.back() - start_};
    const auto after = std::upper_bound(time_.begin(), time_.end() - 1, t);
    const auto k = std::size_t(after - time_.begin()) - 1;
    const double h = time_[k + 1] - time_[k], u = (t - time_[k]) / h, v = 1 - u;
    const double chord = (value_[k + 1] - value_[k]) / h;
    // Cubic Hermite polynomial of the values and slopes at both ends.
    return {value_[k] * (1 + 2 * u) * v * v + value_[k + 1] * (1 + 2 * v) * u * u +
                h * u * v * (slope_[k] * v - slope_[k + 1] * u) - start_,
            6 * u * v * chord + slope_[k] * v * (v - 2 * u) + slope_[k + 1] * u * (u - 2 * v),
            (6 * (v - u) * chord + slope_[k] * (6 * u - 4) + slope_[k + 1] * (6 * u - 2)) / h};
}

ValueAndRates evaluate(const TimeLaw& law, double t) {
    return std::visit([t](const auto& known) { return known.at(t); }, law);
}

ValueAndRates TimeFunction::at(double t) const {
    ValueAndRates sum{initial};
    for (const TimeLaw& change : changes) {
        const ValueAndRates part = evaluate(change, t);
        sum.value += part.value;
        sum.rate += part.rate;
        sum.acceleration += part.acceleration;
    }
    return sum;
}

TimeFunction TimeFunction::table(std::vector<double> time, std::vector<double> value) {
    TimeTable made(std::move(time), std::move(value));
    return {made.start(), {std::move(made)}};
}

}  // namespace aquagraph
