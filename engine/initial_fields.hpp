// [fluid.initial] of a scene: velocity and pressure at t = 0 as formulas of position.
#pragma once
#include "io/scene.hpp"
#include "physics/fluid/fluid.hpp"

namespace aquagraph::engine {

// To be called once the particles are where they start. A pressure changes density and with it mass: ρ times the volume
// that the particle was given. Throws io::SceneError, with the place, where a formula gives no finite number or a
// pressure below what Tait's equation has a density for.
template <int D>
void set_initial_fields(fluid::Fluid<D>& fluid, const io::Scene& scene);

}  // namespace aquagraph::engine
