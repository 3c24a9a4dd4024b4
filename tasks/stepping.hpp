// Time steps, the clock, and the examination of the fluid after each step, as tasks.
#pragma once
#include <memory>

#include "physics/clock.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/time_step.hpp"
#include "tasks/task.hpp"

namespace aquagraph::tasks {

// Chooses Δt = fraction × the largest stable step, cut so that `steps` of them end at the end of the run at the latest.
// With `whole_cycle` the step holds for all steps of the cycle and clock.cycle is set; otherwise it is added to it.
struct StepChoice {
    double fraction = 1;
    int steps = 1;
    bool whole_cycle = false;
    bool first_of_cycle = true;
};
template <int D>
Task time_step(fluid::Fluid<D>& fluid, Clock& clock, StepChoice choice, const std::string& label);

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
