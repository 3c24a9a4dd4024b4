// The elements of one law, of whatever type: what a source file in laws/ compiles.
#pragma once
#include "physics/solid/enhanced_elements.hpp"
#include "physics/solid/volume_element_laws.hpp"
#include "physics/solid/volume_elements.hpp"

namespace aquagraph::solid {

template <int D, class Law>
std::unique_ptr<ElementGroup<D>> volume_elements(const Mesh<D>& mesh, std::vector<ElementIndex> members, const Law& law,
                                                 const Options<D>& options) {
    const std::size_t nodes = mesh.elements[std::size_t(members.front())].size();
    const double thickness = D == 2 ? options.thickness : 1;
    return with_element_type<D>(nodes, [&]<class Type>(Type) -> std::unique_ptr<ElementGroup<D>> {
        if constexpr (std::is_same_v<Type, Multilinear<D>>)
            if (options.linear_elements == LinearElements::enhanced)
                return std::make_unique<EnhancedElements<D, Law>>(mesh, std::move(members), law, thickness);
        return std::make_unique<VolumeElements<Type, Law>>(
            mesh, std::move(members), law, thickness,
            options.integration == Integration::full ? Type::mass_rule() : Type::stiffness_rule());
    });
}

}  // namespace aquagraph::solid
