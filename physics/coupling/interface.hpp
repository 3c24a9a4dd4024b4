// What passes between fluid and solid in one coupling cycle.
#pragma once
#include <vector>

#include "physics/coupling/loads/force_conservative.hpp"
#include "physics/coupling/wet_surface.hpp"

namespace aquagraph::coupling {

struct Interface {
    WetSurface surface;
    ForceConservativeLoad load;
    std::vector<Vec2> vertex_forces;  // of the last load, on the vertices of all panels [N/m]
    std::vector<double> fluid_loads;  // nodal, at the fluid's present time: what the fluid has computed
    std::vector<double> solid_loads;  // nodal, at the last exchange: what a CPS solve reads
    double force[2] = {0, 0};         // total of fluid_loads [N/m]

    // After the neighbour lists have been built.
    void rebuild(const fluid::Fluid<2>& fluid, const fluid::GhostWalls<2>& walls) {
        load.rebuild(fluid.particles, fluid.lists, walls);
    }

    // For a checkpoint: what later cycles read of earlier ones. A new piece of history goes in here. The load's pairs
    // are collected again with the lists.
    template <class Archive>
    void archive(Archive& fields) {
        fields(surface, vertex_forces, fluid_loads, solid_loads, force);
    }
};

}  // namespace aquagraph::coupling
