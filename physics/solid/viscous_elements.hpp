// Damping in proportion to the stiffness, for large rotations: the elasticity of the undeformed material, carried along
// with the body,
//   S_d = β C_0 : Ė,   Ė = sym(Fᵀ Ḟ),   F_d = ∫ F S_d · ∇N dV
// About the undeformed state this is Rayleigh's β K v. Unlike β K v with a matrix that stays as it was, it does nothing
// to a body that turns: a rolling wheel is not braked by its damping. (Kelvin–Voigt; Belytschko, Liu & Moran,
// Nonlinear Finite Elements, 2nd ed., 6.6.) Its dissipation Ė : β C_0 : Ė is never negative.
#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "physics/solid/element_group.hpp"

namespace aquagraph::solid {

// Packs and lanes are those of the ElementGroup that it was made for.
template <int D>
class ViscousGroup {
  public:
    virtual ~ViscousGroup() = default;
    // F_d at displacements u [m] and velocities v [m/s], for packs [first, last); layout of
    // ElementGroup::internal_forces.
    virtual void forces(std::span<const double> u, std::span<const double> v, std::size_t first, std::size_t last,
                        std::span<double> forces) const = 0;
    // matrices += factor × ∂F_d/∂v; layout of ElementGroup::tangents. (∂F_d/∂u is left to Newton: beside K it is as
    // small as the strain in a time β.)
    virtual void add_tangents(std::span<const double> u, double factor, std::size_t first, std::size_t last,
                              std::span<double> matrices) const = 0;
};

// β of the options, > 0 [s]. Cords are not damped. Throws std::invalid_argument for elements with enhanced strains, in
// which C_0 alone would be stiffer in bending than the elements are.
template <int D>
std::unique_ptr<ViscousGroup<D>> make_viscous_group(const Mesh<D>& mesh, const ElementGroup<D>& group,
                                                    const Material& material, const Options<D>& options);

}  // namespace aquagraph::solid
