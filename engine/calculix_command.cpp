#include "engine/calculix_command.hpp"

#include <fmt/format.h>

#include <ostream>
#include <sstream>

#include "engine/body_parts.hpp"
#include "io/atomic_file.hpp"
#include "io/scene_reader.hpp"
#include "physics/solid/calculix_export.hpp"

namespace aquagraph::engine {

namespace {

template <int D>
void export_in(const io::Scene& scene, const std::filesystem::path& file, std::ostream& out) {
    Model<D> model;
    make_structure(scene, model);
    const solid::Mesh<D>& mesh = model.solid->mesh();
    solid::CalculixRun run;
    run.title = scene.title;
    run.is_static = scene.solid->is_static;
    run.static_start = scene.solid->static_start;
    run.step = scene.solid->step;
    run.end = scene.end_time;
    run.loads = model.structure->loads;
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

void export_calculix(const io::Scene& scene, const std::filesystem::path& file, std::ostream& out) {
    if (!scene.solid || scene.fluid)
        throw io::scene_error(scene, "fluid", "CalculiX computes a body alone, without water",
                              "give a scene with [solid] and without [fluid]");
    scene.dimension == 3 ? export_in<3>(scene, file, out) : export_in<2>(scene, file, out);
}

}  // namespace aquagraph::engine
