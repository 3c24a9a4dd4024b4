// Which pairs a wall keeps apart, in 2D.
//
// - Two fluid particles do not see each other through a panel (the two sides of a thin body).
// - A ghost that panel k has mirrored is seen by those particles whose line of sight to it enters the wall through k's
//   smooth patch: every place behind a wall is then seen once, however thin the body and at convex corners too.
//   The way that the wall reflects this line of sight must lead to the ghost's parent without meeting another patch:
//   water beyond a plate that stands on a floor is not seen in the floor before it.
// - A corner's ghost is seen through either of the corner's patches, from in front of both.
// - A ghost that sticks out of the other side of a thin body is seen by nobody there.
//
// Particles that have slid behind a panel by less than half a spacing are treated as being just in front of it.
#pragma once
#include "physics/fluid/neighbour_lists.hpp"
#include "physics/fluid/walls/corners.hpp"

namespace aquagraph::fluid {

struct Ghost {
    std::uint32_t parent;      // fluid particle that is mirrored
    std::int32_t panel;        // by this panel, or -1 …
    std::int32_t corner = -1;  // … through this corner
};

// Panels<2> near a place, in the form that the sight test reads: one entry per panel within reach of the cell.
class PanelGrid {
  public:
    struct Cell {
        std::vector<int> panel;
        Scalars x, y, tx, ty, length;  // start, tangent, length of each
        std::vector<int> patch;
        bool convex_room = false;  // one straight patch or concave corners only: nothing hides anything
        bool wet = false;          // some panel is wet

        void clear();
        void add(const Panels<2>& panels, std::size_t k, int patch_of_k);
    };
    struct Crossing {
        int entry = -1;    // index into the cell's arrays; -1: the line of sight meets no panel
        double along = 2;  // 0 at its start, 1 at its end
    };

    // Registers every panel in the cells within `reach` of it.
    void build(const Panels<2>& panels, const std::vector<int>& patch, double reach);
    // The cell at x, or null where no panel is within reach.
    const Cell* at(double x, double y) const;
    // Something near x must be looked at closely, although no panel may be within reach: its cell hides things from
    // now.
    void look_closely_around(const Vec2& x);
    // The first panel that the segment from a to b crosses, panels of one patch left out if wanted. The ends may lie
    // anywhere.
    static Crossing first_crossing(const Cell& cell, const Vec2& a, const Vec2& b, int patch_left_out = -1);

  private:
    int new_cell();
    double inverse_width_ = 0;
    Vec2 origin_ = Vec2::Zero();
    int nx_ = 0, ny_ = 0;
    std::vector<Cell> cells_;  // the first used_ of them; the others keep their memory for the next build
    std::size_t used_ = 0;
    std::vector<int> index_;  // nx × ny: which cell, or -1
};

class Visibility : public PairFilter<2> {
  public:
    // Prepares for the particles and ghosts as they stand. The arguments must outlive the last call of lanes_seen.
    void prepare(const Particles<2>& particles, const Panels<2>& panels, const PanelGrid& grid,
                 const std::vector<Ghost>& ghosts, const std::vector<Corner>& corners, const std::vector<int>& patch,
                 double tolerance);
    bool sees_everything(std::size_t i) const override;
    std::uint8_t lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const override;
    // The panel through which particle i sees ghost g, or -1 (no panel between them, or not seen).
    int entry_panel(std::size_t i, std::size_t ghost) const;
    // Where particle i is taken to be: in front of the panels that it touches.
    const Vec2& place(std::size_t i) const { return place_[i]; }

  private:
    bool sees(std::size_t i, const PanelGrid::Cell& cell, std::size_t lane, int* entry) const;
    const Particles<2>* particles_ = nullptr;
    const Panels<2>* panels_ = nullptr;
    const PanelGrid* grid_ = nullptr;
    const std::vector<Ghost>* ghosts_ = nullptr;
    const std::vector<Corner>* corners_ = nullptr;
    const std::vector<int>* patch_ = nullptr;
    std::vector<Vec2> place_;
    std::vector<const PanelGrid::Cell*> cell_;  // of each fluid particle
};

}  // namespace aquagraph::fluid
