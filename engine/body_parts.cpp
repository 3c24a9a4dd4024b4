#include "engine/body_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "engine/calculix_solver.hpp"
#include "engine/solid_options.hpp"
#include "io/comparison.hpp"
#include "io/expression.hpp"
#include "io/scene_formulas.hpp"
#include "io/scene_reader.hpp"
#include "physics/solid/readers/calculix.hpp"
#include "physics/solid/readers/gmsh.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/stepping.hpp"
#include "tasks/structural_step.hpp"

namespace aquagraph::engine {

namespace {

template <int D>
solid::Mesh<D> read_mesh(const io::Scene& scene) {
    const std::filesystem::path& path = scene.solid->mesh;
    std::ifstream file(path);
    if (!file)
        throw io::scene_error(scene, "solid.mesh", "the mesh file " + path.string() + " cannot be opened",
                              "give the path of a Gmsh (.msh) or CalculiX (.inp) file, relative to the scene");
    try {
        if (path.extension() == ".inp") return solid::read_calculix<D>(file, path.string());
        return solid::read_gmsh<D>(
            file, path.string(),
            scene.solid->element_order == 1 ? solid::MeshOrder::linear : solid::MeshOrder::quadratic);
    } catch (const solid::MeshError& error) {
        throw io::scene_error(scene, "solid.mesh", error.what(), "mend the mesh, or mesh a box with [solid.box]");
    }
}

template <int D>
solid::Mesh<D> make_mesh(const io::Scene& scene) {
    const io::SolidScene& from = *scene.solid;
    if (!from.box) return read_mesh<D>(scene);
    const auto& n = from.elements;
    solid::Mesh<D> mesh;
    if constexpr (D == 2)
        mesh = solid::box_mesh(from.box->min.as<2>(), from.box->max.as<2>(), n[0], n[1]);
    else
        mesh = solid::box_mesh(from.box->min.as<3>(), from.box->max.as<3>(), n);
    return from.element_order == 1 ? solid::without_mid_side_nodes(mesh) : mesh;
}

// Straight lines between the points of a table, constant outside.
double interpolated(const io::Curve& table, double t) {
    const auto above = std::upper_bound(table.time.begin(), table.time.end(), t);
    if (above == table.time.begin()) return table.value.front();
    if (above == table.time.end()) return table.value.back();
    const auto k = std::size_t(above - table.time.begin());
    const double part = (t - table.time[k - 1]) / (table.time[k] - table.time[k - 1]);
    return table.value[k - 1] + part * (table.value[k] - table.value[k - 1]);
}

std::function<double(double)> factor_of(const io::Scene& scene, const io::LoadHistory& history) {
    if (!history.table.empty()) {
        io::Compare columns;
        columns.file = history.table;
        return [table = io::read_reference(columns)](double t) { return interpolated(table, t); };
    }
    if (history.formula.empty()) return {};
    // Held by pointer: functions are copied, formulas are not.
    const auto formula =
        std::make_shared<io::Expression>(history.formula, std::vector<std::string>{"t"}, io::all_constants(scene));
    return [formula](double t) { return (*formula)(std::span(&t, 1)); };
}

template <int D>
std::vector<solid::DeadLoad> make_loads(const io::Scene& scene, const solid::Mesh<D>& mesh) {
    std::vector<solid::DeadLoad> loads;
    std::string key;
    try {
        for (std::size_t k = 0; k < scene.solid->tractions.size(); ++k) {
            const io::TractionScene& traction = scene.solid->tractions[k];
            key = fmt::format("solid.traction[{}].surface", k);
            loads.push_back(
                {traction_forces(mesh, traction.surface, traction.value.as<D>()), factor_of(scene, traction.factor)});
        }
        for (std::size_t k = 0; k < scene.solid->forces.size(); ++k) {
            const io::ForceScene& force = scene.solid->forces[k];
            key = fmt::format("solid.force[{}].set", k);
            const std::vector<solid::NodeIndex> nodes =
                force.point ? std::vector{solid::NodeIndex(nearest_node(mesh, *force.point))}
                            : mesh.node_set(force.set);
            loads.push_back({shared_force(mesh, nodes, force.value.as<D>()), factor_of(scene, force.factor)});
        }
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, key, error.what(), "name a set of the mesh");
    }
    return loads;
}

}  // namespace

template <int D>
solid::Solver<D> make_solid(const io::Scene& scene) {
    try {
        return solid::Solver<D>(make_mesh<D>(scene), solid_options<D>(scene));
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, "solid", error.what(), "see [solid] in SCENES.md");
    }
}

