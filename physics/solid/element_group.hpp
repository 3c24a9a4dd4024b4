// All elements of one material: internal forces F_int = ∫ P·∇N dV (total Lagrangian: over the reference configuration),
// their tangents, energy and stress. Gradients of the shape functions are computed once. Elements lie in packs of
// `lanes`, one element per lane, so that the loop over lanes vectorises; the last pack is filled up with elements of no
// weight.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "physics/solid/elements/quad8.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/solver.hpp"

namespace aquagraph::solid {

inline constexpr std::size_t lanes = 8;

// Element forces of a pack: [node 0..7][x, y][lane].
inline constexpr std::size_t pack_forces = quad8::node_count * 2 * lanes;

// Lower triangle of an element's 16 × 16 tangent by rows; row and column 2 a + i: node a, direction i.
inline constexpr std::size_t element_rows = 2 * quad8::node_count;
inline constexpr std::size_t packed_size = element_rows * (element_rows + 1) / 2;
constexpr std::size_t packed_index(std::size_t row, std::size_t column) {
    return row >= column ? row * (row + 1) / 2 + column : column * (column + 1) / 2 + row;
}

// One virtual call per range of packs, never per Gauss point. u: 2 × nodes.
class ElementGroup {
  public:
    virtual ~ElementGroup() = default;

    std::size_t elements() const { return elements_; }
    std::size_t packs() const { return (elements_ + lanes - 1) / lanes; }

    // Packs [first, last): forces[pack_forces p …] and the smallest det F [p] of each.
    virtual void internal_forces(std::span<const double> u, std::size_t first, std::size_t last,
                                 std::span<double> forces, std::span<double> smallest_J) const = 0;
    // Elements [first, last): matrices[packed_size e …].
    virtual void tangents(std::span<const double> u, std::size_t first, std::size_t last,
                          std::span<double> matrices) const = 0;
    virtual double energy(std::span<const double> u) const = 0;  // [J]
    virtual void von_mises(std::span<const double> u, std::span<double> stress) const = 0;

  protected:
    explicit ElementGroup(std::size_t elements) : elements_(elements) {}

  private:
    std::size_t elements_;
};

// The law that the options ask for. Throws std::invalid_argument for one that there is not.
std::unique_ptr<ElementGroup> make_element_group(const Mesh& mesh, const Options& options);

}  // namespace aquagraph::solid
