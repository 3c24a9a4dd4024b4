// What a scene can choose of the fluid's method, by name.
#pragma once

namespace aquagraph::fluid {

enum class KernelName { wendland_c2, cubic_spline };  // kernel.hpp

enum class Scheme { riemann, riemann_ale, delta_sph, artificial_viscosity };  // fluxes.hpp

enum class RiemannSolver {
    acoustic,
    low_dissipation,  // Zhang, Hu & Adams (2017): acoustic, dissipation in p_e times min(3 max(u_L - u_R, 0)/c, 1)
    exact             // riemann.hpp, water (γ = 7) only
};

enum class IntegrationScheme { rk4, rk3, verlet };  // time_integration.hpp

enum class ViscousOperator { monaghan_gingold, morris };  // viscosity.hpp

// What moves particles otherwise than with the water's velocity: x_sph.hpp, shifting.hpp.
enum class Transport { none, x_sph, shifting };

}  // namespace aquagraph::fluid
