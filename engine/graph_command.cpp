#include "engine/graph_command.hpp"

#include <spawn.h>
#include <sys/wait.h>

#include <ostream>

#include "engine/listings.hpp"
#include "engine/results.hpp"
#include "io/atomic_file.hpp"
#include "tasks/dependencies.hpp"
#include "tasks/graph_drawing.hpp"

extern char** environ;

namespace aquagraph::engine {

namespace {

// Runs dot; false if it is not there or fails.
bool render(const std::filesystem::path& text, const std::filesystem::path& picture) {
    std::string program = "dot", format = "-Tsvg", option = "-o", from = text.string(), to = picture.string();
    char* arguments[] = {program.data(), format.data(), from.data(), option.data(), to.data(), nullptr};
    pid_t child = 0;
    if (posix_spawnp(&child, "dot", nullptr, nullptr, arguments, environ) != 0) return false;
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

template <int D>
std::vector<tasks::Task> listing_of(const io::Scene& scene) {
    const std::unique_ptr<Model<D>> model = make_model<D>(scene);
    std::vector<tasks::Task> listing = coupling_cycle(*model, scene.coupling);
    for (tasks::Task& task : result_tasks<D>(nullptr, make_diagnostics(scene, *model)))
        listing.push_back(std::move(task));
    return listing;  // to be looked at, not run: the model is gone
}

}  // namespace

void draw_graph(const io::Scene& scene, const std::filesystem::path& file, std::ostream& out) {
    const std::vector<tasks::Task> listing = scene.dimension == 3 ? listing_of<3>(scene) : listing_of<2>(scene);
    io::write_file_atomically(file, tasks::to_dot(listing, {.title = scene.title}));
    out << listing.size() << " tasks, " << tasks::derive_edges(listing).size() << " edges: " << file.string() << "\n";
    const std::filesystem::path picture = std::filesystem::path(file).replace_extension(".svg");
    if (render(file, picture))
        out << "picture: " << picture.string() << "\n";
    else
        out << "no picture: install graphviz for one\n";
}

}  // namespace aquagraph::engine