template <int D>
void choose_solver(const io::Scene& scene, Model<D>& model) {
    if (scene.solid->solver == io::SolidSolver::built_in) return;
    if (scene.solid->velocity)
        throw io::scene_error(scene, "solid.velocity", "where CalculiX computes the body, it starts at rest",
                              "take `velocity` out, or solver = \"calculix\"");
    for (std::size_t k = 0; k < scene.solid->clamps.size(); ++k)
        if (!scene.solid->clamps[k].name.empty())
            throw io::scene_error(scene, fmt::format("solid.clamp[{}].name", k),
                                  "the force on a clamp is not known where CalculiX computes the body",
                                  "take the name out, or solver = \"calculix\"");
    try {
        model.other_solver = std::make_unique<CalculixSolver<D>>(*model.solid, scene.solid->program);
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, "solid.solver", error.what(), "see \"CalculiX\" in benchmarks/solid/README.md");
    } catch (const solid::SolverError& error) {
        throw io::scene_error(scene, scene.positions.contains("solid.program") ? "solid.program" : "solid.solver",
                              error.what(),
                              "install it (Debian: apt-get install calculix-ccx), or say where it is: program = "
                              "\"/path/to/ccx\" in [solid]");
    }
}

template <int D>
void make_structure(const io::Scene& scene, Model<D>& model) {
    model.solid = make_solid<D>(scene);
    Structure& structure = model.structure.emplace();
    structure.step = scene.solid->step;
    structure.is_static = scene.solid->is_static;
    structure.loads = make_loads(scene, model.solid->mesh());
    structure.forces.assign(D * model.solid->mesh().nodes.size(), 0.0);
}

// Of an explicit scheme: the scene's step, or the largest that is stable.
template <int D>
double explicit_step(const io::Scene& scene, const solid::Solver<D>& solid) {
    const double largest = solid.largest_stable_step();
    if (scene.solid->step > largest)
        throw io::scene_error(scene, "solid.scheme.step",
                              fmt::format("central differences are stable up to a step of {:.4g} s here", largest),
                              "take `step` out: the largest stable step is the default");
    return scene.solid->step > 0 ? scene.solid->step : largest;
}

template <int D>
void static_start(const io::Scene& scene, Model<D>& model) {
    if (scene.solid->static_start) {
        std::vector<double> forces(D * model.solid->mesh().nodes.size(), 0.0);
        if (model.structure) sum_at(model.structure->loads, 0, forces);
        solver_of(model).solve_static(forces, tasks::parallel_loop);
    }
    if (scene.solid->velocity) model.solid->set_velocity(scene.solid->velocity->as<D>());
    if (model.structure && scene.solid->scheme == solid::Scheme::central_difference)
        model.structure->step = explicit_step(scene, *model.solid);
}

template <int D>
std::vector<tasks::Task> structural_step(Model<D>& model) {
    Structure& structure = *model.structure;
    std::vector<tasks::Task> listing{tasks::structural_time_step(model.clock, structure.step),
                                     tasks::dead_loads(structure.loads, model.clock, structure.forces)};
    solid::Structure<D>& solver = solver_of(model);
    listing.push_back(structure.is_static ? tasks::structural_equilibrium(solver, structure.forces, model.clock)
                                          : tasks::structural_step(solver, structure.forces, model.clock));
    listing.push_back(tasks::advance_clock(model.clock, "step"));
    return listing;
}

template <int D>
std::size_t nearest_node(const solid::Mesh<D>& mesh, const io::Point& point) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        double distance2 = 0;
        for (std::size_t d = 0; d < D; ++d) distance2 += (mesh.nodes[n][d] - point[d]) * (mesh.nodes[n][d] - point[d]);
        if (distance2 < least) {
            least = distance2;
            nearest = n;
        }
    }
    return nearest;
}

#define AQUAGRAPH_INSTANTIATE(D)                                  \
    template solid::Solver<D> make_solid(const io::Scene&);       \
    template void choose_solver(const io::Scene&, Model<D>&);     \
    template void make_structure(const io::Scene&, Model<D>&);    \
    template void static_start(const io::Scene&, Model<D>&);      \
    template std::vector<tasks::Task> structural_step(Model<D>&); \
    template std::size_t nearest_node(const solid::Mesh<D>&, const io::Point&);
AQUAGRAPH_INSTANTIATE(2)
AQUAGRAPH_INSTANTIATE(3)
#undef AQUAGRAPH_INSTANTIATE

}  // namespace aquagraph::engine
