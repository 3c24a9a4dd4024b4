// Corners of 2D walls that the fluid fills to less than 180°.
#pragma once
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

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
    void update(const Panels<2>& panels);
};
std::vector<Corner> find_corners(const Panels<2>& panels, double touching);

}  // namespace aquagraph::fluid
