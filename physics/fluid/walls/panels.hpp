// The walls of a 2D scene: straight panels between vertices that may move. Fluid lies on the left of first -> second.
//
// Rigid walls and the wet surface of a solid are the same thing here: only who moves the vertices differs.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace aquagraph::fluid {

using Vec2 = Eigen::Vector2d;

inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

struct Panel {
    int first, second;  // vertices
    int wall;           // index into names
    bool no_slip = false;
    bool wet = false;  // belongs to a solid that wants to know its load
};

// Where one panel ends another begins: first.second and second.first are one vertex, or two in the same place.
struct Joint {
    int before, after;  // panels
};

struct Panels {
    std::vector<Vec2> position, velocity;  // of vertices [m], [m/s]
    std::vector<Panel> panels;
    std::vector<std::string> names;  // of walls

    std::vector<Joint> joints;  // by find_joints(), once all walls are there

    // Derived from positions by update_geometry().
    std::vector<Vec2> tangent, normal;  // unit vectors; the normal points into the fluid
    std::vector<double> length;         // [m]

    void update_geometry();
    // Walls that meet now stay joined: the rigid wall above a clamped gate and the gate.
    void find_joints();
    const Vec2& start(std::size_t panel) const { return position[std::size_t(panels[panel].first)]; }
    const Vec2& end(std::size_t panel) const { return position[std::size_t(panels[panel].second)]; }
    const std::string& name(std::size_t panel) const { return names[std::size_t(panels[panel].wall)]; }

    // Adds a polyline of panels under a name; closed joins the last point to the first. Returns the wall's index.
    int add_wall(const std::string& name, const std::vector<Vec2>& points, bool closed, bool no_slip);
};

// Smooth patches: panels that are joined and turn by less than 30° belong together. patch[k] numbers them.
std::vector<int> smooth_patches(const Panels& panels);

// A corner that the fluid fills to less than 180°: behind it, between what the two panels mirror, a wedge is left that
// point reflection through the corner fills. It is a joint of two panels, or a vertex of a body that touches
// another wall (a gate on its floor): closer than `touching` counts as closed, since no particle passes there.
struct Corner {
    int panel[2];
    int vertex;            // moves with it …
    int floor = -1;        // … projected onto this panel, if any
    bool sharp;            // fluid angle below 135°: both velocity components turn round
    Vec2 away[2];          // along each panel, away from the corner
    Vec2 point, velocity;  // present place and velocity
    void update(const Panels& panels);
};
std::vector<Corner> find_corners(const Panels& panels, double touching);

}  // namespace aquagraph::fluid
