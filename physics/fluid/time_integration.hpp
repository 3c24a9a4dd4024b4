// Time integration of u = (x, v, ρ - ρ0), with mass exchange (x, m v, ρ - ρ0, m). Rates are those of the pair fluxes;
// positions move with v, or with v + δv where particles are shifted.
//
//     rk4     the classical method (thesis (2.65)-(2.69)): fourth order, four evaluations a step
//     rk3     Williamson's low-storage method (1980): third order, three evaluations, one register instead of two,
//                 k = A_s k + Δt f(u), u += B_s k with A = (0, -5/9, -153/128), B = (1/3, 15/16, 8/15)
//     verlet  velocity Verlet: second order, one evaluation a step, at its end:
//                 x' = x + Δt v + ½Δt² a,  v* = v + Δt a,  ρ* = ρ + Δt ρ̇;  rates at (x', v*, ρ*);
//                 v' = v + ½Δt (a + a*),  ρ' = ρ + ½Δt (ρ̇ + ρ̇*)
//             The rates of the step before are kept, so they must be there before the first step.
// After each stage pressure, impedance and volume follow from the density.
#pragma once
#include "physics/fluid/choices.hpp"
#include "physics/fluid/equation_of_state.hpp"
#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

template <int D>
struct TimeIntegration {
    IntegrationScheme scheme = IntegrationScheme::rk4;
    Vectors<D> x_n, v_n, x_sum,
        v_sum;  // rk4: the step's start and Σ of rates; rk3: *_sum are k; verlet: v_n = v + ½Δt a
    Scalars deviation_n, deviation_sum, mass_n, mass_sum;

    int stages() const { return scheme == IntegrationScheme::rk4 ? 4 : scheme == IntegrationScheme::rk3 ? 3 : 1; }
    // When in the step, 0 … 1, the rates of a stage are evaluated.
    double stage_time(int stage) const;
    // Whether predict() comes before the first evaluation of a step.
    bool predicts() const { return scheme == IntegrationScheme::verlet; }
    // Most that a damped quantity may decay in a step, Δt/τ, with a margin for disorder: stable up to 2.79, 2.51 and 1.
    double decay_of_step() const { return scheme == IntegrationScheme::verlet ? 0.75 : 2; }
    void resize(const Particles<D>& particles);
    std::size_t bytes() const { return bytes_of(x_n, v_n, x_sum, v_sum, deviation_n, deviation_sum, mass_n, mass_sum); }
};

// Takes the rates of stage `stage` (0 … stages - 1) and moves the fluid particles of these lanes, of one block, to the
// next stage's state.
template <int D>
void advance_stage(Particles<D>& particles, TimeIntegration<D>& integration, const Tait& tait, int stage, double dt,
                   LaneRange lanes);

// The first half of a Verlet step, from the rates of the step before.
template <int D>
void predict(Particles<D>& particles, TimeIntegration<D>& integration, const Tait& tait, double dt, LaneRange lanes);

// Near a free surface water does not hold together: particles whose support is emptier than this bear no tension.
// Inside, suction is physical (p is relative to the air) and stays.
inline constexpr double fullness_of_interior = 0.75;

// Pressure, impedance, volume from deviation and mass for the particles of these lanes.
template <int D>
void update_state(Particles<D>& particles, const Tait& tait, LaneRange lanes);

extern template struct TimeIntegration<2>;
extern template struct TimeIntegration<3>;

}  // namespace aquagraph::fluid
