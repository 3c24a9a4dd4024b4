#include "engine/calculix_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <ostream>
#include <sstream>

#include "engine/body_parts.hpp"
#include "io/atomic_file.hpp"
#include "io/history.hpp"
#include "io/scene_reader.hpp"
#include "physics/solid/calculix_export.hpp"

namespace aquagraph::engine {

namespace {

// The loads that the solves of a run have read, by when those ended: CPS reads those of the row before; the first solve
// takes its loads as constant.
void replay(const io::Scene& scene, const std::filesystem::path& file, std::size_t freedoms, solid::CalculixRun& run) {
    const io::History history = io::read_history(file);
    const auto times = history.time();
    const std::size_t rows = times.size();
    const bool parallel = scene.coupling.algorithm == io::CouplingAlgorithm::cps;
    const auto time = std::make_shared<std::vector<double>>(times.begin(), times.end());
    for (std::size_t c = 0; c < history.columns.size() && rows > 1; ++c) {
        int node = 0;
        char direction = 0, rest = 0;
        if (std::sscanf(history.columns[c].name.c_str(), "load_%d_%c%c", &node, &direction, &rest) != 2) continue;
        const std::size_t freedom = 2 * std::size_t(node - 1) + (direction == 'y');
        if (node < 1 || freedom >= freedoms)
            throw std::runtime_error(fmt::format("{}: the body has no node {}", file.string(), node));
        const auto value = std::make_shared<std::vector<double>>(rows);
        for (std::size_t k = 0; k < rows; ++k)
            (*value)[k] = history.values[c][parallel ? std::max<std::size_t>(k, 1) - 1 : std::max<std::size_t>(k, 1)];
        solid::DeadLoad& load = run.loads.emplace_back();
        load.forces.assign(freedoms, 0.0);
        load.forces[freedom] = 1;
        load.factor = [time, value](double t) {
            const auto above = std::upper_bound(time->begin(), time->end(), t);
            if (above == time->begin()) return value->front();
            if (above == time->end()) return value->back();
            const auto k = std::size_t(above - time->begin());
            const double part = (t - (*time)[k - 1]) / ((*time)[k] - (*time)[k - 1]);
            return (*value)[k - 1] + part * ((*value)[k] - (*value)[k - 1]);
        };
    }
    if (run.loads.empty())
        throw std::runtime_error(
            fmt::format("{} has no columns load_N_x and load_N_y: run the scene with [output] interface_loads = true",
                        file.string()));
    run.unloaded_start = true;
    run.end = times.back();
    run.step = run.end / double(rows - 1);
}

template <int D>
void export_in(const io::Scene& scene, const std::filesystem::path& file, const std::filesystem::path& loads,
               std::ostream& out) {
    Model<D> model;
    if (scene.fluid)
        model.solid = make_solid<D>(scene);
    else
        make_structure(scene, model);
    const solid::Mesh<D>& mesh = model.solid->mesh();
    solid::CalculixRun run;
    run.title = scene.title;
    run.is_static = scene.solid->is_static;
    run.static_start = scene.solid->static_start;
    run.step = scene.solid->step;
    run.end = scene.end_time;
    if (model.structure) run.loads = model.structure->loads;
    if (!loads.empty()) replay(scene, loads, D * mesh.nodes.size(), run);
    for (const io::Track& track : scene.solid->tracks)
        run.printed.push_back(solid::NodeIndex(nearest_node(mesh, track.point)));
    std::ostringstream deck;
    try {
        write_calculix(deck, mesh, model.solid->options(), run);
    } catch (const std::invalid_argument& error) {
        throw io::scene_error(scene, "solid", error.what(), "see \"CalculiX\" in benchmarks/solid/README.md");
    }
    io::write_file_atomically(file, deck.str());
    out << fmt::format("{}: {} nodes, {} elements; run it with: ccx -i {}\n", file.string(), mesh.nodes.size(),
                       mesh.elements.size(), file.stem().string());
    for (std::size_t k = 0; k < run.printed.size(); ++k)
        out << fmt::format("track {} is node {}\n", scene.solid->tracks[k].name, run.printed[k] + 1);
}

}  // namespace

void export_calculix(const io::Scene& scene, const std::filesystem::path& file, const std::filesystem::path& loads,
                     std::ostream& out) {
    if (!scene.solid || (scene.fluid && loads.empty()))
        throw io::scene_error(scene, "fluid", "CalculiX computes a body alone, without water",
                              "give a scene with [solid] and without [fluid], or with --loads the history of a run");
    if (!scene.fluid && !loads.empty())
        throw io::scene_error(scene, "solid", "no water acts on this body", "leave --loads out");
    scene.dimension == 3 ? export_in<3>(scene, file, loads, out) : export_in<2>(scene, file, loads, out);
}

}  // namespace aquagraph::engine
