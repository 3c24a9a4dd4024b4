// How long a solid step a staggered exchange bears, from a model of one mode of the body and the sound that it
// radiates.
//
// Water answers a wall that moves by w with the pressure ρ0 c0 w at once, before it has felt the other walls. In a
// staggered exchange the load of a solve is the answer to a velocity that the body has already left behind, so a damper
// of ρ0 c0 per area is treated explicitly. A mode of the body of frequency ω and mass m'' per wet area,
//     m'' = φᵀM φ / ∫_wet (φ·n)² dS,
// becomes, with Newmark's or HHT's update over Δt = p Δt_f,
//     a_n+1 + (1+α) ω² x_n+1 - α ω² x_n = (1+α) f_n+1 - α f_n                                (HHT; Newmark: no weights)
//     f_n+1 = -(z/Δt) w_n     CSS: the load comes from the cycle that ends with the solve,
//     f_n+1 = -(z/Δt) w_n-1   CPS: from the one before it,          z = ρ0 c0 Δt/m''
// with w_n the velocity that wet nodes have at the end of the cycle that begins at t_n: v_n, or 2 v_n - v_n-1 with
// quadratic extrapolation. The mode grows where the largest eigenvalue of this linear map lies outside the unit circle.
// Since Δt_f = K R/c0 (thesis (2.61)), z = p K ρ0 R/m'': neither c0 nor the body's stiffness alone decides, but how
// much water lies within R of the wall. For a free mass Newmark with α has, by the triangle of Jury,
//     CSS  λ² - (1 - γ z) λ + (1 - γ) z = 0:        z < min(1/(1 - γ), 2/(2γ - 1)),  α = -0.3: 10/3;  α = 0: 2
//     CPS  λ³ - λ² + γ z λ + (1 - γ) z = 0:         α = -0.3: z < 0.963;  α = 0: 2(√2 - 1)
// and in between, about ω Δt = π/2 where the delay of CPS turns damping into its opposite, less.
//
// The model knows neither the layer of water that the kernel moves with the wall (it helps at p = 1), nor waves shorter
// along the wall than c0 Δt, which carry water with them instead of radiating. Our own derivation; measured against
// runs in benchmarks/CLAIMS.md.
#pragma once
#include <span>

#include "physics/coupling/choices.hpp"
#include "physics/solid/newmark.hpp"

namespace aquagraph::coupling {

struct StaggeredScheme {
    bool side_by_side = true;  // CPS; else CSS
    Extrapolation extrapolation = Extrapolation::linear;
    solid::NewmarkCoefficients newmark;  // of an implicit scheme
};

struct WetMode {
    double angular_frequency = 0;  // ω of the dry body [rad/s]; 0: it moves freely
    double mass_per_area = 0;      // m'' [kg/m²]; infinite where the mode does not move the wet surface
};

// By how much the mode grows in a cycle: the largest |λ|. z = ρ0 c0 Δt/m'' >= 0, omega_dt = ω Δt >= 0.
double growth_per_cycle(const StaggeredScheme& scheme, double z, double omega_dt);

// Of a cycle; the viscosity of the scheme takes more than this from any wave that the particles resolve.
inline constexpr double negligible_growth = 1e-3;

// Water that goes along with a mode lowers its frequency, by how much is not known here: every mode is tried at all
// frequencies between this part of its own and its own.
inline constexpr double lowest_wet_frequency = 1.0 / 3;

// The largest p up to which no mode grows by more than that, at most `most`; 0: not even p = 1. impedance: ρ0 c0
// [kg/(m² s)], fluid_step: Δt_f [s].
int largest_stable_ratio(const StaggeredScheme& scheme, std::span<const WetMode> modes, double impedance,
                         double fluid_step, int most);

}  // namespace aquagraph::coupling
