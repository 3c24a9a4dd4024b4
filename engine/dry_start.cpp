#include "engine/dry_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "physics/geometry/facet_tree.hpp"

namespace aquagraph::engine {

namespace {

constexpr double touching = 1e-6;  // of a spacing

template <int D>
geometry::Surface<D> surface_of(const fluid::Panels<D>& panels, int wall, double tolerance) {
    geometry::Surface<D> surface;
    surface.vertices = panels.position;
    for (std::size_t k = 0; k < panels.size() - panels.copies; ++k)
        if (panels.panels[k].wall == wall) surface.facets.push_back(panels.panels[k].vertex);
    surface.drop_unused_vertices();
    weld(surface, tolerance);
    return surface;
}

template <int D>
const fluid::Periodic<D>& periodic_of(const Model<D>& model) {
    return model.flux_walls ? model.flux_walls->images.periodic : model.walls->periodic;
}

// The nearest particle in front, or the first within R, which settles it. At the rim of an open surface no side is
// defined: water there counts.
template <int D>
DryStart<D> nearest_water(const Model<D>& model, const geometry::Surface<D>& surface) {
    const geometry::FacetTree<D> tree(surface);
    const fluid::Periodic<D>& periodic = periodic_of(model);
    const auto& s = model.fluid->particles;
    DryStart<D> found;
    for (std::size_t i = 0; i < s.count; ++i) {
        geometry::Vec<D> x;
        for (std::size_t d = 0; d < D; ++d) x[int(d)] = s.x[d][i];
        for (int copy = 0; copy < fluid::Periodic<D>::copies; ++copy) {
            if (!periodic.exists(copy)) continue;
            const geometry::Vec<D> image = x + periodic.shift(copy);
            const auto nearest = tree.nearest(image, found.gap);
            if (nearest.facet < 0 || !(nearest.rim || nearest.side() >= 0)) continue;
            found.gap = nearest.distance;
            found.particle = image;
            if (found.gap < model.fluid->kernel.radius()) return found;
        }
    }
    return found;
}

}  // namespace

template <int D>
std::vector<DryStart<D>> dry_starts(const io::Scene& scene, const Model<D>& model) {
    if (!model.walls && !model.flux_walls) return {};
    const fluid::Panels<D>& panels = panels_of(model);
    const double reach = model.fluid->kernel.radius();
    std::vector<DryStart<D>> found;
    const auto look = [&](int wall, std::string body, bool elastic) {
        const auto surface = surface_of(panels, wall, touching * model.fluid->spacing);
        if (surface.facets.empty()) return;
        DryStart<D> water = nearest_water(model, surface);
        if (water.gap < reach) return;
        water.body = std::move(body);
        water.elastic = elastic;
        found.push_back(std::move(water));
    };
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const io::WallScene& wall = scene.walls[w];
        if (wall.slip == io::Slip::symmetry || !(wall.motion || wall.force)) continue;
        look(int(w), fmt::format("wall '{}'", wall.name), false);
    }
    if constexpr (D == 2)
        if (model.interface)
            look(model.interface->surface.wall(), fmt::format("the wet surface of '{}'", scene.solid->name), true);
    return found;
}

template <int D>
std::string text_of(const DryStart<D>& dry, const Model<D>& model) {
    const std::string mend = dry.elastic ? "move the body or the water, or look at `wet` of [solid]"
                                         : "move the wall or the water, or turn the wall round";
    if (!dry.particle)
        return fmt::format(
            "no water lies in front of {}: nothing acts on it until water comes there. If that is not meant, {}",
            dry.body, mend);
    return fmt::format(
        "{} begins away from the water: the nearest particle, at ({:g}) m, is {:g} m away, and R is {:g} m. Nothing "
        "acts on it until water comes there. If that is not meant, {}",
        dry.body, fmt::join(dry.particle->data(), dry.particle->data() + D, ", "), dry.gap,
        model.fluid->kernel.radius(), mend);
}

#define AQUAGRAPH_INSTANTIATE(D)                                                     \
    template std::vector<DryStart<D>> dry_starts(const io::Scene&, const Model<D>&); \
    template std::string text_of(const DryStart<D>&, const Model<D>&);
AQUAGRAPH_INSTANTIATE(2)
AQUAGRAPH_INSTANTIATE(3)
#undef AQUAGRAPH_INSTANTIATE

}  // namespace aquagraph::engine
