// Everything that is renewed when the neighbour lists no longer hold.
#pragma once
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"

namespace aquagraph::fluid {

// Re-sorts the particles in space, mirrors them anew and makes new lists. walls may be null. Vertices of walls must
// stand where they are now.
template <int D>
void rebuild_lists(Fluid<D>& fluid, GhostWalls* walls, BlockLoop loop);

}  // namespace aquagraph::fluid
