// Nearest facet of a surface, and on which side of it a place is: a tree of axis-parallel boxes.
//
// The sign of the distance comes from the angle-weighted pseudo-normal of the nearest facet, edge or vertex
// (Bærentzen and Aanæs, Signed distance computation using the angle weighted pseudonormal, IEEE TVCG 11, 2005), which
// is right at every edge and corner of a closed surface.
#pragma once
#include <limits>
#include <vector>

#include "physics/geometry/surface.hpp"

namespace aquagraph::geometry {

template <int D>
struct Nearest {
    int facet = -1;                                             // -1: none within the distance asked for
    double distance = std::numeric_limits<double>::infinity();  // [m]
    Vec<D> place;                                               // of the surface
    Vec<D> normal;                                              // pseudo-normal there, to the front; no unit vector
    bool rim = false;                                           // at the rim of an open surface: no side is defined
    double side() const { return facet < 0 ? 0 : side_; }       // > 0: in front
    double signed_distance() const { return side_ < 0 ? -distance : distance; }
    double side_ = 0;
};

template <int D>
class FacetTree {
  public:
    // Vertices that are shared must be welded. Facets must have length or area.
    explicit FacetTree(const Surface<D>& surface);

    // The nearest place of the surface, if closer than `within`. Of several the one of the facet listed first.
    Nearest<D> nearest(const Vec<D>& x, double within = std::numeric_limits<double>::infinity()) const;
    // Appends the facets whose own boxes meet this box, in no particular order.
    void in_box(const Vec<D>& low, const Vec<D>& high, std::vector<int>& facets) const;
    const Surface<D>& surface() const { return surface_; }

  private:
    struct Node {
        Vec<D> low, high;
        int begin, end;  // of order_, of a leaf
        int right = -1;  // the left child is the next node; -1: a leaf
    };
    int build(int begin, int end);
    void pseudo_normals();
    void look(int node, const Vec<D>& x, Nearest<D>& best, std::array<int, 2>& part) const;

    Surface<D> surface_;
    std::vector<Node> nodes_;
    std::vector<int> order_;
    std::vector<Vec<D>> low_, high_, normal_;  // of facets
    std::vector<Vec<D>> vertex_normal_;
    std::vector<std::array<Vec<D>, D>> edge_normal_;  // 3D: of each side of each facet
    std::vector<bool> vertex_on_rim_;
    std::vector<std::array<bool, D>> edge_on_rim_;
};

extern template class FacetTree<2>;
extern template class FacetTree<3>;

}  // namespace aquagraph::geometry
