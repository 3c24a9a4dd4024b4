// What a scene says about its solid, as the options of the solver.
#pragma once
#include "io/scene.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::engine {

// The scene has a solid, and has been validated. Throws std::exception for a table that cannot be read any more.
template <int D>
solid::Options<D> solid_options(const io::Scene& scene);

}  // namespace aquagraph::engine
