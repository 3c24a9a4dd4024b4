// What the water can know of a wet surface's motion, and the loads that go with it.
//
// A wall of ghosts takes the velocity of the wall at the feet of particles, Δx apart, and loads it there. Where nodes
// are closer than that, one node answers alone for water Δx wide, ρ0 c0 Δx per depth, with its own small mass: in a
// staggered exchange z = ρ0 c0 Δx Δt/m_node (staggered_stability.hpp) is far above 1 and only the stiffness that an
// implicit solve adds, β Δt² K, holds the node: shorter steps fail where longer ones run. The water therefore sees a
// smoothed motion
//     x~ = S x,  v~ = S v,      S = (G + ℓ⁴ K)⁻¹ G                                              (1)
// the smoothing spline of the nodes' motion along the surface (Reinsch 1967; Green & Silverman 1994, section 2.3),
// which minimises ∫ (v~ - v)² ds + ℓ⁴ ∫ (v~'')² ds: G has the length that belongs to each node, K the squares of second
// differences along smooth sides, none across corners. A wave of wave number k passes with 1/(1 + (kℓ)⁴). The body gets
//     f = Sᵀ f~                                                                                  (2)
// of the forces f~ that the water exerts on the smoothed surface, so that
//     f·v = f~·v~       the power exchanged is the same, whatever v,
//     S y = y           for whatever is linear in arc length along each straight side (K y = 0): translations and
//                       rotations, so that total force and moment about any point are those of the water,
//     Sᵀ G y = G y      since G S = Sᵀ G: nodal loads of a uniform or linear pressure on a side that meets no other
//                       come out as they went in,
//     |S v|_G <= |v|_G  no motion is made larger.
// Bent sides keep their shape: positions are X + S (x - X), X at the start. There rotations are kept up to ℓ⁴ X''''.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::coupling {

using fluid::Vec2;

class WetSmoothing {
  public:
    WetSmoothing() = default;
    // vertex: where the surface's vertices are at the start [m]; segments: between them, one behind the other along
    // each side; length: ℓ [m]. Sides end where segments turn by more than 30°. ℓ = 0: S = 1.
    WetSmoothing(std::vector<Vec2> vertex, const std::vector<std::array<std::size_t, 2>>& segments, double length);

    bool changes() const { return !first_.empty(); }  // whether S is not 1
    double length() const { return length_; }         // ℓ [m]

    // v~ = S v, one entry per vertex; not in place.
    void smooth(std::span<const Vec2> values, std::span<Vec2> smoothed) const;
    // X + S (x - X).
    void smooth_positions(std::span<const Vec2> positions, std::span<Vec2> smoothed) const;
    // f = Sᵀ f~.
    void gather(std::span<const Vec2> forces, std::span<Vec2> nodal) const;

  private:
    double length_ = 0;
    std::vector<Vec2> start_;     // X
    std::vector<double> weight_;  // diagonal of G [m]
    // (G + ℓ⁴ K)⁻¹, symmetric, by rows: what is less than a rounding error of the largest is left out.
    std::vector<std::uint32_t> first_, column_;
    std::vector<double> entry_;
};

}  // namespace aquagraph::coupling
