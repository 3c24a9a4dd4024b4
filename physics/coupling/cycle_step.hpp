// The step of a cycle whose length must be known before it begins, because the solid runs beside the fluid (CPS).
//   fixed      Δt = f Δt_CFL(t_n) with f = 0.8 (thesis (6.4)): a fifth of every step is given away for safety.
//   predicted  Δt = f min(Δt_CFL, its linear trend at the last step of the cycle) (1 - m), f = 1: the limit hardly
//              moves in a few steps, and where it does, it shows in the trend. m is the largest overstep of late: at
//              the end of each cycle it is known by how much its last step was longer than what was allowed when it
//              began; m decays by a tenth per cycle, so that a run whose limit jumps about keeps away from it. An
//              overstep of some percent is no loss of stability: K = 0.375 is half of what Runge-Kutta bears.
#pragma once
#include <algorithm>

#include "physics/coupling/choices.hpp"
#include "physics/coupling/held_step.hpp"

namespace aquagraph::coupling {

struct CycleStep {
    StepRule rule = StepRule::fixed;
    double fraction = 0.8;  // f

    double limit = 0;     // Δt_CFL at the start of the present cycle [s]; 0: none yet
    double step = 0;      // of the present cycle [s]
    double margin = 0;    // m
    double overstep = 0;  // of the last step of the cycle before
    int steps = 1;        // p of the present cycle
    HeldStep held = {};   // also of the steps of CSS, which knows nothing else of this

    static constexpr double most_margin = 0.2, decay = 0.9;

    // The step of a cycle of `count` steps that begins now, with this limit.
    double next(double limit_now, int count) {
        double wanted = fraction * limit_now;
        if (rule == StepRule::predicted && limit > 0) {
            const double per_step = (limit_now - limit) / steps, at_last_step = limit_now - per_step;
            overstep = steps > 1 ? std::max(0.0, step / (fraction * at_last_step) - 1) : 0;
            margin = std::min(most_margin, std::max(decay * margin, overstep));
            // The last step of the cycle begins count - 1 steps from now.
            const double trend = limit_now + per_step * (count - 1);
            wanted = fraction * std::max(std::min(limit_now, trend), (1 - most_margin) * limit_now) * (1 - margin);
        }
        limit = limit_now;
        steps = count;
        return step = held.next(wanted, rule == StepRule::fixed ? limit_now : wanted);
    }
};

}  // namespace aquagraph::coupling
