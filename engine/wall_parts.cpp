#include "engine/wall_parts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "io/scene_reader.hpp"
#include "io/scene_surfaces.hpp"

namespace aquagraph::engine {

namespace {

template <int D>
std::vector<fluid::Vec<D>> points_of(const io::WallScene& wall) {
    std::vector<fluid::Vec<D>> points;
    for (const io::Point& point : wall.points) {
        fluid::Vec<D>& x = points.emplace_back();
        for (int d = 0; d < D; ++d) x[d] = point[std::size_t(d)];
    }
    return points;
}

// A fan of triangles from the first corner.
std::vector<std::array<int, 3>> triangles_of_face(const io::Scene& scene, std::size_t wall,
                                                  const std::vector<fluid::Vec3>& corners) {
    const std::size_t n = corners.size();
    const auto edge = [&](std::size_t k) -> fluid::Vec3 { return corners[(k + 1) % n] - corners[k % n]; };
    fluid::Vec3 twice_area = fluid::Vec3::Zero();
    for (std::size_t k = 1; k + 1 < n; ++k) twice_area += (corners[k] - corners[0]).cross(edge(k));
    const fluid::Vec3 normal = twice_area.normalized();
    const double size = std::sqrt(twice_area.norm());
    for (std::size_t k = 0; k < n; ++k) {
        const auto refuse = [&](const char* what) {
            const auto& x = corners[(k + 1) % n];
            throw io::scene_error(
                scene, fmt::format("wall[{}].points[{}]", wall, (k + 1) % n),
                fmt::format("the face of wall '{}' is {} at [{}, {}, {}]", scene.walls[wall].name, what, x[0], x[1],
                            x[2]),
                "give the corners of a flat convex face one after the other, counter-clockwise as seen from the water");
        };
        if (!(std::fabs(edge(k).dot(normal)) <= 1e-6 * size)) refuse("not flat");
        if (!(edge(k).cross(edge(k + 1)).dot(normal) > 0)) refuse("not convex");
    }
    std::vector<std::array<int, 3>> triangles;
    for (int k = 1; k + 1 < int(n); ++k) triangles.push_back({0, k, k + 1});
    return triangles;
}

template <int D>
void add_shape(const io::Scene& scene, std::size_t w, fluid::Panels<D>& panels) {
    const io::WallScene& wall = scene.walls[w];
    const bool no_slip = wall.slip == io::Slip::none;
    geometry::Surface<D> surface;
    try {
        surface = io::wall_surface<D>(wall, scene.fluid->spacing);
    } catch (const std::exception& error) {  // the reader has tried it, but files may change
        throw io::scene_error(scene, fmt::format("wall[{}]", w), error.what(), "see [[wall]] in SCENES.md");
    }
    if constexpr (D == 2) {
        const int index = int(panels.names.size()), base = int(panels.position.size());
        panels.names.push_back(wall.name);
        panels.position.insert(panels.position.end(), surface.vertices.begin(), surface.vertices.end());
        panels.velocity.resize(panels.position.size(), fluid::Vec2::Zero());
        for (const auto& [a, b] : surface.facets)
            panels.panels.push_back({{base + a, base + b}, index, no_slip, false});
    } else {
        panels.add_wall(wall.name, surface.vertices, surface.facets, no_slip);
    }
}

}  // namespace

template <int D>
void add_walls(const io::Scene& scene, fluid::Panels<D>& panels) {
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const io::WallScene& wall = scene.walls[w];
        const std::vector<fluid::Vec<D>> points = points_of<D>(wall);
        const bool no_slip = wall.slip == io::Slip::none;
        if (points.empty()) {
            add_shape(scene, w, panels);
        } else if constexpr (D == 2) {
            panels.add_wall(wall.name, points, wall.closed, no_slip);
        } else {
            panels.add_wall(wall.name, points, triangles_of_face(scene, w, points), no_slip);
        }
        for (fluid::Panel<D>& panel : panels.panels)
            if (panel.wall == int(panels.names.size()) - 1) panel.symmetry = wall.slip == io::Slip::symmetry;
    }
}

template <int D>
fluid::MovingWalls<D> moving_walls(const io::Scene& scene, const fluid::Panels<D>& panels) {
    fluid::MovingWalls<D> moving;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        if (!scene.walls[w].motion) continue;
        try {
            moving.add(panels, int(w), io::rigid_motion<D>(*scene.walls[w].motion, scene.end_time));
        } catch (const std::exception& error) {
            throw io::scene_error(scene, fmt::format("wall[{}].motion", w), error.what(),
                                  "see [wall.motion] in SCENES.md");
        }
    }
    return moving;
}

template <int D>
void part_moving_walls(const io::Scene& scene, fluid::Panels<D>& panels) {
    const auto moves = [&](int panel) {
        const auto wall = std::size_t(panels.panels[std::size_t(panel)].wall);
        return wall < scene.walls.size() && scene.walls[wall].motion.has_value();  // behind them the solid's
    };
    const auto wall_of = [&](int panel) { return panels.panels[std::size_t(panel)].wall; };
    std::erase_if(panels.joints, [&](const fluid::Joint<D>& joint) {
        const auto [a, b] = joint.panel;
        return wall_of(a) != wall_of(b) && (moves(a) || moves(b));
    });
}

template <int D>
std::vector<std::vector<io::Point>> moving_panels(const io::Scene& scene, const fluid::Panels<D>& panels) {
    constexpr std::size_t most = 500;
    std::vector<std::size_t> moving;
    for (std::size_t k = 0; k < panels.size() - panels.copies; ++k) {
        const auto wall = std::size_t(panels.panels[k].wall);
        if (wall < scene.walls.size() && scene.walls[wall].motion) moving.push_back(k);
    }
    std::vector<std::vector<io::Point>> corners;
    for (std::size_t m = 0; m < moving.size(); m += moving.size() / most + 1) {
        auto& panel = corners.emplace_back();
        for (std::size_t k = 0; k < D; ++k) {
            const fluid::Vec<D>& x = panels.vertex(moving[m], k);
            if constexpr (D == 2)
                panel.emplace_back(x[0], x[1]);
            else
                panel.emplace_back(x[0], x[1], x[2]);
        }
    }
    return corners;
}

template std::vector<std::vector<io::Point>> moving_panels(const io::Scene&, const fluid::Panels<2>&);
template std::vector<std::vector<io::Point>> moving_panels(const io::Scene&, const fluid::Panels<3>&);
template void part_moving_walls(const io::Scene&, fluid::Panels<2>&);
template void part_moving_walls(const io::Scene&, fluid::Panels<3>&);
template fluid::MovingWalls<2> moving_walls(const io::Scene&, const fluid::Panels<2>&);
template fluid::MovingWalls<3> moving_walls(const io::Scene&, const fluid::Panels<3>&);
template void add_walls(const io::Scene&, fluid::Panels<2>&);
template void add_walls(const io::Scene&, fluid::Panels<3>&);

}  // namespace aquagraph::engine
