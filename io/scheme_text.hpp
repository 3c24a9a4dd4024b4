// One line that says how the fluid is computed, for people: "Riemann-SPH (MUSCL), Wendland C2, RK4".
#pragma once
#include <string>

#include "io/scene.hpp"

namespace aquagraph::io {

std::string scheme_text(const FluidScene& fluid);

}  // namespace aquagraph::io
