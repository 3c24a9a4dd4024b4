// The listing of a coupling cycle and the edges derived from it: what waits for what, and what is not there at all.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tasks/dependencies.hpp"
#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// after[k][m]: task k starts only when m has finished.
class Order {
  public:
    explicit Order(const std::vector<tasks::Task>& listing)
        : after_(listing.size(), std::vector<bool>(listing.size(), false)) {
        for (const tasks::Edge& edge : tasks::derive_edges(listing)) {  // sorted by `to`: ancestors are complete
            after_[edge.to][edge.from] = true;
            for (std::size_t m = 0; m < listing.size(); ++m)
                if (after_[edge.from][m]) after_[edge.to][m] = true;
        }
    }
    bool path(std::size_t from, std::size_t to) const { return after_[to][from]; }

  private:
    std::vector<std::vector<bool>> after_;
};

std::vector<std::size_t> places(const std::vector<tasks::Task>& listing, std::string_view beginning) {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < listing.size(); ++k)
        if (listing[k].name.starts_with(beginning)) found.push_back(k);
    return found;
}

// The one task of this name in this step of the cycle.
std::size_t place(const std::vector<tasks::Task>& listing, const std::string& name, const std::string& step) {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < listing.size(); ++k)
        if (listing[k].name == name && listing[k].group.starts_with(step)) found.push_back(k);
    INFO(name, " in ", step);
    REQUIRE(found.size() == 1);
    return found.front();
}

std::string words(const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& word : list) text += word + " ";
    return text;
}

}  // namespace

TEST_CASE("the solve waits for the fluid of its cycle in CSS and not in CPS") {
    for (const int p : {1, 3}) {
        CAPTURE(p);
        const Built cps(with_coupling(gate, "cps", p)), css(with_coupling(gate, "css", p));
        const Order in_cps(cps.listing), in_css(css.listing);
        const std::size_t cps_solve = cps.place("FE Newton solve"), css_solve = css.place("FE Newton solve");
        const auto cps_fluxes = places(cps.listing, "fluxes"), css_fluxes = places(css.listing, "fluxes");
        REQUIRE(cps_fluxes.size() == std::size_t(4 * p));
        REQUIRE(css_fluxes.size() == std::size_t(4 * p));
        for (const std::size_t flux : cps_fluxes) {
            CHECK_FALSE(in_cps.path(flux, cps_solve));
            CHECK_FALSE(in_cps.path(cps_solve, flux));  // side by side: neither waits
        }
        for (const std::size_t flux : css_fluxes) CHECK(in_css.path(flux, css_solve));

        // In CPS the solve needs the length of the cycle and nothing else.
        for (std::size_t k = 0; k < cps.listing.size(); ++k) {
            CAPTURE(cps.listing[k].name);
            CHECK(in_cps.path(k, cps_solve) == (cps.listing[k].name == "time step"));
        }
    }
}

TEST_CASE("CPS and CSS are the same listing but for the step and the loads that the solve reads") {
    const int p = 2;
    const Built cps(with_coupling(gate, "cps", p)), css(with_coupling(gate, "css", p));
    CHECK(places(cps.listing, "time step").size() == 1);               // fixed for the whole cycle
    CHECK(places(css.listing, "time step").size() == std::size_t(p));  // chosen anew each step
    const auto rest = [](const std::vector<tasks::Task>& listing, bool of_solve) {
        std::vector<std::string> lines;
        for (const tasks::Task& task : listing) {
            if (task.name.starts_with("time step")) continue;
            if ((task.name == "FE Newton solve") != of_solve) continue;
            lines.push_back(task.group + ": " + task.name + " | " + words(task.reads) + "| " + words(task.writes));
        }
        return lines;
    };
    CHECK(rest(cps.listing, false) == rest(css.listing, false));
    const tasks::Task &parallel = cps.listing[cps.place("FE Newton solve")],
                      &serial = css.listing[css.place("FE Newton solve")];
    CHECK(words(parallel.writes) == words(serial.writes));
    CHECK(words(parallel.reads) == "clock.cycle solid.loads ");
    CHECK(words(serial.reads) == "clock.cycle interface.loads ");
}

TEST_CASE("a cycle has p fluid steps of four stages and one of everything else") {
    for (const char* algorithm : {"cps", "css"})
        for (const int p : {1, 2, 5}) {
            CAPTURE(algorithm);
            CAPTURE(p);
            const Built built(with_coupling(gate, algorithm, p));
            std::map<std::string, int> number;
            for (const tasks::Task& task : built.listing) ++number[task.name.substr(0, task.name.find(" ("))];
            CHECK(number["fluxes"] == 4 * p);
            CHECK(number["Runge-Kutta"] == 4 * p);
            CHECK(number["neighbour search"] == p);
            CHECK(number["examine"] == p);
            CHECK(number["wall contact"] == p);
            CHECK(number["clock"] == p);
            for (const char* refreshed : {"wall motion", "ghosts", "gradients", "ghost gradients"})
                CHECK(number[refreshed] == 4 * p + 1);  // and once more for the load
            CHECK(number["interface loads"] == 1);
            CHECK(number["FE Newton solve"] == 1);
            CHECK(number["exchange"] == 1);
        }
}

