// Which pairs a wall keeps apart.
//
// - Two fluid particles do not see each other through a panel (the two sides of a thin body), unless their line of
// sight
//   only cuts off an edge of a body that fills more than 60° there: the support goes round it. Periodic images of fluid
//   particles are seen like fluid.
// - A ghost that panel k has mirrored is seen by those particles whose line of sight to it enters the wall through k's
//   smooth patch: every place behind a wall is then seen once, however thin the body and at convex corners too.
//   The way that the wall reflects this line of sight must lead to the ghost's parent without meeting another patch:
//   water beyond a plate that stands on a floor is not seen in the floor before it.
// - Behind an edge whose two sides share what lies there (walls/edge_shares.hpp) a ghost of either is seen through
// both.
// - A corner's ghost is seen through any of the corner's patches, from in front of all of them; that of an edge in 3D
// if
//   the line of sight, mirrored by one of the edge's panels, reaches the other before anything else.
// - A ghost that sticks out of the other side of a thin body is seen by nobody there.
//
// Particles that have slid behind a panel by less than half a spacing are treated as being just in front of it.
#pragma once
#include "physics/fluid/neighbour_search.hpp"
#include "physics/fluid/walls/edge_shares.hpp"
#include "physics/fluid/walls/panel_grid.hpp"

namespace aquagraph::fluid {

// The parent, brought to a copy of the panel or corner (walls/panel_grid.hpp), mirrored there, and all that brought to
// a copy of the domain.
struct Ghost {
    std::uint32_t parent;      // fluid particle that is mirrored
    std::int32_t panel;        // by this panel, or -1 …
    std::int32_t corner = -1;  // … through this corner, or -1: a mere periodic image
    std::uint8_t wall_copy = 0, copy = 0;
    bool is_image() const { return panel < 0 && corner < 0; }
};

template <int D>
class Visibility : public PairFilter<D> {
  public:
    // Prepares for the particles and ghosts as they stand. The arguments must outlive the last call of lanes_seen.
    void prepare(const Particles<D>& particles, const Panels<D>& panels, const PanelGrid<D>& grid,
                 const Periodic<D>& periodic, const std::vector<Ghost>& ghosts, const std::vector<Corner<D>>& corners,
                 const EdgeShares<D>& shares, const std::vector<int>& patch, double tolerance, BlockLoop loop);
    bool sees_everything(std::size_t i) const override;
    std::uint8_t lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const override;
    // The panel through which particle i sees ghost g, or -1 (no panel between them, or not seen).
    int entry_panel(std::size_t i, std::size_t ghost) const;
    // Where particle i is taken to be: in front of the panels that it touches.
    const Vec<D>& place(std::size_t i) const { return place_[i]; }

  private:
    using Cell = typename PanelGrid<D>::Cell;
    bool sees(std::size_t i, const Cell& cell, std::size_t lane, int* entry) const;
    bool reaches_other_side(std::size_t i, const Cell& cell, const Ghost& ghost, const Corner<D>& corner,
                            int other_panel, int entry_patch, const typename PanelGrid<D>::Crossing& crossing) const;
    bool goes_round_an_edge(const Cell& cell, int entry, const Vec<D>& target, const Vec<D>& from) const;
    void find_blunt_edges();
    void find_place(std::size_t i);
    const Particles<D>* particles_ = nullptr;
    const Panels<D>* panels_ = nullptr;
    const PanelGrid<D>* grid_ = nullptr;
    const Periodic<D>* periodic_ = nullptr;
    const std::vector<Ghost>* ghosts_ = nullptr;
    const std::vector<Corner<D>>* corners_ = nullptr;
    const EdgeShares<D>* shares_ = nullptr;
    const std::vector<int>* patch_ = nullptr;
    // The panels within reach of particle i, fewer than its cell's. Valid until the thread's next call.
    const Cell& panels_near(std::size_t i) const;
    // No line of sight between the places of two particles (or an image of one) is long enough to meet a panel.
    bool is_clear(std::size_t i, std::size_t j, const Vec<D>& target) const;

    std::vector<std::pair<int, int>> blunt_edges_;  // pairs of patches, the smaller first, ascending
    double tolerance_ = 0;
    std::uint64_t prepared_ = 0;  // counts, over all objects: tells a thread that what it has gathered is old
    std::vector<Vec<D>> place_;
    std::vector<const Cell*> cell_;  // of each fluid particle
    std::vector<double> clear_;      // around the place of each: no panel is closer [m]
};

extern template class Visibility<2>;
extern template class Visibility<3>;

}  // namespace aquagraph::fluid
