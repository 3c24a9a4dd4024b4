// The averaged pressure load (thesis (4.1), after Oger et al. 2006): each wet panel k bears the mean pressure of the
// particles around it,
//     F_k = - P_k S_k n_k,     P_k = 1/N Σ_{i ∈ A_k} p_i,
// A_k being the N particles on its wet side, nearer to it than R; half of F_k goes to each end. Smooth, but neither
// force nor energy that the fluid gives are what the body gets, and the mean stands for a place about R/2 before the
// panel: still water loads a horizontal floor with ρ g (H - R/2).
//
// Needs particles and panels alone, so it serves walls of ghosts and of normal fluxes. There is no test of sight: a
// panel also counts water behind another body nearer than R.
#pragma once
#include <vector>

#include "physics/fluid/particles.hpp"
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::coupling {

using fluid::Vec2;

class AveragedPressureLoad {
  public:
    // Collects the particles within `reach` of each wet panel, after the neighbour lists have been built; reach: R and
    // the lists' skin.
    void rebuild(const fluid::Particles<2>& particles, const fluid::Panels<2>& panels, double reach);

    std::size_t blocks() const { return (wet_.size() + panels_per_block - 1) / panels_per_block; }
    std::uint64_t candidates() const { return candidates_.size(); }

    // Mean pressures of the panels of one block. Particles up to `behind` behind a panel still count as before it.
    void compute(const fluid::Particles<2>& particles, const fluid::Panels<2>& panels, double radius, double behind,
                 std::size_t block);
    // Forces on vertices, one per vertex of `panels` [N/m], in a fixed order.
    void spread(const fluid::Panels<2>& panels, std::vector<Vec2>& vertex_forces) const;

    // Of the k-th wet panel, in the order of the panels.
    double pressure(std::size_t k) const { return pressure_[k]; }
    std::size_t particles(std::size_t k) const { return count_[k]; }

  private:
    static constexpr std::size_t panels_per_block = 4;
    struct WetPanel {
        std::uint32_t panel, begin, end;  // into candidates_
    };
    std::vector<WetPanel> wet_;
    std::vector<std::uint32_t> candidates_;   // lanes, ascending within a panel
    std::vector<double> pressure_;            // P_k [Pa]
    std::vector<std::size_t> count_;          // N
    std::vector<std::array<Vec2, 2>> boxes_;  // around the particles of each block
};

}  // namespace aquagraph::coupling
