// Which clusters each particle must visit.
//
// Lists hold clusters of W lanes, not particles (physics/fluid/particles.hpp): a pair loop computes all W pairs of an
// entry, and lanes outside the support contribute zero. They reach R + skin, so that they stay valid until some
// particle or wall has moved half the skin. An entry is "masked" where a wall hides some of its lanes from the particle
// (walls/visibility.hpp); the others, nearly all, are "open".
//
// The order of particles is refreshed together with the lists: columns of about sqrt(W) Δx, each sorted along the last
// direction, every second one backwards, so that W consecutive particles always form a compact cluster.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

struct NeighbourBlock {
    struct Entries {
        std::uint32_t open_end, masked_end;  // where this particle's entries end in `open` and `masked`
    };
    std::vector<Entries> particle;      // one per lane of the block, plus a leading {0, 0}
    std::vector<std::uint32_t> open;    // clusters all of whose lanes may be seen
    std::vector<std::uint32_t> masked;  // clusters with hidden lanes …
    std::vector<std::uint8_t> mask;     // … and which lanes are seen
    std::uint64_t pairs = 0;            // pairs closer than R when the lists were built
};

template <int D>
struct NeighbourLists {
    double radius = 0;  // R [m]
    double skin = 0;    // [m]
    double reach() const { return radius + skin; }
    std::vector<NeighbourBlock> blocks;  // particles.blocks() of them
    std::uint64_t pairs() const;         // directed pairs closer than R, ghosts included
};

// Hides lanes from particles near walls. lanes_seen gets W squared distances-in-reach bits and returns those that the
// particle may see.
template <int D>
class PairFilter {
  public:
    virtual ~PairFilter() = default;
    // True if nothing is hidden from particle i: then lanes_seen need not be called for it.
    virtual bool sees_everything(std::size_t i) const = 0;
    virtual std::uint8_t lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const = 0;
};

// Order of the particles, see above. order[k] = present index of the particle that goes to place k.
template <int D>
class SpatialOrder {
  public:
    // Positions x of the first n lanes; `spacing` is the typical distance between particles.
    std::span<const std::uint32_t> sort(const Vectors<D>& x, std::size_t n, double spacing);

  private:
    std::vector<std::uint32_t> order_, column_start_, column_of_;
};

// Applies an order to everything a fluid particle carries (positions, velocities, deviation, mass, id).
template <int D>
class Reorder {
  public:
    void apply(Particles<D>& particles, std::span<const std::uint32_t> order);

  private:
    Scalars buffer_;
    AlignedVector<std::int64_t> id_buffer_;
};

// Cell grid over all lanes, fluid and ghosts, and the lists made from it.
template <int D>
class NeighbourSearch {
  public:
    // Fills lists.blocks. `filter` may be null. Positions must be finite.
    void build(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter, BlockLoop loop);

  private:
    using Cell = std::array<std::int32_t, D>;
    void bin(const Particles<D>& particles, double reach);
    Cell cell_of(const Particles<D>& particles, std::size_t lane) const;
    std::size_t index(const Cell& cell) const;
    void build_block(const Particles<D>& particles, NeighbourLists<D>& lists, const PairFilter<D>* filter,
                     std::size_t block) const;

    std::array<double, D> origin_{};
    double inverse_cell_ = 0;
    Cell cells_{};
    std::vector<std::uint32_t> cell_start_;  // CSR: clusters with a lane in each cell
    std::vector<std::uint32_t> cell_clusters_;
};

// Largest displacement since the lists were built, over the fluid particles of one block [m], squared.
template <int D>
double largest_displacement_squared(const Particles<D>& particles, std::size_t block);

extern template struct NeighbourLists<2>;
extern template struct NeighbourLists<3>;
extern template class SpatialOrder<2>;
extern template class SpatialOrder<3>;
extern template class Reorder<2>;
extern template class Reorder<3>;
extern template class NeighbourSearch<2>;
extern template class NeighbourSearch<3>;

}  // namespace aquagraph::fluid
