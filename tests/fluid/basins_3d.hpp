// Walls of triangles and water around them, for the tests of ghost particles in 3D.
#pragma once
#include <string>
#include <vector>

#include "tests/fluid/basins.hpp"

namespace aquagraph::fluid::test {

// The sides of a box, two triangles each. `open` leaves out the top. `inside`: the water is inside.
inline void add_box(Panels<3>& panels, const std::string& name, const Vec3& low, const Vec3& high, bool inside,
                    bool open = false, bool no_slip = false) {
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.emplace_back((k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z());
    std::vector<std::array<int, 3>> triangles{{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}, {2, 3, 7},
                                              {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    if (!open) {
        triangles.push_back({4, 6, 7});
        triangles.push_back({4, 7, 5});
    }
    if (!inside)
        for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
    panels.add_wall(name, corners, triangles, no_slip);
}

// An open tank whose corner is the origin.
inline Panels<3> tank(const Vec3& size, bool no_slip = false) {
    Panels<3> panels;
    add_box(panels, "tank", Vec3::Zero(), size, true, true, no_slip);
    return panels;
}

// Every triangle cut into four, `times` times over: the same surface of smaller panels.
inline Panels<3> refined(const Panels<3>& coarse, int times) {
    if (times == 0) return coarse;
    Panels<3> fine;
    for (std::size_t w = 0; w < coarse.names.size(); ++w) {
        std::vector<Vec3> points;
        std::vector<std::array<int, 3>> triangles;
        bool no_slip = false;
        for (std::size_t k = 0; k < coarse.size(); ++k) {
            if (coarse.panels[k].wall != int(w)) continue;
            const int base = int(points.size());
            for (std::size_t v = 0; v < 3; ++v) points.push_back(coarse.vertex(k, v));
            for (std::size_t v = 0; v < 3; ++v)
                points.push_back(0.5 * (coarse.vertex(k, v) + coarse.vertex(k, (v + 1) % 3)));
            for (const std::array<int, 3>& t :
                 {std::array{0, 3, 5}, std::array{3, 1, 4}, std::array{5, 4, 2}, std::array{3, 4, 5}})
                triangles.push_back({base + t[0], base + t[1], base + t[2]});
            no_slip = coarse.panels[k].no_slip;
        }
        fine.add_wall(coarse.names[w], points, triangles, no_slip);
    }
    return refined(fine, times - 1);
}

// The centres of the cells of [0, cells) spacings for which `wet` holds.
template <class Wet>
std::vector<Point<3>> cells_where(const std::array<int, 3>& cells, double spacing, Wet&& wet) {
    std::vector<Point<3>> points;
    for (int i = 0; i < cells[0]; ++i)
        for (int j = 0; j < cells[1]; ++j)
            for (int k = 0; k < cells[2]; ++k) {
                const Vec3 x((i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing);
                if (wet(x)) points.push_back({x.x(), x.y(), x.z()});
            }
    return points;
}

template <int D>
GhostWalls<D> make_ghost_walls(Panels<D> panels) {
    GhostWalls<D> walls;
    walls.panels = std::move(panels);
    walls.panels.update_geometry();
    walls.panels.find_joints();
    return walls;
}

// Water at rest at these places, with lists, ghosts and gradients.
inline Driver<3> settle(const std::vector<Point<3>>& points, double spacing, Panels<3> panels,
                        const FluxParameters& flux = {}) {
    Driver<3> driver(make_fluid<3>(spacing, water, flux));
    driver.fluid.particles = place<3>(points, spacing);
    driver.walls = make_ghost_walls(std::move(panels));
    driver.rebuild();
    driver.rates(0);
    return driver;
}

template <int D>
Vec<D> velocity(const Particles<D>& s, std::size_t i) {
    Vec<D> v;
    for (int d = 0; d < D; ++d) v[d] = s.v[std::size_t(d)][i];
    return v;
}

}  // namespace aquagraph::fluid::test
