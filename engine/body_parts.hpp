// The elastic body of a scene: mesh, solver, loads of its own; and the step of a body without water.
#pragma once
#include "engine/model.hpp"
#include "tasks/task.hpp"

namespace aquagraph::engine {

// Throws io::SceneError where the mesh cannot be read or a set does not exist.
template <int D>
solid::Solver<D> make_solid(const io::Scene& scene);

// The solver that the scene chooses for the body, if it is not the built-in one. Throws io::SceneError where it cannot
// be started or does not know what the scene asks for.
template <int D>
void choose_solver(const io::Scene& scene, Model<D>& model);

// A body alone: solver, loads and step of the scene into the model, which has no fluid.
template <int D>
void make_structure(const io::Scene& scene, Model<D>& model);

// Equilibrium under its own weight and its loads at t = 0, and a velocity, where the scene asks for them.
template <int D>
void static_start(const io::Scene& scene, Model<D>& model);

// The tasks of a step of a body alone:  time step -> loads -> finite element solve -> clock.
template <int D>
std::vector<tasks::Task> structural_step(Model<D>& model);

// The node that a track follows: the nearest to its point in the reference configuration.
template <int D>
std::size_t nearest_node(const solid::Mesh<D>& mesh, const io::Point& point);

}  // namespace aquagraph::engine
