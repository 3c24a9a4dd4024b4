// Convex edges of walls: what lies behind them is filled from both of their sides, by shares that vary smoothly.
//
// In the wedge behind an edge every place is mirrored from both sides, A and B. Were one of the two images seen or the
// other, as a line of sight has it, whole particles would come and go at once. Instead an image at x gets a share of
// its parent's volume,
//     w_A(x) = S(t),   t = (a + ε)/(a + b + 2ε),   S(u) = u² (3 - 2u) on [0, 1],   ε = Δx,   w_A + w_B = 1,
// and is seen through either side. a and b say how far inside its side an image is: where the body fills 90° or more,
// how far from the edge, along A and along B, the parents' feet are; below 90°, where images come out on the other
// side, how deep x is behind B and behind A. So far from the edge w_A goes from 1 next to A to 0 next to B, where the
// parents of A's images leave their panel or the images the body, and closer than ε to the edge it is about a half.
// Without ε the share of an image near the edge would turn over while its parent moves by a small part of Δx, which
// drives particles away from the edge: the still tank's benchmark has the measurements.
//
// A side that is dry, or nearly, where the image of x would be gives its part up to the other:
//     w_A = 1 - w_B(x) S(2 P_B/P_A),   P_K = Σ_{images of K near x} W,
// as the images stood when the lists were made (without ω, which goes on to change: a restart makes the same lists).
//
// In the plane, and at walls whose motion is prescribed. In space, and at elastic bodies, edges are left to sight
// (visibility.hpp): with shares at its keel the energy conservative load of an elastic wedge (beam impact, Δx 3 cm)
// left 0.26 % of the body's work at the interface, by sight 0.02 %. Why is not known.
#pragma once
#include <span>

#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

// A joint between two smooth patches; A is panel[0].
template <int D>
struct SharedEdge {
    std::array<int, 2> panel, patch;
    std::array<int, D - 1> vertex;
    double softness;                          // ε [m]
    bool acute = false;                       // the body fills less than 90° there
    Vec<D> point = Vec<D>::Zero();            // present place [m]
    std::array<Vec<D>, 2> along{}, normal{};  // unit vectors along both sides, off the edge, and into the fluid

    void update(const Panels<D>& panels);
    // w of an image at x that this side has mirrored, both sides being wet.
    double share(std::size_t side, const Vec<D>& x) const;
};

template <int D>
class EdgeShares {
  public:
    // Finds the edges that are shared: blunt ones (the body fills 60° and more) with no other wall near that could be
    // seen through them, nor another edge of the same body so near that a place is mirrored from three sides.
    void find_edges(const Panels<D>& panels, const std::vector<int>& patch, double spacing, double reach);
    // After the vertices have moved.
    void update(const Panels<D>& panels);
    const std::vector<SharedEdge<D>>& edges() const { return edges_; }

    // Whose images take part: anew for every list, ghosts ascending, then weigh().
    void clear();
    void add(std::uint32_t ghost, int patch, const Vec<D>& normal, const Vec<D>& image);
    // How much water the two sides have there, as things stand.
    void weigh();

    struct Share {
        std::uint32_t ghost, edge, side;
        double others = 1;  // S(2 P/P): how much of its part the other side fills
    };
    // The shares of ghosts begin … end-1.
    std::span<const Share> of(std::size_t begin, std::size_t end) const;
    // Of the ghost's volume, when its image is at x.
    double weight(const Share& share, const Vec<D>& x) const;
    // True if a line of sight through this patch reaches the ghost as one through its own does.
    bool seen_through(std::size_t ghost, int patch) const;

  private:
    double reach_ = 0;
    std::vector<SharedEdge<D>> edges_;
    std::vector<Share> shares_;
    std::vector<Vec<D>> images_;  // of the shares
};

extern template struct SharedEdge<2>;
extern template struct SharedEdge<3>;
extern template class EdgeShares<2>;
extern template class EdgeShares<3>;

}  // namespace aquagraph::fluid
