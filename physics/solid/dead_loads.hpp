// Loads that keep their direction and their size whatever the body does ("dead" loads), as nodal forces.
#pragma once
#include <array>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

// Nodal forces of size 1 and what multiplies them in time.
struct DeadLoad {
    std::vector<double> forces;            // D × nodes [N]
    std::function<double(double)> factor;  // of t [s]; empty: 1
};

// Consistent nodal forces f_a = ∫ N_a t dA of a constant traction t [N/m²] on a surface set, over the reference
// configuration; D = 2: on the thickness [m]. Throws std::invalid_argument for a surface that there is not.
template <int D>
std::vector<double> traction_forces(const Mesh<D>& mesh, const std::string& surface,
                                    std::type_identity_t<const std::array<double, D>&> t, double thickness = 1);

// A force [N] shared evenly by nodes.
template <int D>
std::vector<double> shared_force(const Mesh<D>& mesh, std::span<const NodeIndex> nodes,
                                 std::type_identity_t<const std::array<double, D>&> force);

// forces = Σ factor(t) × forces of each load; throws std::domain_error where a factor is no finite number.
void sum_at(const std::vector<DeadLoad>& loads, double t, std::span<double> forces);

}  // namespace aquagraph::solid
