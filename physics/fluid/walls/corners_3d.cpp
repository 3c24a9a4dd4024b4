// Concave edges between triangles, and the corners in which they meet.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "physics/fluid/walls/corners.hpp"
#include "physics/fluid/walls/panel_grid.hpp"

namespace aquagraph::fluid {

namespace {

const double least_concave_turn = 5 * std::numbers::pi / 180;
constexpr double least_opening = 0.34;  // sine of 20°: less is a closing gap
const double slack = std::sin(least_concave_turn);

using Grid = PanelGrid<3>;

// The unit vector in panel k's plane at a right angle to its side from a to b, into the panel.
Vec3 into_panel(const Panels<3>& panels, std::size_t k, const Vec3& a, const Vec3& b) {
    return panels.normal[k].cross(Vec3(b - a).normalized());
}

// Edges run towards growing x (y, z), so that pieces of one straight edge agree on who owns the point between them.
bool runs_backwards(const Vec3& edge) {
    const Vec3 e = edge.normalized();
    for (const int d : {0, 1, 2})
        if (std::fabs(e[d]) > 1e-6) return e[d] < 0;
    return false;
}

void finish(Corner<3>& corner, const Panels<3>& panels) {
    corner.update(panels);
    if (!runs_backwards(corner.edge)) return;
    std::swap(corner.vertex[0], corner.vertex[1]);
    corner.update(panels);
}

void add_joints(const Panels<3>& panels, std::vector<Corner<3>>& corners) {
    for (const Joint<3>& joint : panels.joints) {
        const auto k = std::size_t(joint.panel[0]), l = std::size_t(joint.panel[1]);
        const Vec3 &a = panels.position[std::size_t(joint.vertex[0])],
                   &b = panels.position[std::size_t(joint.vertex[1])];
        Corner<3> corner{};
        corner.away[0] = into_panel(panels, k, a, b);
        corner.away[1] = into_panel(panels, l, b, a);
        const double angle = std::atan2(corner.away[1].dot(panels.normal[k]), panels.normal[k].dot(panels.normal[l]));
        if (angle < least_concave_turn) continue;
        corner.panel = {joint.panel[0], joint.panel[1]};
        corner.vertex = joint.vertex;
        corner.sharp = angle > std::numbers::pi / 4;
        finish(corner, panels);
        corners.push_back(corner);
    }
}

// Sides of panels that lie on the inside of another wall's panel; a body does not touch itself.
void add_contacts(const Panels<3>& panels, const Grid& grid, const std::vector<int>& facet, double touching,
                  std::vector<Corner<3>>& corners) {
    // Sides beyond which the same smooth surface goes on do not count: it is not there that the body ends.
    std::vector<std::array<bool, 3>> goes_on(panels.size(), {false, false, false});
    for (const Joint<3>& joint : panels.joints) {
        const auto k = std::size_t(joint.panel[0]), l = std::size_t(joint.panel[1]);
        if (panels.normal[k].dot(panels.normal[l]) < 0.86) continue;
        for (const std::size_t panel : {k, l})
            for (std::size_t v = 0; v < 3; ++v) {
                const Vec3 middle = 0.5 * (panels.vertex(panel, v) + panels.vertex(panel, (v + 1) % 3)),
                           of_joint = 0.5 * (panels.position[std::size_t(joint.vertex[0])] +
                                             panels.position[std::size_t(joint.vertex[1])]);
                if ((middle - of_joint).norm() < 1e-5 * std::sqrt(panels.measure[panel])) goes_on[panel][v] = true;
            }
    }
    // Edges by the facets that meet there: two walls that end at each other touch each other, once.
    std::map<std::pair<int, int>, std::vector<std::size_t>> by_facets;
    for (std::size_t c = 0; c < corners.size(); ++c)
        by_facets[std::minmax(facet[std::size_t(corners[c].panel[0])], facet[std::size_t(corners[c].panel[1])])]
            .push_back(c);
    std::vector<int> met;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        for (std::size_t v = 0; v < 3; ++v) {
            if (goes_on[k][v]) continue;
            const Vec3 &a = panels.vertex(k, v), &b = panels.vertex(k, (v + 1) % 3), middle = 0.5 * (a + b);
            const auto* cell = grid.at(middle);
            if (!cell) continue;
            const Vec3 away = into_panel(panels, k, a, b);
            met.clear();
            for (std::size_t entry = 0; entry < cell->panel.size(); ++entry) {
                const auto m = std::size_t(cell->panel[entry]);
                if (cell->copy[entry] != 0 || panels.panels[m].wall == panels.panels[k].wall) continue;
                if (std::fabs(panels.height(m, a)) > touching || std::fabs(panels.height(m, b)) > touching) continue;
                const auto shape = panels.shape_functions(m, middle);
                if (*std::min_element(shape.begin(), shape.end()) < -1e-9) continue;
                if (std::find(met.begin(), met.end(), facet[m]) != met.end()) continue;
                Vec3 open = panels.normal[m].cross(Vec3(b - a).normalized());
                if (open.dot(panels.normal[k]) < 0) open = -open;
                if (away.dot(panels.normal[m]) < least_opening || open.dot(panels.normal[k]) < least_opening) continue;
                auto& known = by_facets[std::minmax(facet[k], facet[m])];
                const auto covers = [&](const Corner<3>& edge, const Vec3& x) {
                    const double along = edge.along(x);
                    return along > 0 && along < 1 && (x - edge.point - along * edge.edge).norm() < touching;
                };
                const bool twice =
                    std::any_of(known.begin(), known.end(), [&](std::size_t c) { return covers(corners[c], middle); });
                if (twice) continue;
                met.push_back(facet[m]);
                Corner<3> corner{};
                corner.panel = {int(k), int(m)};
                corner.vertex = {panels.panels[k].vertex[v], panels.panels[k].vertex[(v + 1) % 3]};
                corner.floor[0] = int(m);
                corner.away[0] = away;
                corner.away[1] = open;
                corner.sharp = away.dot(open) > -std::numbers::sqrt2 / 2;
                finish(corner, panels);
                known.push_back(corners.size());
                corners.push_back(corner);
            }
        }
    }
}

// A corner that grows by the edges that end in it or pass through it.
class Meeting {
  public:
    Meeting(const Panels<3>& panels, const std::vector<int>& facet, const Corner<3>& edge, bool at_end)
        : panels_(panels), facet_(facet) {
        corner.panels = corner.aways = 0;
        const int vertex = edge.vertex[at_end ? 1 : 0];
        corner.vertex = {vertex, vertex};
        corner.floor = edge.floor;
        corner.update(panels);
        take(edge, at_end ? Vec3(-edge.edge) : edge.edge);
    }

