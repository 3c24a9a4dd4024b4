// A step that stays the same while its limit hardly changes. The solid's factorised matrix M + w β Δt² K belongs to one
// length of step: at another one what is stiff converges with the rate |1 - (Δt/Δt_made)²| instead of at once, and the
// limit of the fluid's step changes a little in every step.
#pragma once
#include <algorithm>
#include <cmath>

namespace aquagraph::coupling {

struct HeldStep {
    double band = 0;  // how far a step may be from the wanted one, of it; 0: not at all
    double held = 0;  // [s]; 0: none yet

    // A step as near to the wanted one as the band, and none above `largest`.
    double next(double wanted, double largest) {
        const double middle = std::min(wanted, (1 - band) * largest);
        if (std::fabs(held - middle) > band * middle) held = middle;
        return held;
    }
};

}  // namespace aquagraph::coupling
