// Ghost particles: fluid mirrored through walls at every substep (thesis 2.5.1.1, (2.77), (2.78)).
//
// A particle at x_j in front of panel k (start a, normal n, wall velocity v_w at the foot of the perpendicular) has the
// ghost
//     x_G = x_j - 2 ((x_j - a)·n) n,     p_G = p_j + ρ_j g·(x_G - x_j),   ω_G = ω_j,
//     free slip  v_G = v_j + 2 ((v_w - v_j)·n) n,     no slip  v_G = 2 v_w - v_j,
// and the mirrored gradients, so that reconstruction works across the wall as it does inside. Corners that the fluid
// fills to less than 180° also reflect through their point. Which panel mirrors which particle is decided when the
// neighbour lists are built; positions and states follow parents and panels at every substep.
#pragma once
#include <array>

#include "physics/fluid/walls/visibility.hpp"

namespace aquagraph::fluid {

struct Escape {
    std::size_t particle = 0;  // the one furthest behind a wall that mirrors it
    double depth = 0;          // how far behind [m]; 0: none is
    int panel = -1;
};

class GhostWalls {
  public:
    Panels<2> panels;
    std::vector<Ghost> ghosts;
    std::vector<Corner> corners;
    std::vector<int> patch;
    PanelGrid grid;
    Visibility visibility;

    // Decides which panels mirror which particles within `reach`, sorts the ghosts in space, makes room for them in
    // `particles` and places them. Particles up to half a spacing behind a panel still count as in front of it.
    void rebuild(Particles<2>& particles, double spacing, double reach, const Vec2& gravity);

    // Panel geometry and corners after the vertices have moved.
    void update_geometry();

    std::size_t blocks() const { return (ghosts.size() + ghosts_per_block - 1) / ghosts_per_block; }
    // Positions, velocities, pressures, volumes, impedances of the ghosts of one block, from their parents.
    void update_state(Particles<2>& particles, const Vec2& gravity, std::size_t block) const;
    // Their gradients, from their parents'.
    void update_gradients(Particles<2>& particles, const Vec2& gravity, std::size_t block) const;
    // A particle alone, a drop of one, has nobody to push against: its own ghost comes arbitrarily close and repels it
    // arbitrarily little. Parents that have come to lie behind their panel are put back onto it and lose the velocity
    // towards it, like a sticky impact. Resolved flow never gets there. Returns how many; deeper than half a spacing
    // is left to deepest() and is an error.
    std::size_t hold_back(Particles<2>& particles, double spacing) const;
    // The deepest parent behind its panel.
    Escape deepest(const Particles<2>& particles) const;

  private:
    static constexpr std::size_t ghosts_per_block = 1024;
    // x_G = origin + S (x_j - origin), v_G = T v_j + (1 - T) v_w
    struct Mirror {
        Vec2 image, wall_velocity;
        Eigen::Matrix2d S, T;
    };
    Mirror mirror(const Particles<2>& particles, const Ghost& ghost) const;
    void collect(const Particles<2>& particles, double spacing, double reach);
    bool sticks_out(const Particles<2>& particles, const Ghost& ghost, const Vec2& image) const;

    double least_depth_ = 0;  // ghosts stay at least this far behind the panel [m]
    SpatialOrder<2> order_;
    Vectors<2> image_;
    std::vector<Ghost> unsorted_;
};

}  // namespace aquagraph::fluid
