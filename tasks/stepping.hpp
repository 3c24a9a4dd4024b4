// Time steps, the clock, and the examination of the fluid after each step, as tasks.
#pragma once
#include <memory>

#include "physics/clock.hpp"
#include "physics/coupling/cycle_step.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/time_step.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// Chooses Δt, the largest stable step, cut so that it ends at the end of the run at the latest, and adds it to the
// cycle's length, which begins anew where it is the first of the cycle. held: null where nothing asks for equal steps.
template <int D>
Task time_step(fluid::Fluid<D>& fluid, Clock& clock, coupling::HeldStep* held, bool first_of_cycle,
               const std::string& label);
// Chooses one Δt for all `steps` of a cycle by the cycle's rule, cut likewise.
template <int D>
Task cycle_step(fluid::Fluid<D>& fluid, Clock& clock, coupling::CycleStep& rule, int steps);

// The fluid has made one step.
Task advance_clock(Clock& clock, const std::string& label);

// A particle that cannot be computed further. The engine adds neighbours and the likely cause.
class SickParticle : public std::runtime_error {
  public:
    SickParticle(fluid::Diagnosis diagnosis, const std::string& message)
        : std::runtime_error(message), diagnosis(diagnosis) {}
    fluid::Diagnosis diagnosis;
};

// Throws SickParticle if a particle is not finite, has lost its volume or has left a closed domain.
template <int D>
Task examine(fluid::Fluid<D>& fluid, const std::string& label);

}  // namespace aquagraph::tasks
