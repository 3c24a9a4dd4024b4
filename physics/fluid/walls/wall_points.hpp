// Quadrature points on walls (normal_flux.hpp): panels cut into cells, segments into equal parts and triangles into
// similar ones, a point in the centre of each. Points keep their place on their panel however it moves and deforms.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "physics/fluid/particles.hpp"
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

template <int D>
struct WallPoints {
    // One entry more than there are points: the last has no area and fills lists up to whole clusters.
    Vectors<D> x, normal, velocity;  // [m], out of the fluid, of the wall [m/s]
    Scalars area;                    // [m^(D-1)]

    struct Cell {
        std::int32_t panel;
        std::array<std::array<double, D>, D> vertex;  // barycentric coordinates on the panel of the cell's vertices
        std::array<double, D> centre;                 // of the point
    };
    std::vector<Cell> cell;
    std::size_t size() const { return cell.size(); }

    // Neighbouring points of a panel are no further apart than `spacing`. Panel by panel, panels that are as large cut
    // alike: the points of copies follow those of the originals, in the same order.
    void cut(const Panels<D>& panels, double spacing);
    // Places of points after the panels have moved; panels.update_geometry() comes first.
    void update(const Panels<D>& panels);
    Vec<D> place(std::size_t point) const;
    Vec<D> outward(std::size_t point) const;  // its normal, out of the fluid
    // Present place of a cell's vertex.
    Vec<D> vertex(const Panels<D>& panels, std::size_t cell_number, std::size_t k) const;

  private:
    std::vector<double> share_;  // of its panel's measure
};

extern template struct WallPoints<2>;
extern template struct WallPoints<3>;

}  // namespace aquagraph::fluid
