// The energy-conservative load (thesis (5.43)-(5.47)): the force-conservative one times 1 + ε, so that the energy that
// the body loses by it, E_fluid/body, follows the energy that the fluid gets from the body, E_body/fluid (5.32).
//
// The thesis sets ε = [D + (P_bf - P_fb) Δt] / (P_fb Δt) with D = E_body/fluid - E_fluid/body so far and the powers of
// the last step, "averaged over previous steps". Here both powers times Δt are replaced by sums over past cycles whose
// weights decay by 1 - 1/N each cycle,
//     ε = (D + S_bf - S_fb) / S_fb,     |ε| <= 0.15,
// S_fb that of the uncorrected force: while powers last, ε makes good within N cycles what has gone wrong. Where the
// energy has no direction, |S_fb| < 0.05 Σ|…|, dividing by it would say nothing, and ε decays instead.
#pragma once
#include <algorithm>
#include <cmath>

namespace aquagraph::coupling {

struct EnergyCorrection {
    double cycles = 20;  // N
    double limit = 0.15;

    double epsilon = 0;
    double to_fluid = 0, from_body = 0, moved = 0;  // S_bf, S_fb, S of |E_fb| [J/m]

    double factor() const { return 1 + epsilon; }

    // After a cycle in which the fluid got `gained` from the body, the body lost `given` by the corrected force;
    // drift: D, all cycles together [J/m].
    void update(double gained, double given, double drift) {
        const double decay = 1 - 1 / cycles, uncorrected = given / factor();
        to_fluid = decay * to_fluid + gained;
        from_body = decay * from_body + uncorrected;
        moved = decay * moved + std::fabs(uncorrected);
        if (std::fabs(from_body) <= 0.05 * moved)
            epsilon *= decay;
        else
            epsilon = std::clamp((drift + to_fluid - from_body) / from_body, -limit, limit);
    }
};

}  // namespace aquagraph::coupling
