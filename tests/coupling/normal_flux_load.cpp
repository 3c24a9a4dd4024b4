// The load on a body whose walls are normal fluxes: action equals reaction, the weight of water, Archimedes.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using fluid::Vec2;

namespace {

std::string normal_flux(const std::string& text) {
    return with(text, "sound_speed", "walls = \"normal_flux\"\nsound_speed");
}

void interface_tasks(Built& built) {
    bool at_end = false;
    for (const tasks::Task& task : built.listing) {
        at_end = at_end || task.group == "exchange";
        if (!at_end || task.name == "FE Newton solve") continue;
        if (task.name == "exchange") return;
        built.executor.execute([&] { task.body(); });
    }
}

}  // namespace

TEST_CASE("with normal fluxes the load on the body is minus what it does to the water") {
    Built built(normal_flux(strip));
    built.start();
    engine::Model<2>& model = *built.model;
    auto& s = model.fluid->particles;
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t i = 0; i < s.count; ++i) {
        for (std::size_t d = 0; d < 2; ++d) {
            s.x[d][i] += 0.1 * model.fluid->spacing * uniform(generator);
            s.v[d][i] = 0.1 * uniform(generator);
        }
        s.deviation[i] += 2 * uniform(generator);
        s.fullness[i] = 1;
    }
    built.run("neighbour search (step 1)");
    interface_tasks(built);
    Vec2 rate = Vec2::Zero();
    double magnitude = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        const Vec2 force = s.mass[i] * (Vec2(s.acceleration[0][i], s.acceleration[1][i]) - Vec2(0, -9.81));
        rate += force;
        magnitude += force.norm();
    }
    const Vec2 load(model.interface->force[0], model.interface->force[1]);
    CHECK(rate.norm() > 1e-4 * magnitude);  // or there is nothing to compare
    CHECK((load + rate).norm() < 1e-12 * magnitude);
}

TEST_CASE("with normal fluxes water at rest weighs ρ g H L, under both loads") {
    // Next to the two corners the side walls carry a part of the floor's reaction (normal_flux.hpp): the error falls
    // with Δx. The mean pressure of the other load is that at R/2 before the plate.
    const double weight = 1000 * 9.81 * 2.0;
    for (const char* load : {"force_conservative", "averaged_pressure"}) {
        CAPTURE(load);
        double last_error = 1;
        for (const auto& [spacing, tolerance] : {std::pair{0.05, 0.06}, {0.025, 0.03}}) {
            Built built(with(normal_flux(with(plate, "spacing = 0.1", "spacing = " + std::to_string(spacing))),
                             "[output]", std::string("[coupling]\nload = \"") + load + "\"\n[output]"));
            built.start();
            const double error = std::fabs(built.model->interface->force[1] / -weight - 1);
            INFO("load ", built.model->interface->force[1], ", error ", error);
            CHECK(error < tolerance);
            CHECK(error < 0.6 * last_error);
            CHECK(std::fabs(built.model->interface->force[0]) < 0.01 * weight);
            last_error = error;
        }
    }
}

TEST_CASE("with normal fluxes a submerged body is lifted by the water it displaces") {
    Built built(normal_flux(surrounded_body(8, 8, 4, 4)));
    built.start();
    const double lift = 1000 * 9.81 * 0.4 * 0.4;
    INFO("lift ", built.model->interface->force[1] / lift);
    CHECK(built.model->interface->force[1] == doctest::Approx(lift).epsilon(0.03));
    CHECK(std::fabs(built.model->interface->force[0]) < 0.02 * lift);
}

TEST_CASE("a gate with normal fluxes opens like one with ghosts") {
    const auto tip = [](const std::string& text) {
        const Finished run(text);
        INFO(run.err.str());
        REQUIRE(run.code == engine::success);
        return run.results.column("tip_x").back();
    };
    const double ghosts = tip(gate);
    CHECK(tip(normal_flux(gate)) == doctest::Approx(ghosts).epsilon(0.1));
    CHECK(tip(with_coupling(normal_flux(gate), "css", 3)) == doctest::Approx(ghosts).epsilon(0.1));
}
