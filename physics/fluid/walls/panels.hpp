// The walls of a scene: flat panels between vertices that may move, segments in 2D and triangles in 3D. In 2D fluid
// lies on the left of first -> second vertex, in 3D the vertices run counter-clockwise seen from the fluid.
//
// Rigid walls and the wet surface of a solid are the same thing here: only who moves the vertices differs.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace aquagraph::fluid {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;
template <int D>
using Mat = Eigen::Matrix<double, D, D>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

template <int D>
struct Panel {
    std::array<int, D> vertex;
    int wall;  // index into names
    bool no_slip = false;
    bool wet = false;       // belongs to a solid that wants to know its load
    bool symmetry = false;  // a plane of symmetry: free slip, not a body, so nobody asks for a load on it
};

// Two panels that share a side: a vertex in 2D, an edge in 3D, or two in the same place. In 2D panel[0] ends where
// panel[1] begins; in 3D panel[0] < panel[1], and the edge runs as panel[0] runs through it.
template <int D>
struct Joint {
    std::array<int, 2> panel;
    std::array<int, D - 1> vertex;  // of panel[0]
};

template <int D>
struct Panels {
    static_assert(D == 2 || D == 3);
    std::vector<Vec<D>> position, velocity;  // of vertices [m], [m/s]
    std::vector<Panel<D>> panels;
    std::vector<std::string> names;  // of walls
    std::size_t copies = 0;          // the last panels repeat others in a periodic domain (walls of normal fluxes)

    std::vector<Joint<D>> joints;  // by find_joints(), once all walls are there

    // Derived from positions by update_geometry().
    std::vector<Vec<D>> normal;    // unit vectors into the fluid
    std::vector<Vec<D>> tangent;   // unit vectors from the first vertex to the second
    std::vector<Vec<D>> centroid;  // [m]
    std::vector<double> measure;   // length [m] or area [m²]

    std::size_t size() const { return panels.size(); }
    void update_geometry();
    // Walls that meet now stay joined: the rigid wall above a clamped gate and the gate.
    void find_joints();

    const Vec<D>& vertex(std::size_t panel, std::size_t k) const {
        return position[std::size_t(panels[panel].vertex[k])];
    }
    const Vec<D>& start(std::size_t panel) const { return vertex(panel, 0); }
    const Vec<D>& end(std::size_t panel) const  // of a segment
        requires(D == 2) {
        return vertex(panel, 1);
    }
    const std::string& name(std::size_t panel) const { return names[std::size_t(panels[panel].wall)]; }

    // Distance in front of the panel's plane [m].
    double height(std::size_t panel, const Vec<D>& x) const { return (x - start(panel)).dot(normal[panel]); }
    // Linear shape functions of the vertices at the foot of the perpendicular from x: they sum to 1, and one is
    // negative where the foot lies beyond the side opposite to its vertex.
    std::array<double, D> shape_functions(std::size_t panel, const Vec<D>& x) const;
    // The same at the foot moved onto the panel: none is negative.
    std::array<double, D> shape_functions_on(std::size_t panel, const Vec<D>& x) const;
    // True if the foot of the perpendicular from x lies on the panel, its border included.
    bool is_over(std::size_t panel, const Vec<D>& x) const;

    // Adds a polyline of panels under a name; closed joins the last point to the first. Returns the wall's index.
    int add_wall(const std::string& name, const std::vector<Vec<D>>& points, bool closed,
                 bool no_slip) requires(D == 2);
    // Adds triangles between these points under a name. Returns the wall's index. Throws std::invalid_argument for a
    // triangle without area or one whose corner does not exist.
    int add_wall(const std::string& name, const std::vector<Vec<D>>& points,
                 const std::vector<std::array<int, 3>>& triangles, bool no_slip) requires(D == 3);
};

// Smooth patches: panels that are joined and turn by less than 30° belong together. patch[k] numbers them.
template <int D>
std::vector<int> smooth_patches(const Panels<D>& panels);
// Flat facets: the same for less than a thousandth of a radian. Two triangles of a rectangle are one facet.
template <int D>
std::vector<int> flat_facets(const Panels<D>& panels);

extern template struct Panels<2>;
extern template struct Panels<3>;

}  // namespace aquagraph::fluid
