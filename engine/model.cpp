#include "engine/model.hpp"

#include <fstream>
#include <limits>

#include "io/scene_reader.hpp"
#include "physics/fluid/filling.hpp"
#include "physics/fluid/rebuild.hpp"
#include "physics/solid/gmsh_mesh.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/solid_step.hpp"
#include "tasks/walls.hpp"

namespace aquagraph::engine {

namespace {

using fluid::Vec2;

fluid::Fluid<2> make_fluid(const io::Scene& scene) {
    const io::FluidScene& from = *scene.fluid;
    fluid::Fluid<2> made{
        .spacing = from.spacing,
        .tait = {from.density, from.sound_speed, from.polytropic_exponent},
        .kernel = fluid::WendlandC2<2>(from.support_ratio * from.spacing),
        .flux = {from.reconstruction == io::Reconstruction::muscl, {scene.gravity[0], scene.gravity[1], 0}},
        .cfl = from.cfl,
        .domain = {scene.domain.min, scene.domain.max},
        .closed = scene.edge == io::DomainEdge::closed,
        .particles = {},
        .lists = {},
        .runge_kutta = {},
        .search = {},
        .order = {},
        .reorder = {},
    };
    made.lists.radius = made.kernel.radius();
    made.lists.skin = fluid::skin_ratio * made.kernel.radius();
    std::vector<fluid::FillBox<2>> boxes;
    double top = std::numeric_limits<double>::lowest();
    for (const io::Box& box : from.boxes) {
        boxes.push_back({box.min, box.max});
        top = std::max(top, box.max[1]);
    }
    std::optional<double> level;
    if (from.initial_pressure == io::InitialPressure::hydrostatic) level = from.surface_level.value_or(top);
    fill(made.particles, boxes, made.spacing, made.tait, -scene.gravity[1], level);
    return made;
}

solid::Mesh make_mesh(const io::Scene& scene) {
    const io::SolidScene& from = *scene.solid;
    if (from.box) return solid::box_mesh(from.box->min, from.box->max, from.elements[0], from.elements[1]);
    std::ifstream file(from.mesh);
    if (!file)
        throw io::scene_error(scene, "solid.mesh", "the mesh file " + from.mesh.string() + " cannot be opened",
                              "give the path of a Gmsh 4.1 file, relative to the scene");
    try {
        return solid::read_gmsh(file, from.mesh.string());
    } catch (const solid::MeshError& error) {
        throw io::scene_error(scene, "solid.mesh", error.what(), "mend the mesh, or mesh a box with [solid.box]");
    }
}

solid::Solver make_solid(const io::Scene& scene) {
    const io::SolidScene& from = *scene.solid;
    solid::Options options;
    options.law = from.law == io::MaterialLaw::neo_hookean ? solid::MaterialLaw::neo_hookean
                                                           : solid::MaterialLaw::saint_venant_kirchhoff;
    options.plane =
        from.plane == io::PlaneCondition::stress ? solid::PlaneCondition::stress : solid::PlaneCondition::strain;
    options.youngs_modulus = from.youngs_modulus;
    options.poissons_ratio = from.poissons_ratio;
    options.density = from.density;
    options.gravity = scene.gravity;
    options.scheme = from.scheme == io::SolidScheme::newmark ? solid::Scheme::newmark : solid::Scheme::hht;
    options.alpha = from.alpha;
    for (const io::Clamp& clamp : from.clamps) options.clamps.push_back({clamp.set, clamp.fixed});
    try {
        return solid::Solver(make_mesh(scene), options);
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, "solid", error.what(), "see [solid] in SCENES.md");
    }
}

// Even–odd rule on the boundary of the mesh.
bool inside(const solid::Mesh& mesh, const std::vector<solid::SurfaceEdge>& boundary, double x, double y) {
    bool odd = false;
    for (const auto& [a, b, middle] : boundary) {
        const auto &p = mesh.nodes[std::size_t(a)], &q = mesh.nodes[std::size_t(b)];
        if ((p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])) odd = !odd;
    }
    return odd;
}

