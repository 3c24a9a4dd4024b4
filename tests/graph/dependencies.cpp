#include "tasks/dependencies.hpp"

#include <doctest/doctest.h>

#include "tests/graph/random_listing.hpp"

using namespace aquagraph::tasks;
using aquagraph::tests::must_stay_in_order;
using aquagraph::tests::random_listing;

namespace {

using Matrix = std::vector<std::vector<char>>;

void close_transitively(Matrix& reach) {
    for (std::size_t via = 0; via < reach.size(); ++via)
        for (std::size_t from = 0; from < reach.size(); ++from)
            for (std::size_t to = 0; reach[from][via] && to < reach.size(); ++to)
                if (reach[via][to]) reach[from][to] = 1;
}

Matrix reachability(std::size_t tasks, const std::vector<Edge>& edges, std::size_t left_out) {
    Matrix reach(tasks, std::vector<char>(tasks));
    for (std::size_t edge = 0; edge < edges.size(); ++edge)
        if (edge != left_out) reach[edges[edge].from][edges[edge].to] = 1;
    close_transitively(reach);
    return reach;
}

std::string text(const std::vector<Edge>& edges) {
    std::string result;
    for (const Edge& edge : edges) {
        result += std::to_string(edge.from) + ">" + std::to_string(edge.to);
        for (const Hazard& hazard : edge.hazards)
            result += std::string(" ") + to_string(hazard.kind) + " " + hazard.resource;
        result += "; ";
    }
    return result;
}

}  // namespace

TEST_CASE("each kind of hazard makes an edge, two readers make none") {
    CHECK(text(derive_edges(std::vector<Task>{{.name = "a", .writes = {"x"}}, {.name = "b", .reads = {"x"}}})) ==
          "0>1 read after write x; ");
    CHECK(text(derive_edges(std::vector<Task>{{.name = "a", .reads = {"x"}}, {.name = "b", .writes = {"x"}}})) ==
          "0>1 write after read x; ");
    CHECK(text(derive_edges(std::vector<Task>{{.name = "a", .writes = {"x"}}, {.name = "b", .writes = {"x"}}})) ==
          "0>1 write after write x; ");
    CHECK(derive_edges(std::vector<Task>{{.name = "a", .reads = {"x"}}, {.name = "b", .reads = {"x"}}}).empty());
    CHECK(derive_edges(std::vector<Task>{{.name = "a", .writes = {"x"}}, {.name = "b", .writes = {"y"}}}).empty());
    CHECK(derive_edges({}).empty());
}

TEST_CASE("an edge lists every resource once, with the strongest reason") {
    const std::vector<Task> listing = {{.name = "a", .reads = {"x", "y"}, .writes = {"x", "z"}},
                                       {.name = "b", .reads = {"x"}, .writes = {"x", "y", "z"}}};
    CHECK(text(derive_edges(listing)) == "0>1 read after write x write after read y write after write z; ");
}

TEST_CASE("a resource stands for its parts, but not for names that merely begin alike") {
    CHECK(overlap("fluid", "fluid"));
    CHECK(overlap("fluid", "fluid.density"));
    CHECK(overlap("fluid.density", "fluid"));
    CHECK_FALSE(overlap("fluid", "fluid_old"));
    CHECK_FALSE(overlap("fluid.density", "fluid.densities"));
    CHECK_FALSE(overlap("fluid.density", "fluid.velocity"));
    const std::vector<Task> listing = {{.name = "density", .writes = {"fluid.density"}},
                                       {.name = "sort", .reads = {"fluid"}, .writes = {"fluid"}},
                                       {.name = "solve", .writes = {"fluid_loads"}}};
    CHECK(text(derive_edges(listing)) == "0>1 read after write fluid.density; ");
}

TEST_CASE("an edge that follows from two others is left out") {
    const std::vector<Task> listing = {{.name = "a", .writes = {"x"}},
                                       {.name = "b", .reads = {"x"}, .writes = {"y"}},
                                       {.name = "c", .reads = {"x", "y"}}};
    CHECK(text(derive_edges(listing)) == "0>1 read after write x; 1>2 read after write y; ");
}

TEST_CASE("parallel and serial staggering differ by which loads the solve reads") {
    const auto cycle = [](const std::string& loads) {
        return std::vector<Task>{
            {.name = "fluid", .reads = {"solid.position"}, .writes = {"loads.new"}},
            {.name = "solve", .reads = {loads}, .writes = {"solid.motion"}},
            {.name = "exchange", .reads = {"loads.new", "solid.motion"}, .writes = {"solid.position"}}};
    };
    CHECK(text(derive_edges(cycle("loads.old"))) ==
          "0>2 read after write loads.new write after read solid.position; 1>2 read after write solid.motion; ");
    CHECK(derive_edges(cycle("loads.new")).size() == 2);
    CHECK(derive_edges(cycle("loads.new"))[0].to == 1);
}

TEST_CASE("on random listings the edges order exactly what must be ordered, and none can be removed") {
    std::mt19937 random(20260101);
    for (int trial = 0; trial < 300; ++trial) {
        const std::size_t tasks = 2 + random() % 24;
        const std::vector<Task> listing = random_listing(random, tasks, 2 + random() % 12);
        const std::vector<Edge> edges = derive_edges(listing);

        Matrix expected(tasks, std::vector<char>(tasks));
        for (std::size_t to = 0; to < tasks; ++to)
            for (std::size_t from = 0; from < to; ++from)
                expected[from][to] = must_stay_in_order(listing[from], listing[to]);
        close_transitively(expected);
        REQUIRE(reachability(tasks, edges, edges.size()) == expected);

        for (std::size_t edge = 0; edge < edges.size(); ++edge) {
            REQUIRE(must_stay_in_order(listing[edges[edge].from], listing[edges[edge].to]));
            REQUIRE_FALSE(edges[edge].hazards.empty());
            REQUIRE(reachability(tasks, edges, edge) != expected);
        }
    }
}
