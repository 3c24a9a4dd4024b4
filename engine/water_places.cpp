#include "engine/water_places.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/scene_reader.hpp"
#include "io/scene_surfaces.hpp"
#include "physics/geometry/facet_tree.hpp"
#include "physics/geometry/inside.hpp"

namespace aquagraph::engine {

namespace {

constexpr double touching = 1e-6;  // of a spacing

template <int D>
std::string text(const geometry::Vec<D>& x) {
    return fmt::format("({:g}) m", fmt::join(x.data(), x.data() + D, ", "));
}

}  // namespace

template <int D>
void refuse_overlapping_water(const io::Scene& scene, const std::vector<std::string>& keys,
                              const std::vector<fluid::Region<D>>& regions, const std::vector<fluid::Water<D>>& water) {
    if (scene.fluid->regions.empty()) return;  // boxes are compared when the scene is read
    const double tolerance = touching * scene.fluid->spacing;
    for (std::size_t b = 0; b < regions.size(); ++b) {
        const fluid::Region<D>& region = regions[b];
        const geometry::InsideTest<D> inside(region.boundary);
        const geometry::FacetTree<D> tree(region.boundary);
        for (std::size_t a = 0; a < water.size(); ++a) {
            if (a == b) continue;
            for (const geometry::Vec<D>& x : water[a].places.x) {
                if (!inside(x) || (region.level && x[D - 1] > *region.level - tolerance)) continue;
                if (tree.nearest(x, tolerance).facet >= 0) continue;
                throw io::scene_error(scene, keys[std::max(a, b)],
                                      fmt::format("two bodies of water overlap: a particle of {} lies inside {}, at {}",
                                                  keys[a], keys[b], text<D>(x)),
                                      "bodies of water may touch, not overlap: particles would stand in each other");
            }
        }
    }
}

template <int D>
void refuse_water_behind_walls(const io::Scene& scene, const std::vector<std::string>& keys,
                               const std::vector<fluid::Water<D>>& water) {
    const double spacing = scene.fluid->spacing;
    geometry::Surface<D> all;
    std::vector<std::size_t> wall_of;  // facet
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        all.append(io::wall_surface<D>(scene.walls[w], spacing));
        wall_of.resize(all.facets.size(), w);
    }
    if (all.facets.empty()) return;
    // A baffle without thickness is two walls in one place: water may stand on either side.
    std::vector<geometry::FacetTree<D>> single;
    const auto before_another = [&](const geometry::Vec<D>& x, double distance) {
        if (single.empty())
            for (const io::WallScene& wall : scene.walls) single.emplace_back(io::wall_surface<D>(wall, spacing));
        return std::any_of(single.begin(), single.end(), [&](const geometry::FacetTree<D>& wall) {
            const auto nearest = wall.nearest(x, distance + touching * spacing);
            return nearest.facet >= 0 && !nearest.rim && nearest.side() > 0;
        });
    };
    weld(all, touching * spacing);
    const geometry::FacetTree<D> tree(all);
    const double reach = scene.fluid->support_ratio * spacing;
    for (std::size_t b = 0; b < water.size(); ++b)
        for (const geometry::Vec<D>& x : water[b].places.x) {
            const auto nearest = tree.nearest(x);
            if (nearest.rim || nearest.side() >= 0) continue;
            const std::size_t w = wall_of[std::size_t(nearest.facet)];
            const io::WallScene& wall = scene.walls[w];
            if (!io::is_closed(wall) && nearest.distance > reach) continue;
            if (before_another(x, nearest.distance)) continue;
            throw io::scene_error(
                scene, fmt::format("wall[{}]", w),
                fmt::format("there is water on the wrong side of wall '{}': a particle of {} at {}, {:g} m behind it",
                            wall.name, keys[b], text<D>(x), nearest.distance),
                D == 2 ? "the fluid lies on the left of the wall's direction of travel; reverse its points, or say "
                         "`fluid = \"inside\"` or \"outside\" of its shape"
                       : "the corners of a panel run counter-clockwise as seen from the fluid; reverse them, or say "
                         "`fluid = \"inside\"` or \"outside\" of its shape");
        }
}

template void refuse_overlapping_water(const io::Scene&, const std::vector<std::string>&,
                                       const std::vector<fluid::Region<2>>&, const std::vector<fluid::Water<2>>&);
template void refuse_overlapping_water(const io::Scene&, const std::vector<std::string>&,
                                       const std::vector<fluid::Region<3>>&, const std::vector<fluid::Water<3>>&);
template void refuse_water_behind_walls(const io::Scene&, const std::vector<std::string>&,
                                        const std::vector<fluid::Water<2>>&);
template void refuse_water_behind_walls(const io::Scene&, const std::vector<std::string>&,
                                        const std::vector<fluid::Water<3>>&);

}  // namespace aquagraph::engine
