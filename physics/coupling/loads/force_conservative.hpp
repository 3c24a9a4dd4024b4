// The force-conservative load (thesis (5.40)-(5.42)): what the fluid exerts on panel k is minus the boundary terms of
// its momentum equation,
//     F_k = - Σ_{ghosts j of k} Σ_i [force on i from j] = Σ_i Σ_j 2 p_e ∇W_ij ω_i ω_j,
// and in viscous water the viscous part of the same pairs, so that the total on the body is exactly minus the total
// that the body exerts on the fluid. A ghost's share goes to the two ends of its panel by linear shape functions at the
// foot of its perpendicular; the wall velocity that the fluid sees is interpolated with the same functions, so force
// and velocity are conjugate. Where a body stands on a floor, the corner between them moves along the floor alone, and
// what its ghosts exert across the floor is left to the floor.
//
// Sums run around ghosts here, the other way round than in the flux pass; pairs are the same, with the same masks.
#pragma once
#include <vector>

#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"

namespace aquagraph::coupling {

using fluid::Vec2;

class ForceConservativeLoad {
  public:
    // Collects the pairs that cross wet panels, after the neighbour lists have been built.
    void rebuild(const fluid::Particles<2>& particles, const fluid::NeighbourLists<2>& lists,
                 const fluid::GhostWalls<2>& walls, BlockLoop loop);

    // Clusters of fluid particles whose gradients the load reads, ascending.
    const std::vector<std::uint32_t>& clusters() const { return clusters_; }
    std::size_t blocks() const { return (sources_.size() + sources_per_block - 1) / sources_per_block; }
    std::uint64_t pairs() const { return fluid_.size(); }

    // The forces of the ghosts of one block. Reads states and gradients of particles and ghosts.
    void compute(const fluid::Fluid<2>& fluid, std::size_t block);
    // Adds them up at the vertices of the panels [N] (per metre of depth in 2D), in a fixed order.
    void spread(const fluid::Particles<2>& particles, const fluid::GhostWalls<2>& walls,
                std::vector<Vec2>& vertex_forces) const;

  private:
    static constexpr std::size_t sources_per_block = 64;
    struct Source {
        std::uint32_t ghost;
        std::int32_t panel;        // that gets its force
        std::uint32_t begin, end;  // into fluid_
    };
    struct Pair {
        std::uint32_t ghost, fluid;
        std::int32_t panel;
    };
    void mark_wet_clusters(const fluid::GhostWalls<2>& walls);
    void collect(const fluid::Particles<2>& particles, const fluid::NeighbourLists<2>& lists,
                 const fluid::GhostWalls<2>& walls, std::size_t block, std::vector<Pair>& pairs) const;

    std::vector<Source> sources_;
    std::vector<Vec2> force_;  // of each source
    std::vector<std::uint32_t> fluid_, clusters_;
    std::vector<std::vector<Pair>> pairs_of_block_;
    std::vector<Pair> pairs_;
    std::vector<std::uint8_t> needed_;
    std::vector<std::uint8_t> is_wet_cluster_;  // of ghosts: one of them at least belongs to a wet panel
};

}  // namespace aquagraph::coupling
