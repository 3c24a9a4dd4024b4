// The rigid walls of a scene as panels: the place where every kind of [[wall]] is turned into them.
#pragma once
#include "io/scene.hpp"
#include "physics/fluid/walls/motion.hpp"
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::engine {

// One wall of `panels` for each [[wall]], in the order of the scene. Throws io::SceneError for a face that is not flat
// or not convex.
template <int D>
void add_walls(const io::Scene& scene, fluid::Panels<D>& panels);

// Those of them that move by themselves; panels as add_walls has made them, every [[wall]] with its index.
template <int D>
fluid::MovingWalls<D> moving_walls(const io::Scene& scene, const fluid::Panels<D>& panels);

// Takes out joints between a wall that moves by itself and another: where walls meet now they need not stay joined.
template <int D>
void part_moving_walls(const io::Scene& scene, fluid::Panels<D>& panels);

// Corners of the panels of walls that move by themselves, where they are now, for the film; of very many only some.
template <int D>
std::vector<std::vector<io::Point>> moving_panels(const io::Scene& scene, const fluid::Panels<D>& panels);

}  // namespace aquagraph::engine
