#include "physics/fluid/walls/corners.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "physics/fluid/walls/panel_grid.hpp"

namespace aquagraph::fluid {

namespace {
const double least_concave_turn = 5 * std::numbers::pi / 180;  // below it the wedge to fill is thinner than a particle

double turn(const Panels<2>& panels, std::size_t k, std::size_t l) {
    return std::atan2(cross(panels.tangent[k], panels.tangent[l]), panels.tangent[k].dot(panels.tangent[l]));
}

template <int D>
Vec<D> velocity_at(const Panels<D>& walls, std::size_t panel, const Vec<D>& x) {
    const auto shape = walls.shape_functions_on(panel, x);
    Vec<D> velocity = Vec<D>::Zero();
    for (std::size_t v = 0; v < D; ++v)
        velocity += shape[v] * walls.velocity[std::size_t(walls.panels[panel].vertex[v])];
    return velocity;
}

// A corner between a body and the floor that it stands on.
struct Contact {
    Corner<2> corner;
    bool at_end;      // of the body's panel, which rises from there
    double distance;  // of the vertex from the floor [m]
};

// Where panels are shorter than what counts as closed, several vertices of one side are that near: the side meets the
// floor once, at the nearest of them, or the water in the corner would be mirrored through it over and over.
void keep_nearest(const Panels<2>& panels, std::vector<Contact>& contacts) {
    const auto same_floor = [&](const Contact& a, const Contact& b) {
        const auto m = std::size_t(a.corner.floor[0]), n = std::size_t(b.corner.floor[0]);
        return panels.panels[m].wall == panels.panels[n].wall &&
               panels.normal[m].dot(panels.normal[n]) > std::numbers::sqrt3 / 2;
    };
    const auto next_to = [&](const Contact& a, const Contact& b) {
        const auto &k = panels.panels[std::size_t(a.corner.panel[0])].vertex,
                   &l = panels.panels[std::size_t(b.corner.panel[0])].vertex;
        return a.at_end == b.at_end && (k[1] == l[0] || l[1] == k[0]) && same_floor(a, b);
    };
    std::vector<Contact> kept;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        bool nearest = true;
        for (std::size_t other = 0; other < contacts.size() && nearest; ++other) {
            const double mine = std::fabs(contacts[c].distance), its = std::fabs(contacts[other].distance);
            if (its < mine || (its == mine && other < c)) nearest = !next_to(contacts[c], contacts[other]);
        }
        if (nearest) kept.push_back(contacts[c]);
    }
    contacts = std::move(kept);
}
}  // namespace

template <int D>
void Corner<D>::update(const Panels<D>& walls) {
    const auto place = [&](int v) {
        Vec<D> x = walls.position[std::size_t(v)];
        for (const int f : floor)
            if (f >= 0) x -= walls.height(std::size_t(f), x) * walls.normal[std::size_t(f)];
        return x;
    };
    // A corner that slides along a floor leaves it as little as its place does: water in the corner is neither pushed
    // up nor sucked down by how the body above the floor stretches.
    const auto slide = [&](int v) {
        Vec<D> u = walls.velocity[std::size_t(v)];
        for (const int f : floor)
            if (f >= 0) {
                const auto k = std::size_t(f);
                u -= (u - velocity_at(walls, k, walls.position[std::size_t(v)])).dot(walls.normal[k]) * walls.normal[k];
            }
        return u;
    };
    point = place(vertex[0]);
    velocity = slide(vertex[0]);
    if constexpr (D == 3) {
        edge = place(vertex[1]) - point;
        edge_velocity = slide(vertex[1]) - velocity;
    }
}

template <>
std::vector<Corner<2>> find_corners(const Panels<2>& panels, const PanelGrid<2>& grid, const std::vector<int>&,
                                    double touching) {
    std::vector<Corner<2>> corners;
    const auto add = [&](Corner<2> corner) {
        corner.update(panels);
        corners.push_back(corner);
    };
    for (const Joint<2>& joint : panels.joints) {
        const auto k = std::size_t(joint.panel[0]), l = std::size_t(joint.panel[1]);
        const double angle = turn(panels, k, l);
        if (angle < least_concave_turn) continue;
        Corner<2> corner{};
        corner.panel = {joint.panel[0], joint.panel[1]};
        corner.vertex = {panels.panels[k].vertex[1]};
        corner.sharp = angle > std::numbers::pi / 4;
        corner.away[0] = -panels.tangent[k];
        corner.away[1] = panels.tangent[l];
        add(corner);
    }
    // A vertex of k near the inside of a panel m of another wall; a body does not touch itself.
    std::vector<Contact> contacts;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        for (const bool at_end : {false, true}) {
            const int vertex = panels.panels[k].vertex[at_end ? 1 : 0];
            const Vec2& x = panels.position[std::size_t(vertex)];
            const Vec2 away = at_end ? Vec2(-panels.tangent[k]) : panels.tangent[k];
            const auto* cell = grid.at(x);
            if (!cell) continue;
            for (std::size_t entry = 0; entry < cell->panel.size(); ++entry) {
                const auto m = std::size_t(cell->panel[entry]);
                if (cell->copy[entry] != 0 || panels.panels[m].wall == panels.panels[k].wall) continue;
                const Vec2 from = x - panels.start(m);
                const double distance = from.dot(panels.normal[m]), s = from.dot(panels.tangent[m]);
                if (std::fabs(distance) > touching || s <= 1e-6 * panels.measure[m] ||
                    s >= (1 - 1e-6) * panels.measure[m])
                    continue;
                const double rise = away.dot(panels.normal[m]), opening = panels.tangent[m].dot(panels.normal[k]);
                if (rise < 0.34 || std::fabs(opening) < 0.34) continue;  // less than 20° between them: a closing gap
                Corner<2> corner{};
                corner.panel = {int(k), int(m)};
                corner.vertex = {vertex};
                corner.floor[0] = int(m);
                corner.away[0] = away;
                corner.away[1] = opening > 0 ? panels.tangent[m] : Vec2(-panels.tangent[m]);
                corner.sharp = corner.away[0].dot(corner.away[1]) > -std::numbers::sqrt2 / 2;
                contacts.push_back({corner, at_end, distance});
            }
        }
    }
    keep_nearest(panels, contacts);
    for (const Contact& contact : contacts) add(contact.corner);
    return corners;
}

template struct Corner<2>;
template struct Corner<3>;

}  // namespace aquagraph::fluid
