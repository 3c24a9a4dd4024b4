// Body forces beside gravity.
//
// A force towards a centre: a = -Ω² (x - centre), as it holds the oscillating drop of
// Monaghan & Rafiee (2013, Int. J. Numer. Meth. Fluids 71) together. Its potential energy is ½ m Ω² |x - centre|².
#pragma once
#include <array>

#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

template <int D>
struct CentralForce {
    std::array<double, D> centre{};  // [m]
    double rate = 0;                 // Ω [1/s]
};

// Adds the force to dv/dt of the particles of these lanes: to be called after the pass that sets dv/dt.
template <int D>
void add_central_force(Particles<D>& particles, const CentralForce<D>& force, LaneRange lanes);

// Adds a constant acceleration a [m/s²] likewise. Unlike gravity no wall's pressure answers it.
template <int D>
void add_driving_force(Particles<D>& particles, const std::array<double, D>& a, LaneRange lanes);

// [J] ([J/m] in 2D)
template <int D>
double potential_energy(const Particles<D>& particles, const CentralForce<D>& force, LaneRange lanes);

extern template void add_central_force(Particles<2>&, const CentralForce<2>&, LaneRange);
extern template void add_central_force(Particles<3>&, const CentralForce<3>&, LaneRange);
extern template void add_driving_force<2>(Particles<2>&, const std::array<double, 2>&, LaneRange);
extern template void add_driving_force<3>(Particles<3>&, const std::array<double, 3>&, LaneRange);
extern template double potential_energy(const Particles<2>&, const CentralForce<2>&, LaneRange);
extern template double potential_energy(const Particles<3>&, const CentralForce<3>&, LaneRange);

}  // namespace aquagraph::fluid
