// Corners and edges of walls that the fluid fills to less than 180°.
//
// Behind them, between what their panels mirror, a wedge is left that point reflection through a corner fills, rotation
// by 180° about an edge in 3D. What goes there are the particles from which the feet of the perpendiculars onto all
// panels that meet, continued to infinity, lie on these panels: the dual cone of the corner, as large as the gap.
#pragma once
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

template <int D>
class PanelGrid;

// A corner of 2D walls; in 3D an edge between two panels, or a corner in which three or more such edges end. It is a
// joint of panels, or belongs to a body that touches another wall (a gate on its floor): closer than `touching` counts
// as closed, since no particle passes there.
template <int D>
struct Corner {
    static constexpr std::size_t most = D == 2 ? 2 : 8;
    std::array<int, most> panel;  // the first `panels` of them meet here
    std::size_t panels = 2;
    std::array<int, D - 1> vertex;  // moves with it, an edge with its two ends; the same twice: a corner in 3D …
    std::array<int, 2> floor = {-1, -1};  // … projected onto these panels, if any
    bool sharp;                           // fluid angle below 135°: both velocity components turn round
    std::array<Vec<D>, most> away;        // unit vectors along the panels (for a 3D corner: along its edges), off it
    std::size_t aways = 2;
    Vec<D> point = Vec<D>::Zero(), velocity = Vec<D>::Zero();      // present place and velocity, of an edge's start
    Vec<D> edge = Vec<D>::Zero(), edge_velocity = Vec<D>::Zero();  // from start to end, and how fast that changes

    bool is_point() const {
        if constexpr (D == 2) return true;
        return vertex[0] == vertex[D - 2];
    }
    // Where the perpendicular from x meets the edge or its continuation: 0 at the start, 1 at the end.
    double along(const Vec<D>& x) const { return is_point() ? 0 : (x - point).dot(edge) / edge.squaredNorm(); }
    void update(const Panels<D>& panels);
};

// `facet` numbers flat parts of walls. The grid must have been built.
template <int D>
std::vector<Corner<D>> find_corners(const Panels<D>& panels, const PanelGrid<D>& grid, const std::vector<int>& facet,
                                    double touching);
template <>
std::vector<Corner<2>> find_corners(const Panels<2>&, const PanelGrid<2>&, const std::vector<int>&, double);
template <>
std::vector<Corner<3>> find_corners(const Panels<3>&, const PanelGrid<3>&, const std::vector<int>&, double);

extern template struct Corner<2>;
extern template struct Corner<3>;

}  // namespace aquagraph::fluid
