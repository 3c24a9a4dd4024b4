// The numbers of Newmark's and Hilber, Hughes & Taylor's schemes (thesis (3.37)-(3.46)).
//
// Both have γ = 1/2 - α and β = (1 - α)²/4, α in ]-1/3, 0], and are unconditionally stable in the linear range. HHT
// weighs the forces of the two ends of the step and stays second order; Newmark with α < 0 does not and is first order
// (its damping ratio is -α ω Δt/2 at low frequency, HHT's is of third order in ω Δt). With α = 0 they are the same, and
// keep the energy of a linear body. The highest frequencies, ω Δt → ∞, shrink by (1 + α)/(1 - α) a step in both.
#pragma once
#include "physics/solid/options.hpp"

namespace aquagraph::solid {

struct NewmarkCoefficients {
    double beta = 0.25;
    double gamma = 0.5;
    double weight_new = 1;  // of the forces at the end of the step
    double weight_old = 0;  // of those at its start
};

// Central differences are β = 0, γ = 1/2, whatever α.
inline NewmarkCoefficients newmark_coefficients(Scheme scheme, double alpha) {
    if (scheme == Scheme::central_difference) return {0, 0.5, 1, 0};
    NewmarkCoefficients c{(1 - alpha) * (1 - alpha) / 4, 0.5 - alpha, 1, 0};
    if (scheme == Scheme::hht) {
        c.weight_new = 1 + alpha;
        c.weight_old = -alpha;
    }
    return c;
}

}  // namespace aquagraph::solid
