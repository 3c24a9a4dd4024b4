#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "tasks/dependencies.hpp"
#include "tasks/graph_drawing.hpp"

using namespace aquagraph::tasks;

namespace {

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// A coupling cycle of about seventy tasks.
std::vector<Task> cycle() {
    std::vector<Task> listing;
    for (int substep = 1; substep <= 3; ++substep) {
        const std::string group = "substep " + std::to_string(substep);
        listing.push_back(
            {.name = "neighbours", .reads = {"fluid.position"}, .writes = {"fluid.lists"}, .group = group});
        for (int stage = 1; stage <= 4; ++stage) {
            const std::string suffix = " (stage " + std::to_string(stage) + ")";
            const auto add = [&](const std::string& name, std::vector<std::string> reads,
                                 std::vector<std::string> writes) {
                listing.push_back(
                    {.name = name + suffix, .reads = std::move(reads), .writes = std::move(writes), .group = group});
            };
            add("walls", {"fluid.lists", "fluid.state", "walls.position"}, {"walls.state"});
            add("gradients", {"fluid.lists", "fluid.position", "fluid.state", "walls.state"}, {"fluid.gradients"});
            add("fluxes", {"fluid.lists", "fluid.position", "fluid.state", "fluid.gradients", "walls.state"},
                {"fluid.rates"});
            add("shifting", {"fluid.lists", "fluid.position"}, {"fluid.shift"});
            add("runge_kutta", {"fluid.rates", "fluid.shift"}, {"fluid.state", "fluid.position"});
        }
    }
    listing.push_back({.name = "newton", .reads = {"loads.old"}, .writes = {"solid.motion"}});
    listing.push_back(
        {.name = "exchange", .reads = {"solid.motion", "fluid.state"}, .writes = {"walls.position", "loads.old"}});
    return listing;
}

}  // namespace

TEST_CASE("a drawing has a node for every task and a line for every edge, with its reasons") {
    const std::vector<Task> listing = {
        {.name = "gradients", .reads = {"fluid.state"}, .writes = {"fluid.gradients"}},
        {.name = "fluxes (stage 1)", .reads = {"fluid.gradients"}, .writes = {"fluid.rates"}},
        {.name = "fluxes (stage 2)", .reads = {"fluid.lists"}, .writes = {"fluid.state"}}};
    const std::string dot = to_dot(listing, {.title = "one step"});
    CHECK(contains(dot, "t0 [label=\"gradients\""));
    CHECK(contains(dot, "t0 -> t1 [label=\"fluid.gradients\""));
    CHECK(contains(dot, "t0 -> t2 [label=\"fluid.state (WAR)\""));
    CHECK(occurrences(dot, "style=dashed") == 1);
    CHECK(occurrences(dot, " -> ") == 2);
    CHECK(contains(dot, "one step"));
    CHECK_FALSE(contains(to_dot(listing, {.edge_labels = false}), "[label=\"fluid.gradients\""));
    const auto colour_of = [&](const std::string& node) {
        const std::size_t at = dot.find("fillcolor", dot.find(node + " [label"));
        return dot.substr(at, 22);
    };
    CHECK(colour_of("t1") == colour_of("t2"));
    CHECK(colour_of("t0") != colour_of("t1"));
    CHECK(family_of("fluxes (stage 2)") == "fluxes");
    CHECK(family_of("newton: solve") == "newton");
    CHECK(family_of("exchange") == "exchange");
}

TEST_CASE("a cycle of seventy tasks is drawn in frames and dot accepts it, whatever the names") {
    std::vector<Task> listing = cycle();
    listing.push_back({.name = "odd \"name\" \\ with {everything} <b>", .reads = {"fluid"}, .writes = {"a", "b"}});
    listing.push_back({.name = "many", .reads = {"a", "b"}, .writes = {"fluid"}});
    const std::string dot = to_dot(listing);
    CHECK(occurrences(dot, "subgraph cluster_") == 3);
    CHECK(occurrences(dot, " -> ") == derive_edges(listing).size());
    CHECK(std::count(dot.begin(), dot.end(), '{') - 1 == std::count(dot.begin(), dot.end(), '}') - 1);

    if (std::system("command -v dot >/dev/null 2>&1") != 0) {
        MESSAGE("Graphviz is not installed: the text was not given to dot");
        return;
    }
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("aquagraph_drawing_" + std::to_string(std::random_device{}()));
    std::filesystem::create_directory(folder);
    std::ofstream(folder / "graph.dot") << dot;
    const std::string command =
        "dot -Tsvg -o '" + (folder / "graph.svg").string() + "' '" + (folder / "graph.dot").string() + "' 2>&1";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(std::filesystem::file_size(folder / "graph.svg") > 1000);
    std::filesystem::remove_all(folder);
}
