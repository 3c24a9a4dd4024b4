// Ghost particles: fluid mirrored through walls at every substep (thesis 2.5.1.1, (2.77), (2.78)), and the images of
// fluid in a periodic domain.
//
// A particle at x_j in front of panel k (start a, normal n, wall velocity v_w at the foot of the perpendicular) has the
// ghost
//     x_G = x_j - 2 ((x_j - a)·n) n,     p_G = p_j + ρ_j g·(x_G - x_j),   ω_G = ω_j,
//     free slip  v_G = v_j + 2 ((v_w - v_j)·n) n,     no slip  v_G = 2 v_w - v_j,
// and the mirrored gradients, so that reconstruction works across the wall as it does inside. Corners that the fluid
// fills to less than 180° also reflect through their point, edges rotate by 180° about their line (walls/corners.hpp).
// Behind convex edges two ghosts share every place (walls/edge_shares.hpp): ω_G = w ω_j there.
// A particle has one ghost per flat facet, however many triangles it is made of. Which panels mirror which particles is
// decided when the neighbour lists are built; positions and states follow parents and panels at every substep.
//
// In a periodic domain particles and ghosts near its edge also appear, shifted by a period, beyond the opposite one.
// Where two walls of such a domain meet across its edge at an angle, no corner is made: let flat walls end there.
#pragma once
#include <array>
#include <span>

#include "physics/block_loop.hpp"
#include "physics/fluid/spatial_order.hpp"
#include "physics/fluid/walls/escape.hpp"
#include "physics/fluid/walls/visibility.hpp"

namespace aquagraph::fluid {

template <int D>
class GhostWalls {
  public:
    Panels<D> panels;      // none where walls are of another kind: then ghosts are periodic images alone
    Periodic<D> periodic;  // set before the first rebuild
    std::vector<Ghost> ghosts;
    std::vector<Corner<D>> corners;
    EdgeShares<D> shares;
    std::vector<int> patch;  // smooth patch of each panel
    PanelGrid<D> grid;
    Visibility<D> visibility;

    // Decides which panels mirror which particles within `reach`, sorts the ghosts in space, makes room for them in
    // `particles` and places them. Particles up to half a spacing behind a panel still count as in front of it.
    // Throws std::invalid_argument if a period is shorter than the reach.
    void rebuild(Particles<D>& particles, double spacing, double reach, const Vec<D>& gravity,
                 BlockLoop loop = serial_loop);

    // For a checkpoint. Everything else is made by rebuild() and update_geometry().
    template <class Archive>
    void archive(Archive& fields) {
        fields(panels.position, panels.velocity, grid);
    }

    // Panel geometry and corners after the vertices have moved.
    void update_geometry();

    std::size_t blocks() const { return (ghosts.size() + ghosts_per_block - 1) / ghosts_per_block; }
    // Positions, velocities, pressures, volumes, impedances of the ghosts of one block, from their parents.
    void update_state(Particles<D>& particles, const Vec<D>& gravity, std::size_t block) const;
    // Their gradients, from their parents'.
    void update_gradients(Particles<D>& particles, const Vec<D>& gravity, std::size_t block) const;
    // δv of periodic images, from their parents'; through walls nothing is shifted.
    void update_shift(Particles<D>& particles, std::size_t block) const;
    // A particle alone, a drop of one, has nobody to push against: its own ghost comes arbitrarily close and repels it
    // arbitrarily little. Parents that have come to lie behind their panel are put back onto it and lose the velocity
    // towards it, like a sticky impact. Resolved flow never gets there. Returns how many; deeper than half a spacing
    // is left to deepest() and is an error.
    std::size_t hold_back(Particles<D>& particles, double spacing) const;
    // The deepest parent behind its panel.
    Escape deepest(const Particles<D>& particles) const;
    // Whether particle i was within `reach`, that of the last rebuild, of a panel or a seam of a periodic domain then,
    // and whether it is now within `reach` of where they stood.
    bool was_near(const Particles<D>& particles, std::size_t i, double reach) const;
    bool is_near(const Particles<D>& particles, std::size_t i, double reach) const;
    // Where a ghost's parent stands before the panel or corner: shifted by a period if the wall's copy mirrors it.
    Vec<D> before_wall(const Particles<D>& particles, const Ghost& ghost) const;

  private:
    // So that a small scene keeps two threads busy.
    static constexpr std::size_t ghosts_per_block = 256, particles_per_part = 256;
    // x_G = origin + S (x_j - origin), v_G = T v_j + (1 - T) v_w
    struct Mirror {
        Vec<D> image, wall_velocity;
        Mat<D> S, T;
    };
    bool is_near(const Vec<D>& x, double reach) const;
    Mirror mirror(const Vec<D>& x, const Ghost& ghost) const;
    Mirror mirror_at_corner(const Vec<D>& x, const Corner<D>& corner) const;
    Vec<D> place(const Particles<D>& particles, const Ghost& ghost) const;
    void find_shares(const Particles<D>& particles);
    struct ByFacet {  // of the particle at hand
        int facet, copy;
        double inside;  // smallest shape function at the foot
        std::size_t ghost;
    };
    struct Part {  // of the particles: what mirrors them
        std::vector<Ghost> ghosts;
        std::vector<ByFacet> mirrored_by;
    };
    void collect(const Particles<D>& particles, double spacing, double reach, BlockLoop loop);
    void collect_panels(std::size_t j, const Vec<D>& x, const typename PanelGrid<D>::Cell& cell, double spacing,
                        double reach, Part& part) const;
    bool mirrors_already(std::span<const Ghost> of_particle, const Vec<D>& x, const Ghost& ghost, double spacing) const;
    void collect_corners(std::size_t j, const Vec<D>& x, const typename PanelGrid<D>::Cell& cell, double spacing,
                         double reach, std::vector<Ghost>& found) const;
    void collect_images(const Particles<D>& particles, const Ghost& ghost, double reach,
                        std::vector<Ghost>& found) const;
    void place_images(const Particles<D>& particles, BlockLoop loop);
    bool owns(std::size_t panel, const Vec<D>& x) const;
    void find_owners(double spacing, double reach);
    // Where an image lies: behind its wall, or beyond another side of the body behind it. `open_room`: the grid knows
    // of nothing there that could be crossed.
    enum class Side : std::uint8_t { behind, open_room, beyond };
    Side side_of(const Particles<D>& particles, const Ghost& ghost, const Vec<D>& image) const;
    bool is_held_by(std::size_t panel, const Vec<D>& x) const;

    double least_depth_ = 0;  // ghosts stay at least this far behind the panel [m]
    double corner_slack_ = 0;
    SpatialOrder<D> order_;
    std::vector<Part> parts_;
    std::vector<Ghost> unsorted_;  // those of all parts, in order; and of each
    Vectors<D> image_;
    std::vector<Side> side_;
    // In 3D: flat facets, where shape functions must lie for a panel to own a foot, and sides beyond which the smooth
    // surface goes on.
    std::vector<int> facet_;
    std::vector<std::array<double, D>> owned_from_;
    std::vector<std::array<bool, D>> goes_on_;
};

extern template class GhostWalls<2>;
extern template class GhostWalls<3>;

}  // namespace aquagraph::fluid
