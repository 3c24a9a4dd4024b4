// What `check` foretells, beside what the run then is.
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "engine/check.hpp"
#include "engine/forecast.hpp"
#include "physics/fluid/rebuild.hpp"
#include "tasks/parallel_loop.hpp"
#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

engine::Forecast forecast_of(const std::string& text, int threads) {
    Built built(text, threads);
    engine::Model<2>& model = *built.model;
    if (model.fluid)
        built.executor.execute(
            [&] { rebuild_lists(*model.fluid, model.walls ? &*model.walls : nullptr, tasks::parallel_loop); });
    return engine::forecast(built.scene, model, built.executor);
}

std::string said(const std::string& text, int threads = 1) {
    const ScratchFolder folder;
    std::ostringstream out;
    engine::check(io::read_scene(folder.write("scene.toml", text)), threads, out);
    return out.str();
}

double wall_seconds(const nlohmann::json& summary, std::initializer_list<const char*> passes) {
    double sum = 0;
    for (const char* pass : passes) sum += summary.at("tasks").at(pass).at("wall_seconds").get<double>();
    return sum;
}

// Solves that take longer than the fluid.
const std::string fine_plate = with(with(plate, "elements = [20, 2]", "elements = [80, 8]"), "end = 0.1", "end = 0.05");
const std::string fine_gate = with(gate, "elements = [1, 10]", "elements = [8, 160]");

}  // namespace

TEST_CASE("steps and seconds foretold are those of the run, in its units") {
    for (const std::string& text : {column, with_coupling(gate, "css", 3), fine_plate}) {
        const engine::Forecast told = forecast_of(text, 1);
        const std::clock_t cpu = std::clock();
        const auto begin = std::chrono::steady_clock::now();
        const Finished run(text, 1);
        const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        const double share = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC / wall;  // of a busy machine
        INFO(run.err.str());
        REQUIRE(run.code == engine::success);
        const nlohmann::json summary = run.results.summary();
        CHECK(told.no_solid_step.empty());
        CHECK(told.steps == Approx(summary.at("steps").get<double>()).epsilon(0.2));
        CHECK(told.step * told.steps == Approx(summary.at("time_s").get<double>()).epsilon(0.05));
        // What is foretold holds for a machine that is not busy; what the run took is brought to that.
        const double fluid = share * wall_seconds(summary, {"gradients", "fluxes"}) / 0.85;
        INFO("fluid ", told.fluid_seconds, " s, was ", fluid, " s; all ", told.seconds, " s");
        CHECK(told.fluid_seconds > fluid / 3);
        CHECK(told.fluid_seconds < fluid * 3);
        if (!summary.at("tasks").contains("FE Newton solve")) {
            CHECK(told.solid_seconds == 0);
            CHECK(told.seconds == told.fluid_seconds);
            continue;
        }
        const double solid = share * wall_seconds(summary, {"FE Newton solve"});
        INFO("solid ", told.solid_seconds, " s, was ", solid, " s");
        if (text == fine_plate) {
            CHECK(told.solid_seconds > solid / 5);
            CHECK(told.solid_seconds < solid * 5);
            CHECK(told.solid_seconds > told.fluid_seconds);
        }
        CHECK(told.seconds == Approx(told.fluid_seconds + told.solid_seconds));  // one thread
    }
}

TEST_CASE("side by side a solve that outlasts the fluid is what the run takes") {
    const engine::Forecast told = forecast_of(fine_gate, 2);
    INFO("fluid ", told.fluid_seconds, " s, solid ", told.solid_seconds, " s");
    CHECK(told.seconds >= told.solid_seconds);
    CHECK(told.seconds == Approx(std::max(told.solid_seconds, told.fluid_seconds + told.solid_seconds / 2)));
}

TEST_CASE("check prints what is foretold, and says why it cannot") {
    const std::string coupled = said(gate);
    CAPTURE(coupled);
    CHECK(coupled.find("560 particles of 0.005 m") != std::string::npos);
    CHECK(coupled.find("10 quadrilaterals of 8 nodes") != std::string::npos);
    CHECK(coupled.find("run time   about 1 s on 1 thread of") != std::string::npos);
    CHECK(coupled.find("for each iteration") == std::string::npos);
    CHECK(
        said(with(gate, "algorithm = \"cps\"", "algorithm = \"iterated\"")).find(" for each iteration of its cycles") !=
        std::string::npos);
    // A thousand times longer, and in the units of that.
    const std::string longer = said(with(gate, "end = 0.02", "end = 200.0"));
    CAPTURE(longer);
    CHECK(longer.find("run time   about 1 s") == std::string::npos);
    CHECK((longer.find(" min on ") != std::string::npos || longer.find(" h on ") != std::string::npos));
    // Nothing that could be run is still said in a few words.
    const std::string absurd = said(with(gate, "end = 0.02", "end = 1e300"));
    CAPTURE(absurd);
    CHECK(absurd.find("run time   more than a thousand years") != std::string::npos);
    CHECK(absurd.find("e+30") != std::string::npos);
    CHECK(absurd.size() < 900);
    // No equilibrium: the plate is held nowhere but at a point, and its weight turns it.
    std::string loose = with(plate, "[[solid.clamp]]\nset = \"right\"\n", "");
    loose = with(loose, "[[solid.clamp]]\nset = \"left\"\n", "[[solid.clamp]]\nset = \"left\"\nfixed = [\"x\"]\n");
    const std::string unknown = said(loose);
    CAPTURE(unknown);
    CHECK(unknown.find("run time   unknown: solid: no static equilibrium") != std::string::npos);
    CHECK(unknown.find("time       0.1 s in about ") != std::string::npos);
}
