#include "engine/solid_parts.hpp"

#include "engine/body_parts.hpp"
#include "engine/listings.hpp"
#include "io/scene_reader.hpp"
#include "physics/fluid/rebuild.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::engine {

namespace {

// The boundary of the mesh as straight pieces, as fine along a curved edge of a quadratic element as it takes.
std::vector<std::array<fluid::Vec2, 2>> outline(const solid::Mesh<2>& mesh) {
    constexpr int pieces = 16;  // of a curved edge: off by its height over 256
    const auto node = [&](int n) {
        const auto& x = mesh.nodes[std::size_t(n)];
        return fluid::Vec2(x[0], x[1]);
    };
    std::vector<std::array<fluid::Vec2, 2>> made;
    for (const solid::Facet& edge : solid::boundary_facets(mesh)) {
        const fluid::Vec2 a = node(edge[0]), b = node(edge[1]);
        if (edge.size() == 2) {
            made.push_back({a, b});
            continue;
        }
        const fluid::Vec2 middle = node(edge[2]);
        fluid::Vec2 from = a;
        for (int k = 1; k <= pieces; ++k) {  // ends exactly where the next edge begins
            const double s = double(k) / pieces;
            const fluid::Vec2 to =
                k == pieces ? b : (1 - s) * (1 - 2 * s) * a + 4 * s * (1 - s) * middle + s * (2 * s - 1) * b;
            made.push_back({from, to});
            from = to;
        }
    }
    return made;
}

// Even–odd rule.
bool inside(const std::vector<std::array<fluid::Vec2, 2>>& outline, double x, double y) {
    bool odd = false;
    for (const auto& [p, q] : outline)
        if ((p.y() > y) != (q.y() > y) && x < p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x())) odd = !odd;
    return odd;
}

// The key of the water that a particle belongs to, before any has been re-sorted.
std::string body_of(const Model<2>& model, std::size_t particle) {
    for (const FilledBody& body : model.water) {
        if (particle < body.particles) return body.key;
        particle -= body.particles;
    }
    return "fluid";
}

void refuse_water_inside(const io::Scene& scene, const Model<2>& model) {
    const auto boundary = outline(model.solid->mesh());
    const auto& particles = model.fluid->particles;
    for (std::size_t i = 0; i < particles.count; ++i)
        if (inside(boundary, particles.x[0][i], particles.x[1][i]))
            throw io::scene_error(scene, body_of(model, i),
                                  "there is water inside the solid, at (" + std::to_string(particles.x[0][i]) + ", " +
                                      std::to_string(particles.x[1][i]) + ") m",
                                  "cut the water so that it ends at the solid's surface");
}

// A set of nodes may well be there under this name, and bear no load.
template <class Mesh>
void refuse_wet_nodes(const io::Scene& scene, const Mesh& mesh) {
    for (std::size_t k = 0; k < scene.solid->wet.size(); ++k) {
        const std::string& name = scene.solid->wet[k];
        if (mesh.surfaces.contains(name) || !mesh.node_sets.contains(name)) continue;
        std::string known;
        for (const auto& [other, content] : mesh.surfaces) known += (known.empty() ? "" : ", ") + other;
        throw io::scene_error(scene, "solid.wet[" + std::to_string(k) + "]",
                              "'" + name +
                                  "' is a set of nodes, and no surface: none of its nodes are joined by edges "
                                  "of the body's boundary",
                              known.empty() ? "name the wet curves of the boundary as physical curves of the mesh"
                                            : "the body's surfaces are " + known);
    }
}

// Where no water can come the coupling would do nothing, and say nothing.
void refuse_out_of_reach(const io::Scene& scene, const Model<2>& model) {
    const fluid::Panels<2>& panels = panels_of(model);
    const double reach = model.fluid->kernel.radius();
    for (const fluid::Panel<2>& panel : panels.panels) {
        if (!panel.wet) continue;
        for (const int v : panel.vertex) {
            const fluid::Vec2& x = panels.position[std::size_t(v)];
            bool inside = true;
            for (int d = 0; d < 2; ++d)
                inside = inside && x[d] >= scene.domain.min[std::size_t(d)] - reach &&
                         x[d] <= scene.domain.max[std::size_t(d)] + reach;
            if (inside) return;
        }
    }
    throw io::scene_error(scene, scene.solid->box ? "solid.box" : "solid.mesh",
                          "the body's wet surfaces lie outside the domain: no water will ever reach them",
                          "move the body to the water, or enlarge [domain]");
}

}  // namespace

coupling::Interface make_interface(const io::Scene& scene, Model<2>& model) {
    refuse_water_inside(scene, model);
    refuse_wet_nodes(scene, model.solid->mesh());
    coupling::Interface interface;
    interface.method = scene.coupling.load;
    interface.correction.cycles = scene.coupling.energy_cycles;
    interface.keeps_energy =
        scene.output.energy_ledger || interface.method == coupling::LoadMethod::energy_conservative;
    interface.fixed_point.choices.relaxation = scene.coupling.relaxation;
    interface.fixed_point.choices.tolerance = scene.coupling.tolerance;
    interface.fixed_point.choices.most = scene.coupling.most_iterations;
    interface.ratio = {.regulated = scene.coupling.ratio_control,
                       .most = scene.coupling.ratio,
                       .p = scene.coupling.ratio_control ? 1 : scene.coupling.ratio};
    try {
        interface.surface = coupling::WetSurface(model.solid->mesh(), scene.solid->wet, scene.solid->name,
                                                 panels_of(model), scene.coupling.smoothing * scene.fluid->spacing);
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, "solid.wet", error.what(), "name surfaces of the mesh");
    }
    refuse_out_of_reach(scene, model);
    interface.surface.extrapolation = scene.coupling.extrapolation;
    interface.fluid_loads.assign(2 * model.solid->mesh().nodes.size(), 0.0);
    interface.solid_loads = interface.fluid_loads;
    return interface;
}

void start_solid(Model<2>& model, const io::Scene& scene) {
    static_start(scene, model);
    if (!model.interface) return;

    // The water's load on the solid at t = 0, which the first solve of CPS reads.
    fluid::Fluid<2>& fluid = *model.fluid;
    coupling::Interface& interface = *model.interface;
    const solid::Structure<2>& solver = solver_of(model);
    interface.surface.take(solver.positions(), solver.velocities());
    interface.surface.place(panels_of(model), 0);
    if (model.flux_walls) {
        rebuild_lists(fluid, *model.flux_walls, tasks::parallel_loop);
        interface.rebuild(fluid, *model.flux_walls);
    } else {
        rebuild_lists(fluid, &*model.walls, tasks::parallel_loop);
        interface.rebuild(fluid, *model.walls);
    }
    for (const tasks::Task& task : first_loads(model)) task.body();
    interface.solid_loads = interface.fluid_loads;
    interface.ratio.begin(interface.force);
    if (interface.keeps_energy) {
        interface.energy.solid_at_start = solver.energies().stored();
    }
}

}  // namespace aquagraph::engine
