// Whether neighbour lists still hold although particles have gone further than half the skin.
//
// A pair that is not listed was further apart than R + skin when the lists were made, and matters once it is closer
// than R: its particles have then moved against each other by more than the skin. Water that moves together does not do
// that, however fast it is. So groups of particles (clusters, or single particles where a cluster's lie far apart) are
// compared with those that were near them, within R + skin + margin: each moves like its centre c, but for a radius r,
//     |c_a - c_b| + r_a + r_b < skin     at the end of the coming step, r with all that accelerations may add.
// Groups that were further apart need more than skin + margin, which the largest displacement of all tells.
// Near walls it is not particles alone that move against each other: there a particle's own way counts, as before.
#pragma once
#include <cstdint>
#include <vector>

#include "physics/fluid/neighbour_search.hpp"
#include "physics/fluid/travel.hpp"

namespace aquagraph::fluid {

// What walls, or the seams of a periodic domain, say about particles near them.
struct NearWalls {
    // True if particle i was within R + skin of one when the lists were made.
    FunctionRef<bool(std::size_t i)> was_near;
    // False if particle i, as it stands now, is further than R + skin from where they were then.
    FunctionRef<bool(std::size_t i)> may_be_near;
};

// A step Δt [s] at whose end walls will have moved at most by walls_moved [m] since the lists were made.
struct ComingStep {
    double dt, walls_moved;
};

template <int D>
class RelativeTravel {
  public:
    // How much further than R + skin groups are looked at, over R: what is not looked at holds for (skin + margin)/2 of
    // displacement. In 3D their number grows with the cube of that distance.
    static constexpr double margin_ratio = D == 2 ? 1.0 : 0.25;

    // To be called when lists have been made.
    void lists_are_new() { near_known_ = groups_known_ = false; }

    // True if no pair can have come closer than R unlisted, until the end of the step. `grid` is that of the search
    // that has made the lists; walls may be null. When it is asked for the first time after that, it allocates.
    bool holds(const Particles<D>& particles, const ClusterGrid<D>& grid, const NeighbourLists<D>& lists,
               const Travel& travel, const ComingStep& coming, const NearWalls* walls, BlockLoop loop);

    std::size_t bytes() const;

  private:
    struct Motion {  // of a group since the lists were made, at the end of the step [m]
        double centre[D];
        double radius;
    };
    struct Part {                               // of the groups
        std::vector<std::uint32_t> end, other;  // group k looks at other[end[k - 1]] … other[end[k] - 1], all behind it
        bool holds;
    };
    static constexpr std::size_t groups_per_part = 256;

    void find_near(const Particles<D>& particles, const NeighbourLists<D>& lists, const NearWalls& walls,
                   BlockLoop loop);
    bool walls_hold(const Particles<D>& particles, double skin, const ComingStep& coming, const NearWalls& walls,
                    BlockLoop loop);
    bool groups_hold(const Particles<D>& particles, const ClusterGrid<D>& grid, double skin, double dt, BlockLoop loop);
    void find_groups(const ClusterGrid<D>& grid, double reach, BlockLoop loop);
    static Motion motion(const Particles<D>& particles, LaneRange lanes, double dt);

    std::vector<std::uint8_t> near_;  // a wall, of each particle
    std::vector<std::uint8_t> block_holds_;
    std::vector<Part> parts_;
    std::vector<Motion> motions_;
    bool near_known_ = false, groups_known_ = false;
};

extern template class RelativeTravel<2>;
extern template class RelativeTravel<3>;

}  // namespace aquagraph::fluid
