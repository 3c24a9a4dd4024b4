// The solid of a scene and what couples it to the fluid: two-dimensional so far.
#pragma once
#include "engine/model.hpp"

namespace aquagraph::engine {

// Throws io::SceneError where the mesh cannot be read or a set does not exist.
solid::Solver<2> make_solid(const io::Scene& scene);

// Adds the wet surface to the model's walls. Throws io::SceneError for water inside the solid and for surfaces that the
// mesh does not have.
coupling::Interface make_interface(const io::Scene& scene, Model<2>& model);

// Static equilibrium where the scene asks for it, first loads, first exchange.
void start_solid(Model<2>& model, const io::Scene& scene);

// The node that a track follows: the nearest to its point in the reference configuration.
template <int D>
std::size_t nearest_node(const solid::Mesh<D>& mesh, const io::Point& point);

}  // namespace aquagraph::engine