    // Takes an edge that passes near the corner. False if the fluid there fills more than half a space.
    bool meet(const Corner<3>& edge, double touching) {
        const double length = edge.edge.norm(), s = edge.along(corner.point) * length;
        const double near = std::min(touching, 0.25 * length);
        if (s < -near || s > length + near || (corner.point - edge.point - s / length * edge.edge).norm() > near)
            return true;
        const bool at_start = s<near, at_end = s> length - near;
        bool fits = false;
        if (!at_end) fits = offer(edge, edge.edge);
        if (!at_start) fits = offer(edge, -edge.edge) || fits;
        // An edge of the same mesh that does not fit: part of the corner is convex. Others have their end elsewhere.
        const bool same_vertex = (at_start || at_end) && edge.floor[0] < 0 && corner.floor[0] < 0;
        return fits || !same_vertex;
    }

    bool complete() const { return corner.aways >= 3 && corner.panels >= 3 && spans_space(corner.away, corner.aways); }

    Corner<3> corner{};

  private:
    bool offer(const Corner<3>& edge, const Vec3& direction) {
        const Vec3 e = direction.normalized();
        for (std::size_t q = 0; q < corner.aways; ++q)
            if (corner.away[q].dot(e) > 0.9995) return true;
        for (std::size_t q = 0; q < corner.panels; ++q)
            if (e.dot(panels_.normal[std::size_t(corner.panel[q])]) < -slack) return false;
        for (const std::size_t p : {0u, 1u})
            for (std::size_t q = 0; q < corner.aways; ++q)
                if (corner.away[q].dot(panels_.normal[std::size_t(edge.panel[p])]) < -slack) return false;
        if (corner.aways == Corner<3>::most) return false;
        take(edge, direction);
        return true;
    }

