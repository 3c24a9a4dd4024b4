// The force of the fluid on single walls of ghosts: minus the boundary terms of the momentum equation (thesis (5.40)),
//     F_w = - Σ_i Σ_{ghosts j of w} [force on i from j],
// found by the scheme's own flux pass, and in viscous water by its viscosity, over lists that hold the ghosts of this
// wall and nothing else, so that it is what the fluid feels whatever the scheme. The forces of all walls, the fluid's
// weight and its rate of momentum balance to rounding. A ghost of a corner between two walls belongs to the one through
// which it is seen.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "physics/fluid/fluid.hpp"
#include "physics/fluid/walls/ghosts.hpp"

namespace aquagraph::fluid {

template <int D>
class WallForces {
  public:
    // wall: index into Panels::names.
    explicit WallForces(int wall) : wall_(wall) {}
    int wall() const { return wall_; }

    // Collects the pairs of the present neighbour lists. Does nothing if they are those of the last call.
    void rebuild(const Fluid<D>& fluid, const GhostWalls<D>& walls);

    // For a checkpoint: the pairs were collected at a time of their own.
    template <class Archive>
    void archive(Archive& fields) {
        fields(rebuilt_for_, lists_.radius, lists_.skin, lists_.blocks, clusters_, gradient_clusters_);
        if (fields.reads()) part_.assign(blocks(), Vec<D>::Zero());
    }

    // Clusters of fluid particles whose gradients the force reads (their own, and those of the ghosts' parents).
    const std::vector<std::uint32_t>& gradient_clusters() const { return gradient_clusters_; }
    std::size_t blocks() const { return (clusters_.size() + clusters_per_part - 1) / clusters_per_part; }

    // One part of the sum. Reads states and gradients of particles and ghosts; uses the rates of its own particles as
    // scratch and leaves them as they were: no two walls at the same time.
    void compute(Fluid<D>& fluid, std::size_t block);
    Vec<D> force() const;  // [N] ([N/m] in 2D): the sum of all parts, in a fixed order

    // One part of the power that this wall gives to the water, in `walls` (energy_ledger.hpp); the other rates are
    // those of its pairs alone.
    EnergyRates power(const Fluid<D>& fluid, std::size_t block) const;

  private:
    static constexpr std::size_t clusters_per_part = 8;
    bool is_of_wall(const GhostWalls<D>& walls, std::size_t particle, std::size_t ghost) const;

    int wall_;
    long rebuilt_for_ = -1;
    NeighbourLists<D> lists_;
    std::vector<std::uint32_t> clusters_, gradient_clusters_;  // ascending
    std::vector<Vec<D>> part_;
    std::vector<std::uint8_t> needed_;
};

extern template class WallForces<2>;
extern template class WallForces<3>;

// What one wall has done to the water since the start.
template <int D>
struct WallWork {
    std::string name;
    WallForces<D> pairs;  // of ghosts; walls of normal fluxes find their work themselves
    EnergyLedger ledger;

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(pairs, ledger);
    }
};

}  // namespace aquagraph::fluid
