// What passes between fluid and solid in one coupling cycle.
#pragma once
#include <array>
#include <vector>

#include "physics/coupling/fixed_point.hpp"
#include "physics/coupling/interface_energy.hpp"
#include "physics/coupling/loads/averaged_pressure.hpp"
#include "physics/coupling/loads/energy_conservative.hpp"
#include "physics/coupling/loads/force_conservative.hpp"
#include "physics/coupling/ratio_control.hpp"
#include "physics/coupling/wet_surface.hpp"
#include "physics/fluid/walls/normal_flux.hpp"

namespace aquagraph::coupling {

struct Interface {
    LoadMethod method = LoadMethod::force_conservative;
    WetSurface surface;
    ForceConservativeLoad load;    // of the conservative methods …
    AveragedPressureLoad average;  // … or instead of it
    EnergyCorrection correction;   // ε, where the load is energy conservative; else 0
    bool keeps_energy = false;     // energies across the interface are summed up
    InterfaceEnergy energy;
    RatioControl ratio;
    FixedPoint fixed_point;  // of the iterated algorithm

    std::vector<Vec2> vertex_forces;  // of the last load, on the vertices of all panels [N/m]
    std::vector<double> fluid_loads;  // nodal, at the fluid's present time: what the fluid has computed
    std::vector<double> solid_loads;  // nodal, at the last exchange: what a CPS solve reads
    std::vector<double> borne_loads;  // nodal, at the end of the last solve; empty before the first
    std::vector<double> between;      // scratch of a solve
    std::array<double, 2> force{};    // total of fluid_loads [N/m]

    // For a checkpoint: what later cycles read of earlier ones. A new piece of history goes in here. The load's pairs
    // are collected again with the lists.
    template <class Archive>
    void archive(Archive& fields) {
        fields(surface, vertex_forces, fluid_loads, solid_loads, borne_loads, force, correction, energy, ratio,
               fixed_point);
    }

    // After the neighbour lists have been built.
    void rebuild(const fluid::Fluid<2>& fluid, const fluid::GhostWalls<2>& walls, BlockLoop loop = serial_loop) {
        if (method == LoadMethod::averaged_pressure)
            average.rebuild(fluid.particles, walls.panels, fluid.lists.reach());
        else
            load.rebuild(fluid.particles, fluid.lists, walls, loop);
    }
    // Walls of normal fluxes know themselves what particles exert on them.
    void rebuild(const fluid::Fluid<2>& fluid, const fluid::NormalFluxWalls<2>& walls, BlockLoop = serial_loop) {
        if (method == LoadMethod::averaged_pressure)
            average.rebuild(fluid.particles, walls.panels, fluid.lists.reach());
    }
};

}  // namespace aquagraph::coupling
