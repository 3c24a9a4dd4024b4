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

// True if lists and ghosts hold to the end of the coming step: nothing that has not been listed or mirrored can come
// closer than R.
template <int D>
bool lists_hold(Fluid<D>& fluid, const GhostWalls<D>* walls, const Travel& travel, const ComingStep& coming,
                BlockLoop loop);
template <int D>
bool lists_hold(Fluid<D>& fluid, const NormalFluxWalls<D>* walls, const Travel& travel, const ComingStep& coming,
                BlockLoop loop);

// After a checkpoint has been read: makes lists, ghosts and all that goes with them as they were made when particles
// stood at x_built and the walls' vertices where fluid.record says, calls `also` there, for what others collect from
// the lists, and takes particles and walls to where they are now. Not a bit differs from what was there when the
// checkpoint was written. Throws std::runtime_error if there are not as many ghosts as there were.
template <int D>
void remake_lists(Fluid<D>& fluid, GhostWalls<D>* walls, BlockLoop loop, FunctionRef<void()> also);
template <int D>
void remake_lists(Fluid<D>& fluid, NormalFluxWalls<D>& walls, BlockLoop loop, FunctionRef<void()> also);

}  // namespace aquagraph::fluid
