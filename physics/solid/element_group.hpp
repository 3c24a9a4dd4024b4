// Elements of one type and one material: internal forces F_int = ∫ P·∇N dV (total Lagrangian: over the reference
// configuration), their tangents, energy and stress. Elements lie in packs of `lanes`, one element per lane; the last
// pack is filled up with elements of no weight.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "physics/solid/lanes.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::solid {

// Lower triangle of an element's tangent by rows; row and column D a + i: node a, direction i.
constexpr std::size_t packed_index(std::size_t row, std::size_t column) {
    return row >= column ? row * (row + 1) / 2 + column : column * (column + 1) / 2 + row;
}

// One virtual call per range of packs, never per Gauss point. u: D × nodes.
template <int D>
class ElementGroup {
  public:
    virtual ~ElementGroup() = default;

    const std::vector<ElementIndex>& members() const { return members_; }  // of the mesh, in the order of the lanes
    std::size_t packs() const { return (members_.size() + lanes - 1) / lanes; }
    std::size_t node_count() const { return node_count_; }
    std::size_t rows() const { return D * node_count_; }                         // of an element's matrix
    std::size_t force_size() const { return rows() * lanes; }                    // of a pack: [row][lane]
    std::size_t matrix_size() const { return packed_index(rows(), 0) * lanes; }  // [packed_index][lane]

    // Packs [first, last): forces[force_size() p …] and the smallest det F [p] of each.
    virtual void internal_forces(std::span<const double> u, std::size_t first, std::size_t last,
                                 std::span<double> forces, std::span<double> smallest_J) const = 0;
    // matrices[matrix_size() p …]
    virtual void tangents(std::span<const double> u, std::size_t first, std::size_t last,
                          std::span<double> matrices) const = 0;
    // Strain energy of each pack [J].
    virtual void energies(std::span<const double> u, std::size_t first, std::size_t last,
                          std::span<double> energies) const = 0;
    // stress[members()[e]] [Pa]: von Mises equivalent of the Cauchy stress, mean of the element's Gauss points.
    virtual void von_mises(std::span<const double> u, std::span<double> stress) const = 0;

  protected:
    ElementGroup(std::vector<ElementIndex> members, std::size_t node_count)
        : members_(std::move(members)), node_count_(node_count) {}

  private:
    std::vector<ElementIndex> members_;
    std::size_t node_count_;
};

// The elements `members` of the mesh, all of one type, of this material. Throws std::invalid_argument for a law that
// there is not.
template <int D>
std::unique_ptr<ElementGroup<D>> make_element_group(const Mesh<D>& mesh, std::vector<ElementIndex> members,
                                                    const Material& material, const Options<D>& options);

}  // namespace aquagraph::solid
