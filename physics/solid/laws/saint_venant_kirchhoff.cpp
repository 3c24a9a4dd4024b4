#include "physics/solid/volume_element_laws.hpp"
#include "physics/solid/volume_elements.hpp"

namespace aquagraph::solid {

template std::unique_ptr<ElementGroup<2>> volume_elements(const Mesh<2>&, std::vector<ElementIndex>,
                                                          const SaintVenantKirchhoff<2>&, double);
template std::unique_ptr<ElementGroup<3>> volume_elements(const Mesh<3>&, std::vector<ElementIndex>,
                                                          const SaintVenantKirchhoff<3>&, double);

}  // namespace aquagraph::solid
