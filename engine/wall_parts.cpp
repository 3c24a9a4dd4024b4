#include "engine/wall_parts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "io/scene_reader.hpp"

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

}  // namespace

template <int D>
void add_walls(const io::Scene& scene, fluid::Panels<D>& panels) {
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const io::WallScene& wall = scene.walls[w];
        const std::vector<fluid::Vec<D>> points = points_of<D>(wall);
        const bool no_slip = wall.slip == io::Slip::none;
        if constexpr (D == 2)
            panels.add_wall(wall.name, points, wall.closed, no_slip);
        else
            panels.add_wall(wall.name, points, triangles_of_face(scene, w, points), no_slip);
        for (fluid::Panel<D>& panel : panels.panels)
            if (panel.wall == int(panels.names.size()) - 1) panel.symmetry = wall.slip == io::Slip::symmetry;
    }
}

template void add_walls(const io::Scene&, fluid::Panels<2>&);
template void add_walls(const io::Scene&, fluid::Panels<3>&);

}  // namespace aquagraph::engine