TEST_CASE("physics that a scene does not have is a task that is not there") {
    const auto families = [](const Built& built) {
        std::set<std::string> found;
        for (const tasks::Task& task : built.listing) found.insert(task.name.substr(0, task.name.find(" (")));
        return found;
    };
    const std::set<std::string> of_fluid{"time step", "neighbour search", "gradients", "fluxes", "Runge-Kutta",
                                         "clock",     "examine"};
    std::set<std::string> of_walls = of_fluid;
    of_walls.insert({"ghosts", "ghost gradients", "wall contact"});  // rigid: they do not move
    std::set<std::string> of_all = of_walls;
    of_all.insert({"wall motion", "interface loads", "FE Newton solve", "exchange"});

    const std::string drop =
        with(column, column.substr(column.find("[[wall]]"), column.find("[output]") - column.find("[[wall]]")), "");
    CHECK(families(Built(drop)) == of_fluid);
    CHECK(families(Built(column)) == of_walls);
    CHECK(families(Built(gate)) == of_all);
    CHECK(families(Built(strip)) == of_all);  // no rigid wall, but the body is one
    CHECK_FALSE(Built(drop).model->walls.has_value());
    CHECK_FALSE(Built(column).model->solid.has_value());
}

TEST_CASE("every dependency of the algorithm is an edge or a path") {
    for (const char* algorithm : {"cps", "css"}) {
        CAPTURE(algorithm);
        const int p = 2;
        const Built built(with_coupling(gate, algorithm, p));
        const auto& listing = built.listing;
        const Order order(listing);
        const auto chain = [&](const std::vector<std::size_t>& tasks) {
            for (std::size_t k = 0; k + 1 < tasks.size(); ++k) {
                INFO(listing[tasks[k + 1]].name, " after ", listing[tasks[k]].name);
                CHECK(order.path(tasks[k], tasks[k + 1]));
            }
        };
        std::vector<std::size_t> all{places(listing, "time step").front()};
        std::vector<std::size_t> walls;
        for (int step = 1; step <= p; ++step) {
            const std::string in_step = "step " + std::to_string(step);
            all.push_back(place(listing, "neighbour search (" + in_step + ")", in_step));
            walls.push_back(all.back());
            for (int s = 1; s <= 4; ++s) {
                const std::string stage = " (stage " + std::to_string(s) + ")";
                const auto of_stage = [&](const std::string& name) { return place(listing, name + stage, in_step); };
                // Boundary data are refreshed at every substep; a ghost's gradient is its parent's, mirrored.
                for (const char* name : {"ghosts", "gradients", "ghost gradients", "fluxes", "Runge-Kutta"})
                    all.push_back(of_stage(name));
                // Walls go on as soon as nobody looks at them any more, beside fluxes and stages.
                for (const char* name : {"wall motion", "ghosts", "ghost gradients"}) walls.push_back(of_stage(name));
            }
            all.push_back(place(listing, "wall contact (" + in_step + ")", in_step));
            walls.push_back(all.back());
            if (step < p) continue;
            const std::size_t examine = place(listing, "examine (" + in_step + ")", in_step),
                              clock = place(listing, "clock (" + in_step + ")", in_step);
            CHECK(order.path(all.back(), examine));
            CHECK(order.path(place(listing, "Runge-Kutta (stage 4)", in_step), clock));
            CHECK(order.path(clock, built.place("wall motion (interface)")));
        }
        for (const char* name : {"wall motion (interface)", "ghosts (interface)"}) walls.push_back(built.place(name));
        chain(walls);
        // The state reached at the end of the cycle is the one that loads the body.
        all.push_back(built.place("ghosts (interface)"));
        for (const char* name : {"gradients (interface)", "ghost gradients (interface)", "interface loads", "exchange"})
            all.push_back(built.place(name));
        chain(all);
        chain({built.place("FE Newton solve"), built.place("exchange")});

        // A step begins when the particles of the one before have been examined and moved.
        const std::size_t second = place(listing, "neighbour search (step 2)", "step 2");
        CHECK(order.path(place(listing, "examine (step 1)", "step 1"), second));
        CHECK(order.path(place(listing, "clock (step 1)", "step 1"), second));
    }
}
