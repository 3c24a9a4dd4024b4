#include "physics/fluid/walls/motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace aquagraph::fluid {

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

double Ramp::integral(double t) const {
    if (t >= duration) return t - duration / 2;
    if (t <= 0) return 0;
    const double u = t / duration;
    return duration * u * u * u * u * (2.5 + u * (-3 + u));
}

ValueAndRate ConstantRate::at(double t) const {
    return {rate * ramp.integral(t), rate * ramp.value(t)};
}

ValueAndRate Harmonic::at(double t) const {
    const double omega = 2 * std::numbers::pi * frequency, start = ramp.value(0) * std::sin(phase);
    const double sine = std::sin(omega * t + phase), cosine = std::cos(omega * t + phase);
    return {amplitude * (ramp.value(t) * sine - start),
            amplitude * (ramp.slope(t) * sine + ramp.value(t) * omega * cosine)};
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

ValueAndRate TimeTable::at(double t) const {
    if (t < time_.front()) return {value_.front() - start_, 0};
    if (t > time_.back()) return {value_.back() - start_, 0};
    const auto after = std::upper_bound(time_.begin(), time_.end() - 1, t);
    const auto k = std::size_t(after - time_.begin()) - 1;
    const double h = time_[k + 1] - time_[k], u = (t - time_[k]) / h, v = 1 - u;
    const double chord = (value_[k + 1] - value_[k]) / h;
    // Cubic Hermite polynomial of the values and slopes at both ends.
    return {value_[k] * (1 + 2 * u) * v * v + value_[k + 1] * (1 + 2 * v) * u * u +
                h * u * v * (slope_[k] * v - slope_[k + 1] * u) - start_,
            6 * u * v * chord + slope_[k] * v * (v - 2 * u) + slope_[k + 1] * u * (u - 2 * v)};
}

ValueAndRate evaluate(const MotionLaw& law, double t) {
    return std::visit([t](const auto& known) { return known.at(t); }, law);
}

template <int D>
typename RigidMotion<D>::State RigidMotion<D>::at(double t) const {
    State state{Mat<D>::Identity(), centre, centre, Vec<D>::Zero(), Vec3::Zero()};
    for (const Translation& translation : translations) {
        const auto [value, rate] = evaluate(translation.law, t);
        state.shift += value * translation.direction;
        state.velocity += rate * translation.direction;
    }
    ValueAndRate angle;
    for (const MotionLaw& rotation : rotations) {
        const auto [value, rate] = evaluate(rotation, t);
        angle.value += value;
        angle.rate += rate;
    }
    if (angle.value != 0) {
        if constexpr (D == 2)
            state.rotation = Eigen::Rotation2Dd(angle.value).toRotationMatrix();
        else
            state.rotation = Eigen::AngleAxisd(angle.value, axis).toRotationMatrix();
    }
    state.angular_velocity = angle.rate * (D == 2 ? Vec3(Vec3::UnitZ()) : axis);
    return state;
}

template <int D>
Vec<D> RigidMotion<D>::State::velocity_at(const Vec<D>& place) const {
    const Vec<D> arm = place - shift;
    if constexpr (D == 2)
        return velocity + angular_velocity.z() * Vec2(-arm.y(), arm.x());
    else
        return velocity + angular_velocity.cross(arm);
}

template <int D>
void MovingWalls<D>::add(const Panels<D>& panels, int wall, RigidMotion<D> motion) {
    Wall& made = walls_.emplace_back();
    made.motion = std::move(motion);
    for (const Panel<D>& panel : panels.panels)
        if (panel.wall == wall) made.vertices.insert(made.vertices.end(), panel.vertex.begin(), panel.vertex.end());
    std::sort(made.vertices.begin(), made.vertices.end());
    made.vertices.erase(std::unique(made.vertices.begin(), made.vertices.end()), made.vertices.end());
    for (const int v : made.vertices) made.drawn.push_back(panels.position[std::size_t(v)]);
}

template <int D>
void MovingWalls<D>::place(Panels<D>& panels, double t) const {
    for (const Wall& wall : walls_) {
        const auto state = wall.motion.at(t);
        for (std::size_t k = 0; k < wall.vertices.size(); ++k) {
            const auto v = std::size_t(wall.vertices[k]);
            panels.position[v] = state.place(wall.drawn[k]);
            panels.velocity[v] = state.velocity_at(panels.position[v]);
        }
    }
}

template <int D>
double MovingWalls<D>::largest_distance(const std::vector<Vec<D>>& positions, double t) const {
    double largest = 0;
    for (const Wall& wall : walls_) {
        const auto state = wall.motion.at(t);
        for (std::size_t k = 0; k < wall.vertices.size(); ++k)
            largest = std::max(largest,
                               (state.place(wall.drawn[k]) - positions[std::size_t(wall.vertices[k])]).squaredNorm());
    }
    return std::sqrt(largest);
}

template <int D>
double MovingWalls<D>::largest_speed(double t) const {
    double largest = 0;
    for (const Wall& wall : walls_) {
        const auto state = wall.motion.at(t);
        for (const Vec<D>& drawn : wall.drawn)
            largest = std::max(largest, state.velocity_at(state.place(drawn)).squaredNorm());
    }
    return std::sqrt(largest);
}

template struct RigidMotion<2>;
template struct RigidMotion<3>;
template class MovingWalls<2>;
template class MovingWalls<3>;

}  // namespace aquagraph::fluid
