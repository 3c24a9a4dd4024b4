// Walls and water around them, for the tests of ghost particles. Fluid lies on the left of every wall's direction.
#pragma once
#include <string>
#include <vector>

#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

namespace aquagraph::fluid::test {

inline GhostWalls<2> make_walls(Panels<2> panels) {
    GhostWalls<2> walls;
    walls.panels = std::move(panels);
    walls.panels.update_geometry();
    walls.panels.find_joints();
    return walls;
}

// Left, bottom and right wall of a tank whose corner is the origin.
inline Panels<2> tank(double width, double height) {
    Panels<2> panels;
    panels.add_wall("tank", {{0, height}, {0, 0}, {width, 0}, {width, height}}, false, false);
    return panels;
}

// A closed rectangular body, water outside.
inline void add_body(Panels<2>& panels, const Vec2& low, const Vec2& high) {
    panels.add_wall("body", {low, {low.x(), high.y()}, high, {high.x(), low.y()}}, true, false);
}

// The centres of the cells of [0, columns] × [0, rows] spacings for which `wet` holds.
template <class Wet>
std::vector<Point<2>> cells_where(int columns, int rows, double spacing, Wet&& wet) {
    std::vector<Point<2>> points;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const Point<2> x{(i + 0.5) * spacing, (j + 0.5) * spacing};
            if (wet(x)) points.push_back(x);
        }
    return points;
}

// Water at rest at these places, with lists, ghosts and gradients.
inline Driver<2> settle(const std::vector<Point<2>>& points, double spacing, Panels<2> panels,
                        const FluxParameters& flux = {}) {
    Driver<2> driver(make_fluid<2>(spacing, water, flux));
    driver.fluid.particles = place<2>(points, spacing);
    driver.walls = make_walls(std::move(panels));
    driver.rebuild();
    driver.rates(0);
    return driver;
}

template <int D>
Vec<D> position(const Particles<D>& s, std::size_t i) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = s.x[std::size_t(d)][i];
    return x;
}

// Lanes closer than R that particle i sees, itself left out.
template <int D>
std::vector<std::size_t> neighbours_of(const Fluid<D>& fluid, std::size_t i) {
    const auto& s = fluid.particles;
    const std::size_t block = i / (clusters_per_block * W), local = i - block * clusters_per_block * W;
    const NeighbourBlock& list = fluid.lists.blocks[block];
    const auto from = list.particle[local], to = list.particle[local + 1];
    std::vector<std::size_t> found;
    const auto visit = [&](std::uint32_t cluster, unsigned mask) {
        for (std::size_t l = 0; l < W; ++l) {
            const std::size_t j = cluster * W + l;
            if (j != i && ((mask >> l) & 1u) && distance(s, i, j) < fluid.kernel.radius()) found.push_back(j);
        }
    };
    for (auto k = from.open_end; k < to.open_end; ++k) visit(list.open[k], 0xff);
    for (auto k = from.masked_end; k < to.masked_end; ++k) visit(list.masked[k], list.mask[k]);
    return found;
}

// Σ W ω over everything that particle i sees and itself: 1 where the support is full, more where a place counts twice.
template <int D>
double partition_of_unity(const Fluid<D>& fluid, std::size_t i) {
    const auto& s = fluid.particles;
    double sum = fluid.kernel.value(0) * s.volume[i];
    for (const std::size_t j : neighbours_of(fluid, i)) sum += fluid.kernel.value(distance(s, i, j)) * s.volume[j];
    return sum;
}

}  // namespace aquagraph::fluid::test
