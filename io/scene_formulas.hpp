// The formulas of a scene: which names each may use, and the check that it is one.
#pragma once
#include "io/complaints.hpp"
#include "io/expression.hpp"
#include "io/scene.hpp"
#include "io/toml_document.hpp"

namespace aquagraph::io {

std::vector<std::string> names_of_position();  // x y z [m]; z is 0 in two dimensions
std::vector<std::string> names_of_field();     // and t [s]
std::vector<std::string> names_of_particle();  // and vx vy vz [m/s], p [Pa], rho [kg/m³], fullness

// [constants], in whatever order they build on one another.
Constants resolve_constants(const CheckedDocument& document, Complaints& complaints);

// Those of the scene, and its dx [m], rho0 [kg/m³], c0 [m/s] where there is a fluid.
Constants all_constants(const Scene& scene);

void validate_formulas(const Scene& scene, Complaints& complaints);

}  // namespace aquagraph::io
