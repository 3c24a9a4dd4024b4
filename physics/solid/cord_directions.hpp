// Which way the cords of a layer run in each element.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "physics/solid/materials/cords.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::solid {

// Unit vector of a family in an element, in the reference configuration. Throws std::invalid_argument where the layer
// has no such direction: an element on the axis, a reference direction along the normal.
std::array<double, 3> cord_direction(const Mesh<3>& mesh, ElementIndex element, const LayerFrame& layer, double angle);

// For packs of these members: [pack][family].
std::shared_ptr<const std::vector<CordDirection<Lane>>> cord_directions(const Mesh<3>& mesh,
                                                                        const std::vector<ElementIndex>& members,
                                                                        const Material& material);

}  // namespace aquagraph::solid
