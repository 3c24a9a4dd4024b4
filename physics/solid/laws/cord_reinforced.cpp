#include "physics/solid/law_elements.hpp"

namespace aquagraph::solid {

template std::unique_ptr<ElementGroup<3>> volume_elements(const Mesh<3>&, std::vector<ElementIndex>,
                                                          const CordReinforced<NeoHookean<3>>&, const Options<3>&);
template std::unique_ptr<ElementGroup<3>> volume_elements(const Mesh<3>&, std::vector<ElementIndex>,
                                                          const CordReinforced<MooneyRivlin<3>>&, const Options<3>&);

}  // namespace aquagraph::solid
