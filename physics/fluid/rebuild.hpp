// Everything that is renewed when the neighbour lists no longer hold.
#pragma once
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/walls/normal_flux.hpp"

namespace aquagraph::fluid {

// Brings particles that have left a periodic domain back into it, re-sorts them in space, mirrors them anew and makes
// new lists. walls may be null. Vertices of walls must stand where they are now.
template <int D>
void rebuild_lists(Fluid<D>& fluid, GhostWalls<D>* walls, BlockLoop loop);

// The same with walls of the normal flux method.
template <int D>
void rebuild_lists(Fluid<D>& fluid, NormalFluxWalls<D>& walls, BlockLoop loop);

}  // namespace aquagraph::fluid
