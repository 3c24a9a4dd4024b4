#include "engine/model.hpp"

#include <algorithm>
#include <limits>

#include "engine/solid_parts.hpp"
#include "engine/wall_parts.hpp"
#include "io/scene_reader.hpp"
#include "physics/fluid/filling.hpp"

namespace aquagraph::engine {

namespace {

template <int D>
fluid::Fluid<D> make_fluid(const io::Scene& scene) {
    const io::FluidScene& from = *scene.fluid;
    fluid::Fluid<D> made{
        .spacing = from.spacing,
        .tait = {from.density, from.sound_speed, from.polytropic_exponent},
        .kernel = fluid::Kernel<D>(from.kernel, from.support_ratio * from.spacing),
        .flux = {.muscl = from.scheme.reconstruction == io::Reconstruction::muscl,
                 .scheme = from.scheme.name,
                 .solver = from.scheme.riemann_solver,
                 .delta = from.scheme.delta,
                 .alpha = from.scheme.alpha,
                 .gravity = {scene.gravity[0], scene.gravity[1], scene.gravity[2]}},
        .cfl = from.cfl,
        .domain = {scene.domain.min.as<D>(), scene.domain.max.as<D>()},
        .closed = scene.edge == io::DomainEdge::closed,
        .viscosity = {from.viscosity, from.viscous_operator},
        .transport = from.transport,
        .x_sph = from.x_sph,
        .particles = {},
        .lists = {},
        .integration = {},
        .search = {},
        .order = {},
        .reorder = {},
        .surface = {},
        .ledger = {},
    };
    made.integration.scheme = from.integration;
    made.prepare_particles();
    made.lists.radius = made.kernel.radius();
    made.lists.skin = fluid::skin_ratio * made.kernel.radius();
    std::vector<fluid::FillBox<D>> boxes;
    double top = std::numeric_limits<double>::lowest();
    for (const io::Box& box : from.boxes) {
        boxes.push_back({box.min.as<D>(), box.max.as<D>()});
        top = std::max(top, box.max[D - 1]);
    }
    std::optional<double> level;
    if (from.initial_pressure == io::InitialPressure::hydrostatic) level = from.surface_level.value_or(top);
    fill(made.particles, boxes, made.spacing, made.tait, -scene.gravity[D - 1], level);
    return made;
}

// Nobody leaves a domain in a direction along which it is periodic.
template <int D>
void make_periodic(const io::Scene& scene, fluid::Periodic<D>& periodic, fluid::Domain<D>& domain) {
    for (std::size_t d = 0; d < D; ++d) {
        const std::string direction(1, "xyz"[d]);
        if (std::find(scene.periodic.begin(), scene.periodic.end(), direction) == scene.periodic.end()) continue;
        periodic.along[d] = true;
        periodic.low[int(d)] = domain.min[d];
        periodic.high[int(d)] = domain.max[d];
        domain.max[d] = std::numeric_limits<double>::infinity();
        domain.min[d] = -domain.max[d];
    }
}

}  // namespace

template <int D>
std::unique_ptr<Model<D>> make_model(const io::Scene& scene) {
    if (!scene.fluid)  // nothing would set the time step
        throw io::scene_error(scene, "solid", "there is no water in this scene, and a solid alone cannot be run yet",
                              "add [fluid]");
    auto model = std::make_unique<Model<D>>();
    model->clock.end = scene.end_time;
    model->fluid = make_fluid<D>(scene);
    if (!scene.walls.empty() || scene.solid || !scene.periodic.empty()) {
        fluid::GhostWalls<D>& walls = model->walls.emplace();
        add_walls(scene, walls.panels);
        make_periodic(scene, walls.periodic, model->fluid->domain);
    }
    if constexpr (D == 2) {
        if (scene.solid) {
            model->solid = make_solid(scene);
            model->interface = make_interface(scene, *model);
        }
    }
    if (model->walls) {
        model->walls->panels.update_geometry();
        model->walls->panels.find_joints();
    }
    return model;
}

template <int D>
void start(Model<D>& model, const io::Scene& scene) {
    if constexpr (D == 2)
        if (model.solid) start_solid(model, scene);
}

template <int D>
double bytes_per_particle(const fluid::Fluid<D>& fluid) {
    const auto& s = fluid.particles;
    if (s.count == 0) return 0;
    double bytes = double(s.bytes() + fluid.integration.bytes());
    for (const auto& block : fluid.lists.blocks)
        bytes += 4 * double(block.open.capacity() + block.masked.capacity()) + double(block.mask.capacity()) +
                 8 * double(block.particle.capacity());
    return bytes / double(s.count);
}

template std::unique_ptr<Model<2>> make_model(const io::Scene&);
template std::unique_ptr<Model<3>> make_model(const io::Scene&);
template void start(Model<2>&, const io::Scene&);
template void start(Model<3>&, const io::Scene&);
template double bytes_per_particle(const fluid::Fluid<2>&);
template double bytes_per_particle(const fluid::Fluid<3>&);

}  // namespace aquagraph::engine
