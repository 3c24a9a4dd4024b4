// One coupling cycle iterated until fluid and solid agree: what is kept of its start, and the tasks around it.
#pragma once
#include <vector>

#include "physics/clock.hpp"
#include "physics/coupling/interface.hpp"
#include "physics/fluid/snapshot.hpp"
#include "physics/fluid/walls/motion.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "physics/fluid/walls/wall_forces.hpp"
#include "physics/solid/structure.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

struct CycleStart {
    bool left = false;  // a trial has been begun: there is something to go back from
    fluid::Snapshot<2> fluid;
    std::vector<fluid::EnergyRates> works;  // of single walls: sums …
    std::vector<fluid::EnergyRates> last_works;
    solid::State solid;
    std::vector<double> borne_loads;
    std::size_t floor_count = 0;   // of walls of normal fluxes
    std::vector<double> y, guess;  // scratch
};

// Everything that a cycle touches.
struct IteratedParts {
    fluid::Fluid<2>& fluid;
    fluid::GhostWalls<2>* walls;            // ghosts …
    fluid::NormalFluxWalls<2>* flux_walls;  // … or normal fluxes; the other one is null
    const fluid::MovingWalls<2>* moving;    // null: none
    std::vector<fluid::WallWork<2>>& works;
    solid::Structure<2>& solid;
    coupling::Interface& interface;
    Clock& clock;

    fluid::Panels<2>& panels() const { return flux_walls ? flux_walls->panels : walls->panels; }
};

// Keeps the state at the start of the cycle, whose length is known, and makes the first guess of its end.
Task begin_iterations(const IteratedParts& parts, CycleStart& start);
// Back to the start of the cycle, but for the guess; wherever the trial before has ended, or failed.
Task back_to_start(const IteratedParts& parts, CycleStart& start);
// Compares what the solid has come to with the guess and makes the next one.
Task relaxation(const IteratedParts& parts, CycleStart& start);

}  // namespace aquagraph::tasks
