// The averaged pressure load against its definition, and against the weight of water.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using fluid::Vec2;

namespace {
std::string averaged(const std::string& text) {
    return with(text, "[output]", "[coupling]\nload = \"averaged_pressure\"\n[output]");
}
const std::string averaged_gate =
    with(gate, "algorithm = \"cps\"\n", "algorithm = \"cps\"\nload = \"averaged_pressure\"\n");
}  // namespace

TEST_CASE("every wet panel bears the mean pressure of the particles before it, nearer than R") {
    Built built(averaged_gate);
    built.start();
    engine::Model<2>& model = *built.model;
    auto& s = model.fluid->particles;
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t i = 0; i < s.count; ++i) {
        s.p[i] = 1000 * uniform(generator);
        for (std::size_t d = 0; d < 2; ++d) s.x[d][i] += 0.1 * model.fluid->spacing * uniform(generator);
    }
    built.run("wall motion (interface)");
    built.run("interface loads");

    const fluid::Panels<2>& panels = model.walls->panels;
    std::size_t wet = 0, loaded = 0;
    Vec2 total = Vec2::Zero();
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (!panels.panels[k].wet) continue;
        double sum = 0;
        std::size_t n = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            const Vec2 x(s.x[0][i], s.x[1][i]), a = panels.start(k), b = panels.end(k), along = b - a;
            const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
            if ((x - a - t * along).norm() >= model.fluid->kernel.radius()) continue;
            if ((x - a).dot(Vec2(-along.y(), along.x())) < -0.5 * model.fluid->spacing * along.norm()) continue;
            sum += s.p[i];
            ++n;
        }
        CAPTURE(k);
        CHECK(model.interface->average.particles(wet) == n);
        const double mean = n > 0 ? sum / double(n) : 0;
        CHECK(model.interface->average.pressure(wet) == doctest::Approx(mean).epsilon(1e-12));
        const Vec2 along = panels.end(k) - panels.start(k);
        total -= mean * Vec2(-along.y(), along.x());  // normal into the fluid × length
        loaded += n > 0;
        ++wet;
    }
    CHECK(loaded > 20);
    CHECK(loaded < wet);  // the gate's outer side is dry
    CHECK(model.interface->force[0] == doctest::Approx(total.x()).epsilon(1e-12));
    CHECK(model.interface->force[1] == doctest::Approx(total.y()).epsilon(1e-12));
}

TEST_CASE("averaged still water weighs what stands above half a radius") {
    // The mean pressure is that at R/2 before the plate: it lacks ρ g R/2, and falls with Δx.
    double last_error = 1;
    for (const auto& [spacing, tolerance] : {std::pair{0.05, 0.02}, {0.025, 0.01}}) {
        Built built(averaged(with(plate, "spacing = 0.1", "spacing = " + std::to_string(spacing))));
        built.start();
        const double radius = 4 * spacing, expected = 1000 * 9.81 * (2.0 - radius / 2), weight = 1000 * 9.81 * 2.0;
        INFO("load ", built.model->interface->force[1]);
        CHECK(built.model->interface->force[1] == doctest::Approx(-expected).epsilon(tolerance));
        const double error = std::fabs(built.model->interface->force[1] / -weight - 1);
        CHECK(error < last_error);
        last_error = error;
    }
}

TEST_CASE("a load that is averaged needs no ghosts at the end of a cycle") {
    const Built built(averaged_gate);
    CHECK_FALSE(built.has("ghosts (interface)"));
    CHECK_FALSE(built.has("gradients (interface)"));
    CHECK(built.has("interface loads"));
}
