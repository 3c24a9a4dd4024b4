// Water where it cannot be is refused before anything runs, with its place.
#pragma once
#include <string>
#include <vector>

#include "io/scene.hpp"
#include "physics/fluid/filling.hpp"

namespace aquagraph::engine {

// keys, regions and water belong to the same bodies. Throws io::SceneError where particles of one body lie inside
// another.
template <int D>
void refuse_overlapping_water(const io::Scene& scene, const std::vector<std::string>& keys,
                              const std::vector<fluid::Region<D>>& regions, const std::vector<fluid::Water<D>>& water);

// Throws io::SceneError where a particle lies behind the wall that is nearest to it: at any distance if that wall is
// closed (inside an obstacle, outside a tank), within the kernel's radius if it is open, for what lies beyond its end
// is on no side of it. Walls that meet count as
// one; of two walls in the same place either may have water before it.
template <int D>
void refuse_water_behind_walls(const io::Scene& scene, const std::vector<std::string>& keys,
                               const std::vector<fluid::Water<D>>& water);

}  // namespace aquagraph::engine
