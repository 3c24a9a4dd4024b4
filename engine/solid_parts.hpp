// What couples the solid of a scene to the fluid: two-dimensional so far.
#pragma once
#include "engine/model.hpp"

namespace aquagraph::engine {

// Adds the wet surface to the model's walls. Throws io::SceneError for water inside the solid and for surfaces that the
// mesh does not have.
coupling::Interface make_interface(const io::Scene& scene, Model<2>& model);

// Static equilibrium where the scene asks for it, first loads, first exchange.
void start_solid(Model<2>& model, const io::Scene& scene);

}  // namespace aquagraph::engine
