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
};

}  // namespace aquagraph::coupling
