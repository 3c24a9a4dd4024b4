// What can go wrong with a particle, looked for after every step, and energies of the fluid.
#pragma once
#include <array>

#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

enum class Ailment { none, not_finite, no_volume, left_domain, passed_wall };

struct Diagnosis {
    Ailment ailment = Ailment::none;
    std::size_t particle = 0;  // the first one, by place in the arrays
};

template <int D>
struct Domain {
    std::array<double, D> min, max;  // [m]
    bool contains(const Particles<D>& s, std::size_t i) const {
        for (std::size_t d = 0; d < D; ++d)
            if (!(s.x[d][i] >= min[d] && s.x[d][i] <= max[d])) return false;
        return true;
    }
};

// Looks at one range of particles; density must stay above a tenth of ρ0, or the volume is on its way to infinity or
// below zero. Leaving the domain counts as an ailment only where it is closed.
template <int D>
Diagnosis examine(const Particles<D>& particles, double reference_density, const Domain<D>& domain, bool closed,
                  LaneRange lanes);

struct FluidEnergies {
    double kinetic = 0, potential = 0;  // [J] ([J/m] in 2D): ½ m v², -m g·x
};
template <int D>
FluidEnergies energies(const Particles<D>& particles, const double (&gravity)[3], LaneRange lanes);

// Takes out the particles outside the domain, keeping the order of the others. Returns how many.
template <int D>
std::size_t remove_outside(Particles<D>& particles, const Domain<D>& domain);

}  // namespace aquagraph::fluid
