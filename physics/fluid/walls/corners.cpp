#include "physics/fluid/walls/corners.hpp"

#include <cmath>
#include <numbers>

namespace aquagraph::fluid {

namespace {
const double least_concave_turn = 5 * std::numbers::pi / 180;  // below it the wedge to fill is thinner than a particle

double turn(const Panels<2>& panels, std::size_t k, std::size_t l) {
    return std::atan2(cross(panels.tangent[k], panels.tangent[l]), panels.tangent[k].dot(panels.tangent[l]));
}
}  // namespace

void Corner::update(const Panels<2>& panels) {
    point = panels.position[std::size_t(vertex)];
    velocity = panels.velocity[std::size_t(vertex)];
    if (floor >= 0) {
        const auto f = std::size_t(floor);
        point -= (point - panels.start(f)).dot(panels.normal[f]) * panels.normal[f];
    }
}

std::vector<Corner> find_corners(const Panels<2>& panels, double touching) {
    std::vector<Corner> corners;
    const auto add = [&](Corner corner) {
        corner.update(panels);
        corners.push_back(corner);
    };
    for (const Joint<2>& joint : panels.joints) {
        const auto k = std::size_t(joint.panel[0]), l = std::size_t(joint.panel[1]);
        const double angle = turn(panels, k, l);
        if (angle < least_concave_turn) continue;
        Corner corner{};
        corner.panel[0] = joint.panel[0];
        corner.panel[1] = joint.panel[1];
        corner.vertex = panels.panels[k].vertex[1];
        corner.floor = -1;
        corner.sharp = angle > std::numbers::pi / 4;
        corner.away[0] = -panels.tangent[k];
        corner.away[1] = panels.tangent[l];
        add(corner);
    }
    // A vertex of k near the inside of a panel m of another wall; a body does not touch itself.
    for (std::size_t k = 0; k < panels.size(); ++k) {
        for (const bool at_end : {false, true}) {
            const int vertex = at_end ? panels.panels[k].vertex[1] : panels.panels[k].vertex[0];
            const Vec2& x = panels.position[std::size_t(vertex)];
            const Vec2 away = at_end ? Vec2(-panels.tangent[k]) : panels.tangent[k];
            for (std::size_t m = 0; m < panels.size(); ++m) {
                if (panels.panels[m].wall == panels.panels[k].wall) continue;
                const Vec2 from = x - panels.start(m);
                const double distance = from.dot(panels.normal[m]), s = from.dot(panels.tangent[m]);
                if (std::fabs(distance) > touching || s <= 1e-6 * panels.measure[m] ||
                    s >= (1 - 1e-6) * panels.measure[m])
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
