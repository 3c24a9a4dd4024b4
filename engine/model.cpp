#include "engine/model.hpp"

#include <algorithm>
#include <limits>

#include "engine/body_parts.hpp"
#include "engine/initial_fields.hpp"
#include "engine/solid_parts.hpp"
#include "engine/wall_parts.hpp"
#include "io/scene_reader.hpp"

namespace aquagraph::engine {

namespace {

constexpr double step_band = 0.01;  // in which the step of a coupled run stays the same

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
    made.ledger.kept = scene.output.energy_ledger;
    made.prepare_particles();
    made.lists.radius = made.kernel.radius();
    const bool walls = !scene.walls.empty() || scene.solid || !scene.periodic.empty();
    made.lists.skin = fluid::skin_ratio<D>(walls) * made.kernel.radius();
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

template <int D>
void add_wall_works(const io::Scene& scene, Model<D>& model) {
    for (std::size_t w = 0; w < scene.walls.size(); ++w)
        if (scene.walls[w].force && scene.output.energy_ledger)
            model.wall_works.push_back({scene.walls[w].name, fluid::WallForces<D>(int(w)), {}});
}

// Walls of normal fluxes in a periodic domain.
template <int D>
void repeat_walls(const io::Scene& scene, Model<D>& model) {
    fluid::Periodic<D> periodic;
    make_periodic(scene, periodic, model.fluid->domain);
    try {
        model.flux_walls->repeat(periodic);
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, "fluid.walls", error.what(), "or take [fluid] walls = \"ghosts\"");
    }
}

// Once all panels are there.
template <int D>
void settle(const io::Scene& scene, fluid::Panels<D>& panels, const fluid::MovingWalls<D>& moving) {
    panels.update_geometry();
    panels.find_joints();
    part_moving_walls(scene, panels);
    moving.place(panels, 0);  // and their velocities
}

}  // namespace

template <int D>
std::unique_ptr<Model<D>> make_model(const io::Scene& scene) {
    auto model = std::make_unique<Model<D>>();
    model->clock.end = scene.end_time;
    if (!scene.fluid) {
        make_structure(scene, *model);
        choose_solver(scene, *model);
        return model;
    }
    model->fluid = make_fluid<D>(scene);
    model->water = fill_with_water<D>(scene, model->fluid->tait, model->fluid->particles);
    set_initial_fields(*model->fluid, scene);
    if (const auto& force = scene.fluid->central_force) model->central_force = {force->centre.as<D>(), force->rate};
    if (scene.fluid->driving_force) model->driving_force = scene.fluid->driving_force->as<D>();
    if (scene.fluid->walls == io::WallMethod::normal_flux && (!scene.walls.empty() || scene.solid)) {
        fluid::NormalFluxWalls<D>& walls = model->flux_walls.emplace();
        add_walls(scene, walls.panels);
        model->moving = moving_walls(scene, walls.panels);
        model->fluid->wall_friction =
            fluid::wall_decay(walls.panels, scene.fluid->support_ratio, scene.fluid->viscous_operator);
        add_wall_works(scene, *model);
    } else if (!scene.walls.empty() || scene.solid || !scene.periodic.empty()) {
        fluid::GhostWalls<D>& walls = model->walls.emplace();
        add_walls(scene, walls.panels);
        make_periodic(scene, walls.periodic, model->fluid->domain);
        model->moving = moving_walls(scene, walls.panels);
        add_wall_works(scene, *model);
    }
    if constexpr (D == 2) {
        if (scene.solid) {
            model->solid = make_solid<2>(scene);
            choose_solver(scene, *model);
            model->interface = make_interface(scene, *model);
            model->cycle_step.rule = scene.coupling.step_rule;
            model->cycle_step.fraction = scene.coupling.step_fraction;
            model->cycle_step.held.band = step_band;
            if (model->interface->keeps_energy)
                model->wall_works.push_back(
                    {scene.solid->name, fluid::WallForces<2>(model->interface->surface.wall()), {}});
        }
    }
    if (model->walls) settle(scene, model->walls->panels, model->moving);
    if (model->flux_walls && !scene.periodic.empty()) repeat_walls(scene, *model);
    if (model->flux_walls) settle(scene, model->flux_walls->panels, model->moving);
    return model;
}

template <int D>
void start(Model<D>& model, const io::Scene& scene) {
    if (model.structure) return static_start(scene, model);
    if constexpr (D == 2)
        if (model.solid) start_solid(model, scene);
}

template std::unique_ptr<Model<2>> make_model(const io::Scene&);
template std::unique_ptr<Model<3>> make_model(const io::Scene&);
template void start(Model<2>&, const io::Scene&);
template void start(Model<3>&, const io::Scene&);

}  // namespace aquagraph::engine
