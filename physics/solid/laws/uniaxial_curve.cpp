#include "physics/solid/law_elements.hpp"

namespace aquagraph::solid {

template std::unique_ptr<ElementGroup<2>> volume_elements(const Mesh<2>&, std::vector<ElementIndex>,
                                                          const UniaxialCurve<2>&, const Options<2>&);
template std::unique_ptr<ElementGroup<3>> volume_elements(const Mesh<3>&, std::vector<ElementIndex>,
                                                          const UniaxialCurve<3>&, const Options<3>&);

}  // namespace aquagraph::solid