    void take(const Corner<3>& edge, const Vec3& direction) {
        corner.away[corner.aways++] = direction.normalized();
        corner.sharp = corner.sharp || edge.sharp;
        for (const int f : edge.floor) {
            if (f < 0 || f == corner.floor[0] || f == corner.floor[1]) continue;
            corner.floor[corner.floor[0] < 0 ? 0 : 1] = f;
        }
        for (const std::size_t p : {0u, 1u}) {
            bool known = corner.panels == Corner<3>::most;
            for (std::size_t q = 0; q < corner.panels; ++q)
                known = known || facet_[std::size_t(corner.panel[q])] == facet_[std::size_t(edge.panel[p])];
            if (!known) corner.panel[corner.panels++] = edge.panel[p];
        }
    }

    static bool spans_space(const std::array<Vec3, Corner<3>::most>& v, std::size_t n) {
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = 0; b < a; ++b)
                for (std::size_t c = 0; c < b; ++c)
                    if (std::fabs(v[a].cross(v[b]).dot(v[c])) > 0.05) return true;
        return false;
    }

    const Panels<3>& panels_;
    const std::vector<int>& facet_;
};

void add_meetings(const Panels<3>& panels, const std::vector<int>& facet, double touching,
                  std::vector<Corner<3>>& corners) {
    const std::size_t edges = corners.size();
    // Edges by where they begin along x, so that each end is compared with few.
    std::vector<std::size_t> order(edges);
    double longest = 0;
    const auto begin = [&](std::size_t c) {
        return std::min(corners[c].point.x(), corners[c].point.x() + corners[c].edge.x());
    };
    for (std::size_t c = 0; c < edges; ++c) {
        order[c] = c;
        longest = std::max(longest, std::fabs(corners[c].edge.x()));
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return begin(a) < begin(b) || (begin(a) == begin(b) && a < b); });
    std::vector<std::size_t> near;
    for (std::size_t c = 0; c < edges; ++c) {
        for (const bool at_end : {false, true}) {
            Meeting meeting(panels, facet, corners[c], at_end);
            const Vec3 x = meeting.corner.point;
            near.clear();
            const auto first = std::lower_bound(order.begin(), order.end(), x.x() - longest - touching,
                                                [&](std::size_t e, double at) { return begin(e) < at; });
            for (auto e = first; e != order.end() && begin(*e) <= x.x() + touching; ++e)
                if (*e != c) near.push_back(*e);
            std::sort(near.begin(), near.end());
            bool convex = true;
            for (const std::size_t e : near) convex = convex && meeting.meet(corners[e], touching);
            if (!convex || !meeting.complete()) continue;
            bool known = false;
            const double same = std::min(touching, 0.25 * corners[c].edge.norm());
            meeting.corner.update(panels);
            for (std::size_t k = edges; k < corners.size() && !known; ++k)
                known = (corners[k].point - meeting.corner.point).norm() < same &&
                        corners[k].away[0].dot(meeting.corner.away[0]) +
                                corners[k].away[1].dot(meeting.corner.away[0]) +
                                corners[k].away[2].dot(meeting.corner.away[0]) >
                            0;
            if (!known) corners.push_back(meeting.corner);
        }
    }
}

}  // namespace

template <>
std::vector<Corner<3>> find_corners(const Panels<3>& panels, const Grid& grid, const std::vector<int>& facet,
                                    double touching) {
    std::vector<Corner<3>> corners;
    add_joints(panels, corners);
    add_contacts(panels, grid, facet, touching, corners);
    add_meetings(panels, facet, touching, corners);
    return corners;
}

}  // namespace aquagraph::fluid
