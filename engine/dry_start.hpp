// Bodies and walls that begin out of the water's reach. That may be meant: a tyre, a wedge or a plate is often drawn
// away from the water that it will meet. It may as well be a slip in a coordinate, after which a run would compute for
// hours that nothing happens: so it is said once, before the run, and nothing is refused.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/model.hpp"
#include "io/scene.hpp"

namespace aquagraph::engine {

template <int D>
struct DryStart {
    std::string body;      // "the wet surface of 'gate'", "wall 'wedge'"
    bool elastic = false;  // a body that is computed, not a wall
    // The nearest of the particles in front of it, nothing where there are none, and how far its centre is [m]. In a
    // periodic domain it may be an image.
    std::optional<fluid::Vec<D>> particle;
    double gap = std::numeric_limits<double>::infinity();
};

// Of the wet surface of an elastic body, and of every wall that moves or whose force is asked for: those from which all
// particles in front are farther than R. Walls that only hold water or guide it are often dry, and nothing is said of
// them. The model is as make_model() leaves it; its particles are looked at once.
template <int D>
std::vector<DryStart<D>> dry_starts(const io::Scene& scene, const Model<D>& model);

// What there is to say of it: who, how far from where, and what to do if that is not meant.
template <int D>
std::string text_of(const DryStart<D>& dry, const Model<D>& model);

}  // namespace aquagraph::engine
