#include "physics/fluid/walls/panels.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

namespace aquagraph::fluid {

namespace {
const double smooth_turn = std::numbers::pi / 6;
const double least_concave_turn = 5 * std::numbers::pi / 180;  // below it the wedge to fill is thinner than a particle

double turn(const Panels& panels, std::size_t k, std::size_t l) {
    return std::atan2(cross(panels.tangent[k], panels.tangent[l]), panels.tangent[k].dot(panels.tangent[l]));
}
}  // namespace

void Panels::update_geometry() {
    tangent.resize(panels.size());
    normal.resize(panels.size());
    length.resize(panels.size());
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const Vec2 along = end(k) - start(k);
        length[k] = along.norm();
        tangent[k] = along / length[k];
        normal[k] = Vec2(-tangent[k].y(), tangent[k].x());
    }
}

void Panels::find_joints() {
    joints.clear();
    const auto meet = [&](int a, int b, double scale) {
        return a == b || (position[std::size_t(a)] - position[std::size_t(b)]).norm() < 1e-6 * scale;
    };
    for (std::size_t k = 0; k < panels.size(); ++k)
        for (std::size_t l = 0; l < panels.size(); ++l)
            if (k != l && meet(panels[k].second, panels[l].first, std::min(length[k], length[l])))
                joints.push_back({int(k), int(l)});
}

int Panels::add_wall(const std::string& name, const std::vector<Vec2>& points, bool closed, bool no_slip) {
    const int wall = int(names.size()), base = int(position.size()), n = int(points.size());
    names.push_back(name);
    for (const Vec2& point : points) {
        position.push_back(point);
        velocity.push_back(Vec2::Zero());
    }
    for (int i = 0; i + 1 < n; ++i) panels.push_back({base + i, base + i + 1, wall, no_slip, false});
    if (closed) panels.push_back({base + n - 1, base, wall, no_slip, false});
    return wall;
}

std::vector<int> smooth_patches(const Panels& panels) {
    std::vector<int> patch(panels.panels.size());
    std::iota(patch.begin(), patch.end(), 0);
    const auto root = [&](int k) {
        while (patch[std::size_t(k)] != k) k = patch[std::size_t(k)];
        return k;
    };
    for (const Joint& joint : panels.joints) {
        if (std::fabs(turn(panels, std::size_t(joint.before), std::size_t(joint.after))) >= smooth_turn) continue;
        const int a = root(joint.before), b = root(joint.after);
        patch[std::size_t(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t k = 0; k < patch.size(); ++k) patch[k] = root(int(k));
    return patch;
}

void Corner::update(const Panels& panels) {
    point = panels.position[std::size_t(vertex)];
    velocity = panels.velocity[std::size_t(vertex)];
    if (floor >= 0) {
        const auto f = std::size_t(floor);
        point -= (point - panels.start(f)).dot(panels.normal[f]) * panels.normal[f];
    }
}

std::vector<Corner> find_corners(const Panels& panels, double touching) {
    std::vector<Corner> corners;
    const auto add = [&](Corner corner) {
        corner.update(panels);
        corners.push_back(corner);
    };
    for (const Joint& joint : panels.joints) {
        const auto k = std::size_t(joint.before), l = std::size_t(joint.after);
        const double angle = turn(panels, k, l);
        if (angle < least_concave_turn) continue;
        Corner corner{};
        corner.panel[0] = joint.before;
        corner.panel[1] = joint.after;
        corner.vertex = panels.panels[k].second;
        corner.floor = -1;
        corner.sharp = angle > std::numbers::pi / 4;
        corner.away[0] = -panels.tangent[k];
        corner.away[1] = panels.tangent[l];
        add(corner);
    }
    // A vertex of k near the inside of a panel m of another wall; a body does not touch itself.
    for (std::size_t k = 0; k < panels.panels.size(); ++k) {
        for (const bool at_end : {false, true}) {
            const int vertex = at_end ? panels.panels[k].second : panels.panels[k].first;
            const Vec2& x = panels.position[std::size_t(vertex)];
            const Vec2 away = at_end ? Vec2(-panels.tangent[k]) : panels.tangent[k];
            for (std::size_t m = 0; m < panels.panels.size(); ++m) {
                if (panels.panels[m].wall == panels.panels[k].wall) continue;
                const Vec2 from = x - panels.start(m);
                const double distance = from.dot(panels.normal[m]), s = from.dot(panels.tangent[m]);
                if (std::fabs(distance) > touching || s <= 1e-6 * panels.length[m] ||
                    s >= (1 - 1e-6) * panels.length[m])
                    continue;
                const double rise = away.dot(panels.normal[m]), opening = panels.tangent[m].dot(panels.normal[k]);
                if (rise < 0.34 || std::fabs(opening) < 0.34) continue;  // less than 20° between them: a closing gap
                Corner corner{};
                corner.panel[0] = int(k);
                corner.panel[1] = int(m);
                corner.vertex = vertex;
                corner.floor = int(m);
                corner.away[0] = away;
                corner.away[1] = opening > 0 ? panels.tangent[m] : Vec2(-panels.tangent[m]);
                corner.sharp = corner.away[0].dot(corner.away[1]) > -std::numbers::sqrt2 / 2;
                add(corner);
            }
        }
    }
    return corners;
}

}  // namespace aquagraph::fluid
