// The classical fourth-order Runge–Kutta method (thesis (2.65)-(2.69)) on u = (x, v, ρ - ρ0):
//     u^(1) = u^n + ½Δt k1,  u^(2) = u^n + ½Δt k2,  u^(3) = u^n + Δt k3,  u^(n+1) = u^n + Δt/6 (k1 + 2k2 + 2k3 + k4)
// with k = (v, dv/dt, dρ/dt) of the stage. After each stage pressure, impedance and volume follow from the density.
#pragma once
#include <stdexcept>

#include "physics/fluid/equation_of_state.hpp"
#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

inline constexpr int stages = 4;
inline constexpr double stage_time[stages + 1] = {0, 0.5, 0.5, 1, 1};  // of the state before stage s; last: after all

template <int D>
struct RungeKutta {
    Vectors<D> x_n, v_n, x_sum, v_sum;
    Scalars deviation_n, deviation_sum;
    void resize(const Particles<D>& particles);
};

// Takes the rates of stage `stage` (0 … 3) and moves the fluid particles of these lanes to the next stage's state.
template <int D>
void advance_stage(Particles<D>& particles, RungeKutta<D>& rk, const Tait& tait, int stage, double dt, LaneRange lanes);

// Near a free surface water does not hold together: particles whose support is emptier than this bear no tension.
// Inside, suction is physical (p is relative to the air) and stays.
inline constexpr double fullness_of_interior = 0.75;

// Pressure, impedance, volume from deviation and mass for the particles of these lanes.
template <int D>
void update_state(Particles<D>& particles, const Tait& tait, LaneRange lanes);

extern template struct RungeKutta<2>;
extern template struct RungeKutta<3>;

}  // namespace aquagraph::fluid
