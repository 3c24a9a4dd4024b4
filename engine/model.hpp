// A scene turned into the things that are computed: particles, walls, the solid, their interface, the clock.
// What a scene does not have is not there.
#pragma once
#include <memory>
#include <optional>

#include "engine/water_parts.hpp"
#include "io/scene.hpp"
#include "physics/clock.hpp"
#include "physics/coupling/cycle_step.hpp"
#include "physics/coupling/interface.hpp"
#include "physics/fluid/body_forces.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/walls/motion.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "physics/fluid/walls/wall_forces.hpp"
#include "physics/solid/dead_loads.hpp"
#include "physics/solid/solver.hpp"
#include "tasks/iteration.hpp"

namespace aquagraph::engine {

// What a body without water bears, and how it goes on.
struct Structure {
    double step = 0;  // [s], the longest
    bool is_static = false;
    std::vector<solid::DeadLoad> loads;
    std::vector<double> forces;  // their sum at the end of the step, D × nodes [N]
};

// The interface between fluid and solid is two-dimensional so far.
template <int D>
struct Model {
    std::optional<fluid::Fluid<D>> fluid;
    std::vector<FilledBody> water;  // how it was filled
    std::optional<fluid::CentralForce<D>> central_force;
    std::optional<std::array<double, D>> driving_force;   // [m/s²]
    std::optional<fluid::GhostWalls<D>> walls;            // ghosts …
    std::optional<fluid::NormalFluxWalls<D>> flux_walls;  // … or normal fluxes
    fluid::MovingWalls<D> moving;                         // those with a prescribed motion
    // Of walls whose force is asked for, where energies are kept; the last one is the body's, where they are kept
    // across the interface.
    std::vector<fluid::WallWork<D>> wall_works;
    std::optional<solid::Solver<D>> solid;
    // Computes the body instead of `solid`, which then has the state that it has come to.
    std::unique_ptr<solid::Structure<D>> other_solver;
    std::optional<Structure> structure;  // where there is no fluid
    std::optional<coupling::Interface> interface;
    coupling::CycleStep cycle_step;
    tasks::CycleStart cycle_start;  // of the iterated algorithm
    Clock clock;
};

// The walls' panels, whatever the walls do; there must be walls.
template <int D>
const fluid::Panels<D>& panels_of(const Model<D>& model) {
    return model.flux_walls ? model.flux_walls->panels : model.walls->panels;
}
template <int D>
fluid::Panels<D>& panels_of(Model<D>& model) {
    return model.flux_walls ? model.flux_walls->panels : model.walls->panels;
}

// Whoever computes the body; there must be one.
template <int D>
solid::Structure<D>& solver_of(Model<D>& model) {
    if (model.other_solver) return *model.other_solver;
    return *model.solid;
}

// What the body does to the fluid; null where energies across the interface are not kept.
template <int D>
const fluid::WallWork<D>* body_work(const Model<D>& model) {
    return model.interface && model.interface->keeps_energy ? &model.wall_works.back() : nullptr;
}

// Throws io::SceneError for what only shows once meshes are read: a set that does not exist, water inside the solid.
// The solid's static start is not computed yet (it costs time): start() does.
// By pointer, since tasks keep references to the parts.
template <int D>
std::unique_ptr<Model<D>> make_model(const io::Scene& scene);

// Static equilibrium of the solid where the scene asks for it, first loads, first exchange.
template <int D>
void start(Model<D>& model, const io::Scene& scene);

}  // namespace aquagraph::engine
