// volume_elements for every law, each compiled in a source file of its own (laws/): they are the long ones.
#pragma once
#include "physics/solid/element_group.hpp"
#include "physics/solid/materials/cords.hpp"
#include "physics/solid/materials/mooney_rivlin.hpp"
#include "physics/solid/materials/neo_hookean.hpp"
#include "physics/solid/materials/saint_venant_kirchhoff.hpp"
#include "physics/solid/materials/uniaxial_curve.hpp"

namespace aquagraph::solid {

template <int D, class Law>
std::unique_ptr<ElementGroup<D>> volume_elements(const Mesh<D>& mesh, std::vector<ElementIndex> members, const Law& law,
                                                 const Options<D>& options);

}  // namespace aquagraph::solid
