#include "physics/fluid/walls/motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace aquagraph::fluid {

template <int D>
typename RigidMotion<D>::State RigidMotion<D>::at(double t) const {
    State state{Mat<D>::Identity(), centre, centre, Vec<D>::Zero(), Vec3::Zero()};
    for (const Translation& translation : translations) {
        const ValueAndRates now = evaluate(translation.law, t);
        state.shift += now.value * translation.direction;
        state.velocity += now.rate * translation.direction;
    }
    ValueAndRates angle;
    for (const TimeLaw& rotation : rotations) {
        const ValueAndRates now = evaluate(rotation, t);
        angle.value += now.value;
        angle.rate += now.rate;
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
