// What a scene can choose of the coupling, by name.
#pragma once

namespace aquagraph::coupling {

// What the fluid exerts on the wet panels: loads/.
enum class LoadMethod { averaged_pressure, force_conservative, energy_conservative };

// How wet nodes move between two exchanges: wet_surface.hpp.
enum class Extrapolation { none, linear, quadratic };

// How the steps of a parallel cycle are fixed beforehand: cycle_step.hpp.
enum class StepRule { fixed, predicted };

// How the fluid and the solid of one cycle are brought to agree: fixed_point.hpp.
enum class Relaxation { aitken, quasi_newton };

}  // namespace aquagraph::coupling
