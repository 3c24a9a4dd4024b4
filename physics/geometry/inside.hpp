// Whether a place lies inside a closed surface: even-odd rule along the last direction.
//
// Exact bookkeeping: whether the column through a place passes a facet is decided from its edges seen along the
// column, each by one comparison that its two facets share (half-open intervals, vertices always in the same order).
// So no column slips between two facets or meets an edge twice, whatever the rounding; only places within rounding of
// the surface itself can fall on either side.
#pragma once
#include <vector>

#include "physics/geometry/surface.hpp"

namespace aquagraph::geometry {

template <int D>
class InsideTest {
  public:
    // The surface must be closed and welded.
    explicit InsideTest(const Surface<D>& surface);
    bool operator()(const Vec<D>& x) const;

  private:
    bool passes(std::size_t facet, const Vec<D>& x) const;    // the column through x
    double height(std::size_t facet, const Vec<D>& x) const;  // where it does

    Surface<D> surface_;
    Vec<D> low_, high_;
    std::array<int, D - 1> cells_{};
    std::array<double, D - 1> inverse_width_{};
    std::vector<int> cell_start_, cell_facets_;  // CSR: facets seen along each column of cells
};

extern template class InsideTest<2>;
extern template class InsideTest<3>;

}  // namespace aquagraph::geometry
