#include "physics/solid/element_group.hpp"

#include <stdexcept>
#include <type_traits>

#include "physics/solid/cord_directions.hpp"
#include "physics/solid/volume_element_laws.hpp"

namespace aquagraph::solid {

template <int D>
std::unique_ptr<ElementGroup<D>> make_element_group(const Mesh<D>& mesh, std::vector<ElementIndex> members,
                                                    const Material& material, const Options<D>& options) {
    const double E = material.youngs_modulus, nu = material.poissons_ratio;
    const bool plane_stress = D == 2 && options.plane == PlaneCondition::stress;
    const auto make = [&](const auto& law) { return volume_elements(mesh, std::move(members), law, options); };
    const auto make_rubber = [&](const auto& law) {
        if constexpr (D == 3) {
            if (!material.cords.empty()) {
                auto directions = cord_directions(mesh, members, material);
                return make(CordReinforced<std::remove_cvref_t<decltype(law)>>{law, material.cords.size(),
                                                                               std::move(directions)});
            }
        }
        return make(law);
    };
    if (!material.cords.empty() &&
        (D == 2 || (material.law != MaterialLaw::neo_hookean && material.law != MaterialLaw::mooney_rivlin)))
        throw std::invalid_argument("cords are there in three dimensions, in neo-Hookean or Mooney-Rivlin rubber");
    switch (material.law) {
        case MaterialLaw::saint_venant_kirchhoff:
            if constexpr (D == 2)
                if (plane_stress) return make(SaintVenantKirchhoff<2>::plane_stress(E, nu));
            return make(SaintVenantKirchhoff<D>::solid(E, nu));
        case MaterialLaw::linear:
            if constexpr (D == 2)
                if (plane_stress) return make(LinearElastic<2>::plane_stress(E, nu));
            return make(LinearElastic<D>::solid(E, nu));
        case MaterialLaw::neo_hookean:
            if (plane_stress)
                throw std::invalid_argument(
                    "the neo-Hookean law is there in plane strain only; in plane stress use saint_venant_kirchhoff");
            return make_rubber(NeoHookean<D>::solid(E, nu));
        case MaterialLaw::mooney_rivlin:
            if (plane_stress)
                throw std::invalid_argument(
                    "the Mooney-Rivlin law is there in plane strain only; in plane stress use saint_venant_kirchhoff");
            return make_rubber(MooneyRivlin<D>{material.c10, material.c01, material.bulk_modulus});
        case MaterialLaw::uniaxial_curve:
            if (plane_stress) throw std::invalid_argument("a uniaxial curve is there in plane strain only");
            return make(UniaxialCurve<D>::solid(material.curve, nu));
    }
    throw std::invalid_argument("there is no such material law");
}

template std::unique_ptr<ElementGroup<2>> make_element_group(const Mesh<2>&, std::vector<ElementIndex>, const Material&,
                                                             const Options<2>&);
template std::unique_ptr<ElementGroup<3>> make_element_group(const Mesh<3>&, std::vector<ElementIndex>, const Material&,
                                                             const Options<3>&);

}  // namespace aquagraph::solid
