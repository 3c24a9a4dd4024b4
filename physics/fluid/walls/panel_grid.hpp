// Which panels and corners are near a place, in 2D and 3D.
#pragma once
#include "physics/fluid/periodic.hpp"
#include "physics/fluid/walls/corners.hpp"

namespace aquagraph::fluid {

// Cells as wide as the reach. In a periodic domain panels near its edge are registered beyond the opposite one as well,
// as copies (Periodic::shift).
template <int D>
class PanelGrid {
  public:
    struct Cell {
        std::vector<int> panel, patch;
        std::vector<std::uint8_t> copy;  // of the panel
        std::vector<int> corner;         // corners within reach …
        std::vector<std::uint8_t> corner_copy;
        // What the sight test reads. 2D: start, tangent, length; 3D: plane (n, o) and two shape functions (u, u0, v,
        // v0).
        std::array<Scalars, D == 2 ? 5 : 12> sight;
        bool convex_room = false;  // nothing here hides anything
        bool one_patch = false;    // one smooth surface alone, and no ghost sticks out of another
        bool wet = false;          // some panel is wet

        void clear();
    };
    struct Crossing {
        int entry = -1;    // index into the cell's arrays; -1: the line of sight meets no panel
        double along = 2;  // 0 at its start, 1 at its end
    };

    // Registers every panel in the cells within `reach` of it. In 3D only cells near the particles are made: walls may
    // be much larger than the water. Nothing is done while panels stand still and particles stay where there are cells.
    // Returns whether anything was.
    bool build(const Panels<D>& panels, const std::vector<int>& patch, double reach, const Periodic<D>& periodic,
               const Particles<D>& particles);
    // What a build has found out and later ones keep, for a checkpoint: once read, the next build takes it over.
    template <class Archive>
    void archive(Archive& fields) {
        fields(covered_low_, covered_high_);
        covered_is_given_ = fields.reads();
    }
    // True if the panels stand where they were registered.
    bool knows(const Panels<D>& panels) const { return position_ == panels.position; }
    // Registers corners, once a build has been made.
    void add_corners(const std::vector<Corner<D>>& corners);
    // The cell at x, or null where no panel is within reach.
    const Cell* at(const Vec<D>& x) const;
    // Something near x must be looked at closely, although no panel may be within reach: its cell hides things from
    // now until the next build.
    void look_closely_around(const Vec<D>& x, const Panels<D>& panels);
    // Forgets what look_closely_around has said.
    void look_as_built();
    // Entries of a cell whose panels may be within reach of x, into `nearby`.
    void gather(const Cell& cell, const Panels<D>& panels, const Vec<D>& x, Cell& nearby) const;
    // Around x, in this cell, is no panel closer than this: the distance itself in 2D, no more than it in 3D; at most
    // the reach [m].
    double clearance(const Cell& cell, const Panels<D>& panels, const Vec<D>& x) const;
    // The first panel that the segment from a to b crosses, panels of one patch left out if wanted. The ends may lie
    // anywhere.
    static Crossing first_crossing(const Cell& cell, const Vec<D>& a, const Vec<D>& b, int patch_left_out = -1);

    // True if the normals stay within 45° of their mean.
    static bool turns_little(const Cell& cell, const Panels<D>& panels);

  private:
    using Index = Eigen::Matrix<int, D, 1>;
    int new_cell();
    std::size_t index(const Index& cell) const;
    Index index_at(const Vec<D>& x) const;  // clamped to the grid
    template <class F>
    void each_cell(const Index& first, const Index& last, F&& f) const;
    // Calls f for the cells within reach of a segment or triangle that is moved by `shift`.
    template <class F>
    void each_cell_near(const Vec<D>* corner, std::size_t corners, const Vec<D>& shift, F&& f);
    void add(Cell& cell, const Panels<D>& panels, std::size_t k, int patch, int copy) const;
    void fill_sight(Cell& cell, const Panels<D>& panels) const;
    bool is_convex_room(const Cell& cell, const Panels<D>& panels) const;

    double reach_ = 0, inverse_width_ = 0;
    Vec<D> origin_ = Vec<D>::Zero();
    Index cells_along_ = Index::Zero();
    std::vector<Cell> cells_;  // the first used_ of them; the others keep their memory for the next build
    std::size_t used_ = 0, built_ = 0;
    std::vector<int> index_;  // which cell, or -1
    struct Before {
        std::size_t cell;
        bool convex_room, one_patch;
    };
    std::vector<std::size_t> added_;  // by look_closely_around: places in index_ …
    std::vector<Before> closely_;     // … and what cells were before

    Periodic<D> periodic_;
    std::vector<double> radius_;                                           // around each panel's centroid
    std::vector<Vec<D>> position_;                                         // of the panels' vertices, as registered
    Vec<D> covered_low_ = Vec<D>::Zero(), covered_high_ = Vec<D>::Zero();  // particles may be here
    bool covered_is_given_ = false;                                        // by archive()
};

extern template class PanelGrid<2>;
extern template class PanelGrid<3>;

}  // namespace aquagraph::fluid
