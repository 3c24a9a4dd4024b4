// The water of a scene as particles without walls yet: boxes, polygons, discs, spheres, volumes, relaxed where wanted.
#pragma once
#include <string>
#include <vector>

#include "io/scene.hpp"
#include "physics/fluid/filling.hpp"
#include "physics/fluid/relaxation.hpp"
#include "physics/geometry/surface.hpp"

namespace aquagraph::engine {

// How well one body of water was filled.
struct FilledBody {
    std::string key;    // "fluid.polygon[0]"
    double volume = 0;  // of the shape [m^D]
    double filled = 0;  // of its particles [m^D]
    std::size_t particles = 0;
    bool relaxed = false;
    fluid::RelaxationResult relaxation;
};

// Fills `particles`. Throws io::SceneError with the place where two bodies overlap, where one gives no particle, or
// where water stands on the wrong side of a wall.
template <int D>
std::vector<FilledBody> fill_with_water(const io::Scene& scene, const fluid::Tait& tait,
                                        fluid::Particles<D>& particles);

}  // namespace aquagraph::engine