void refuse_water_inside(const io::Scene& scene, const Model& model) {
    const auto& mesh = model.solid->mesh();
    const auto boundary = solid::boundary_edges(mesh);
    const auto& particles = model.fluid->particles;
    for (std::size_t i = 0; i < particles.count; ++i)
        if (inside(mesh, boundary, particles.x[0][i], particles.x[1][i]))
            throw io::scene_error(scene, "fluid.box[0]",
                                  "there is water inside the solid, at (" + std::to_string(particles.x[0][i]) + ", " +
                                      std::to_string(particles.x[1][i]) + ") m",
                                  "cut the box so that it ends at the solid's surface");
}

}  // namespace

std::unique_ptr<Model> make_model(const io::Scene& scene) {
    if (!scene.fluid)  // nothing would set the time step
        throw io::scene_error(scene, "solid", "there is no water in this scene, and a solid alone cannot be run yet",
                              "add [fluid]");
    auto model = std::make_unique<Model>();
    model->clock.end = scene.end_time;
    if (scene.fluid) model->fluid = make_fluid(scene);
    if (scene.solid) model->solid = make_solid(scene);
    if (scene.fluid && (!scene.walls.empty() || scene.solid)) {
        fluid::GhostWalls& walls = model->walls.emplace();
        for (const io::WallScene& wall : scene.walls) {
            std::vector<Vec2> points;
            for (const io::Point& p : wall.points) points.emplace_back(p[0], p[1]);
            walls.panels.add_wall(wall.name, points, wall.closed, wall.slip == io::Slip::none);
        }
    }
    if (scene.fluid && scene.solid) {
        refuse_water_inside(scene, *model);
        coupling::Interface& interface = model->interface.emplace();
        try {
            interface.surface =
                coupling::WetSurface(model->solid->mesh(), scene.solid->wet, scene.solid->name, model->walls->panels);
        } catch (const std::invalid_argument& error) {
            throw io::scene_error(scene, "solid.wet", error.what(), "name surfaces of the mesh");
        }
        interface.fluid_loads.assign(2 * model->solid->mesh().nodes.size(), 0.0);
        interface.solid_loads = interface.fluid_loads;
    }
    if (model->walls) {
        model->walls->panels.update_geometry();
        model->walls->panels.find_joints();
    }
    return model;
}

void start(Model& model, const io::Scene& scene) {
    if (!model.solid) return;
    if (scene.solid->static_start) {
        const std::vector<double> no_loads(2 * model.solid->mesh().nodes.size(), 0.0);
        model.solid->solve_static(no_loads, tasks::parallel_loop);
    }
    if (!model.interface) return;

    // The water's load on the solid at t = 0, which the first solve of CPS reads.
    fluid::Fluid<2>& fluid = *model.fluid;
    fluid::GhostWalls& walls = *model.walls;
    coupling::Interface& interface = *model.interface;
    interface.surface.take(model.solid->positions(), model.solid->velocities());
    interface.surface.place(walls.panels, 0);
    rebuild_lists(fluid, &walls, tasks::parallel_loop);
    interface.load.rebuild(fluid.particles, fluid.lists, walls);
    for (const tasks::Task& task :
         {tasks::interface_gradients(fluid, interface), tasks::ghost_gradients(fluid, walls, "start"),
          tasks::interface_loads(fluid, walls, interface)})
        task.body();
    interface.solid_loads = interface.fluid_loads;
}

std::size_t nearest_node(const solid::Mesh& mesh, const io::Point& point) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const double dx = mesh.nodes[n][0] - point[0], dy = mesh.nodes[n][1] - point[1];
        if (dx * dx + dy * dy < least) {
            least = dx * dx + dy * dy;
            nearest = n;
        }
    }
    return nearest;
}

double bytes_per_particle(const fluid::Fluid<2>& fluid) {
    const auto& s = fluid.particles;
    if (s.count == 0) return 0;
    // Numbers per lane: 22 of Particles and 10 of RungeKutta for the fluid, 13 for ghosts.
    const double fluid_lanes = double(s.clusters() * fluid::W), ghost_lanes = double(s.ghost_clusters * fluid::W);
    double bytes = 8 * (32 * fluid_lanes + 13 * ghost_lanes);
    for (const auto& block : fluid.lists.blocks)
        bytes += 4 * double(block.open.capacity() + block.masked.capacity()) + double(block.mask.capacity()) +
                 8 * double(block.particle.capacity());
    return bytes / double(s.count);
}

}  // namespace aquagraph::engine
