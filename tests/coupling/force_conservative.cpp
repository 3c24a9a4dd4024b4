// The load on the body against its slow twin, and against what mechanics demands of it: action equals reaction,
// momentum, power, the weight of water.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "tests/coupling/wall_pairs.hpp"
#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

struct Bend {
    double amplitude;  // [m] of y -> y + amplitude sin(2π x): shears, so no particle ends up inside the body
    double operator()(double x) const { return amplitude * std::sin(2 * std::numbers::pi * x); }
};

// Particles thrown out of order (places, velocities, densities) beside a body that is bent and moves.
void disorder(Built& built, const Bend& bend, double amount = 1) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-amount, amount);
    engine::Model<2>& model = *built.model;
    auto& s = model.fluid->particles;
    for (std::size_t i = 0; i < s.count; ++i) {
        for (std::size_t d = 0; d < 2; ++d) {
            s.x[d][i] += 0.3 * model.fluid->spacing * uniform(generator);
            s.v[d][i] = uniform(generator);
        }
        s.x[1][i] += bend(s.x[0][i]);
        s.deviation[i] += 2 * uniform(generator);
        s.fullness[i] = 1;  // tension is allowed: suction must balance too
    }
    const auto& nodes = model.solid->mesh().nodes;
    std::vector<double> x, v;
    for (const auto& node : nodes) {
        x.insert(x.end(), {node[0], node[1] + bend(node[0])});
        v.insert(v.end(), {uniform(generator), uniform(generator)});
    }
    model.interface->surface.take(x, v);
}

Vec2 load_of(const Built& built) {
    return {built.model->interface->force[0], built.model->interface->force[1]};
}

bool belongs_to_body(const engine::Model<2>& model, const fluid::Ghost& ghost) {
    if (ghost.corner < 0) return model.walls->panels.panels[std::size_t(ghost.panel)].wet;
    const fluid::Corner<2>& corner = model.walls->corners[std::size_t(ghost.corner)];
    return model.walls->panels.panels[std::size_t(corner.panel[0])].wet ||
           model.walls->panels.panels[std::size_t(corner.panel[1])].wet;
}

// What the ghosts of the body exert on the fluid, and the sum of magnitudes that rounding is measured by.
struct OnFluid {
    Vec2 sum = Vec2::Zero();
    double magnitude = 0;
    std::size_t pairs = 0;
};
OnFluid on_fluid(const engine::Model<2>& model) {
    OnFluid total;
    each_wall_pair(model, [&](std::size_t, std::size_t g, const Vec2& force) {
        if (!belongs_to_body(model, model.walls->ghosts[g])) return;
        total.sum += force;
        total.magnitude += force.norm();
        ++total.pairs;
    });
    return total;
}

std::size_t corner_ghosts(const engine::Model<2>& model) {
    std::size_t found = 0;
    for (const fluid::Ghost& ghost : model.walls->ghosts) found += ghost.corner >= 0;
    return found;
}

}  // namespace

TEST_CASE("the load on the body is minus what its ghosts exert on the fluid") {
    struct Case {
        std::string name;
        double amplitude;
        bool muscl, corners;
        std::string viscosity = "";
    };
    // Coarse panels bent by more than 5° have concave corners, which mirror particles through their point as well.
    for (const Case& c :
         {Case{"straight", 0.0, true, false}, Case{"bent", 0.06, true, false},
          Case{"bent, first order", 0.06, false, false}, Case{"with corners", 0.1, true, true},
          Case{"viscous", 0.06, true, false, "monaghan_gingold"}, Case{"viscous, Morris", 0.1, true, true, "morris"}}) {
        CAPTURE(c.name);
        std::string text = c.corners ? coarse_strip : strip;
        if (!c.muscl) text = with(text, "sound_speed = 30.0", "sound_speed = 30.0\nscheme.reconstruction = \"none\"");
        if (!c.viscosity.empty()) text += "[fluid.viscosity]\ndynamic = 50.0\noperator = \"" + c.viscosity + "\"\n";
        Built built(text);
        disorder(built, Bend{c.amplitude});
        built.compute_loads();
        const OnFluid fluid = on_fluid(*built.model);
        CHECK((corner_ghosts(*built.model) > 0) == c.corners);
        REQUIRE(fluid.pairs > 1000);
        CHECK(fluid.sum.norm() > 1e-3 * fluid.magnitude);  // or there is nothing to compare
        INFO("relative difference ", (load_of(built) + fluid.sum).norm() / fluid.sum.norm());
        CHECK((load_of(built) + fluid.sum).norm() <= 1e-12 * fluid.sum.norm());
    }
}

TEST_CASE("beside rigid walls the body gets the load of its own ghosts only") {
    Built built(gate);
    built.start();
    disorder(built, Bend{0});
    built.compute_loads();
    // A corner between gate and floor belongs to whichever of the two the line of sight enters.
    const engine::Model<2>& model = *built.model;
    Vec2 sum = Vec2::Zero();
    std::size_t rigid = 0, shared = 0;
    each_wall_pair(model, [&](std::size_t i, std::size_t g, const Vec2& force) {
        const fluid::Ghost& ghost = model.walls->ghosts[g];
        int panel = ghost.panel;
        Vec2 share = force;
        if (ghost.corner >= 0) {
            panel = model.walls->visibility.entry_panel(i, g);
            for (const int floor : model.walls->corners[std::size_t(ghost.corner)].floor) {
                if (floor < 0) continue;
                const Vec2& up = model.walls->panels.normal[std::size_t(floor)];
                share -= force.dot(up) * up;  // what goes across the floor is the floor's
                if (panel >= 0 && model.walls->panels.panels[std::size_t(panel)].wet) ++shared;
            }
        }
        REQUIRE(panel >= 0);
        if (model.walls->panels.panels[std::size_t(panel)].wet)
            sum += share;
        else
            ++rigid;
    });
    CHECK(rigid > 1000);
    CHECK(shared > 0);
    CHECK((load_of(built) + sum).norm() <= 1e-12 * sum.norm());
}

TEST_CASE("the corner between a body and its floor moves as its place does, and bears what is conjugate to that") {
    Built built(gate);
    built.start();
    disorder(built, Bend{0});
    for (Vec2& v : built.model->interface->surface.motion.velocity) v += Vec2(3, -5);
    built.compute_loads();
    engine::Model<2>& model = *built.model;
    fluid::GhostWalls<2>& walls = *model.walls;
    // At the floor, on the water's side; the vertical motion of the gate is not the corner's.
    std::size_t standing = 0;
    const double h = 1e-7;
    for (const fluid::Corner<2>& corner : walls.corners) {
        if (corner.floor[0] < 0) continue;
        ++standing;
        fluid::Panels<2> later = walls.panels;
        for (std::size_t k = 0; k < later.position.size(); ++k) later.position[k] += h * later.velocity[k];
        later.update_geometry();
        fluid::Corner<2> moved = corner;
        moved.update(later);
        CHECK(((moved.point - corner.point) / h - corner.velocity).norm() < 1e-6);
        CHECK(std::fabs(corner.velocity.y()) < 1e-14);
        CHECK(std::fabs(corner.velocity.x()) > 0.1);
    }
    CHECK(standing >= 1);

    double power = 0, scale = 0;
    each_wall_pair(model, [&](std::size_t i, std::size_t g, const Vec2& force) {
        const fluid::Ghost& ghost = walls.ghosts[g];
        const int panel = ghost.corner < 0 ? ghost.panel : walls.visibility.entry_panel(i, g);
        if (!walls.panels.panels[std::size_t(panel)].wet) return;
        Vec2 velocity;
        if (ghost.corner >= 0) {
            velocity = walls.corners[std::size_t(ghost.corner)].velocity;
        } else {
            const auto k = std::size_t(panel);
            const auto shape = walls.panels.shape_functions_on(
                k, Vec2(model.fluid->particles.x[0][ghost.parent], model.fluid->particles.x[1][ghost.parent]));
            velocity = shape[0] * walls.panels.velocity[std::size_t(walls.panels.panels[k].vertex[0])] +
                       shape[1] * walls.panels.velocity[std::size_t(walls.panels.panels[k].vertex[1])];
        }
        power -= force.dot(velocity);
        scale += force.norm() * velocity.norm();
    });
    double nodal_power = 0;
    for (std::size_t k = 0; k < model.interface->vertex_forces.size(); ++k)
        nodal_power += model.interface->vertex_forces[k].dot(walls.panels.velocity[k]);
    CHECK(std::fabs(nodal_power - power) <= 1e-12 * scale);
}

TEST_CASE("forces keep their moment on the way from ghosts to nodes, and their power") {
    for (const bool corners : {false, true}) {
        CAPTURE(corners);
        Built built(corners ? coarse_strip : strip);
        disorder(built, Bend{corners ? 0.1 : 0.06});
        built.compute_loads();
        const engine::Model<2>& model = *built.model;
        const fluid::Panels<2>& panels = model.walls->panels;
        REQUIRE((corner_ghosts(model) > 0) == corners);

        // Where a ghost's force acts and how fast the wall moves there: as the fluid sees it.
        Vec2 moment_at = Vec2(0.3, -0.2);
        double moment = 0, power = 0, scale = 0, power_scale = 0;
        each_wall_pair(model, [&](std::size_t, std::size_t g, const Vec2& force) {
            const fluid::Ghost& ghost = model.walls->ghosts[g];
            const Vec2 parent(model.fluid->particles.x[0][ghost.parent], model.fluid->particles.x[1][ghost.parent]);
            Vec2 foot, velocity;
            if (ghost.corner >= 0) {
                foot = model.walls->corners[std::size_t(ghost.corner)].point;
                velocity = model.walls->corners[std::size_t(ghost.corner)].velocity;
            } else {
                const auto k = std::size_t(ghost.panel);
                const double s = (parent - panels.start(k)).dot(panels.tangent[k]) / panels.measure[k];
                REQUIRE(s >= 0);
                REQUIRE(s <= 1);
                foot = panels.start(k) + s * (panels.end(k) - panels.start(k));
                velocity = (1 - s) * panels.velocity[std::size_t(panels.panels[k].vertex[0])] +
                           s * panels.velocity[std::size_t(panels.panels[k].vertex[1])];
            }
            moment -= fluid::cross(foot - moment_at, force);
            power -= force.dot(velocity);
            scale += (foot - moment_at).norm() * force.norm();
            power_scale += force.norm() * velocity.norm();
        });

        double nodal_moment = 0, nodal_power = 0;
        const auto& forces = model.interface->vertex_forces;
        for (std::size_t k = 0; k < forces.size(); ++k) {
            nodal_moment += fluid::cross(panels.position[k] - moment_at, forces[k]);
            nodal_power += forces[k].dot(panels.velocity[k]);
        }
        CHECK(std::fabs(nodal_moment - moment) <= 1e-12 * scale);
        CHECK(std::fabs(nodal_power - power) <= 1e-12 * power_scale);
    }
}

TEST_CASE("what the fluid loses in momentum the body gets, step by step") {
    // Water under gravity, a little disordered, that falls as a whole, and a bent body in it that goes its own way: the
    // solve and the exchange, which would move it elsewhere, are left out. More disorder would throw particles through
    // walls, where they are stopped (GhostWalls::hold_back) and lose momentum to nobody.
    for (const std::string viscosity : {"", "[fluid.viscosity]\ndynamic = 20.0\n"}) {
        CAPTURE(viscosity);
        Built built(strip + viscosity);
        disorder(built, Bend{0.06}, 0.1);
        engine::Model<2>& model = *built.model;
        const auto& s = model.fluid->particles;
        const auto momentum = [&] {
            Vec2 sum = Vec2::Zero();
            for (std::size_t i = 0; i < s.count; ++i) sum += s.mass[i] * Vec2(s.v[0][i], s.v[1][i]);
            return sum;
        };
        double mass = 0;
        for (std::size_t i = 0; i < s.count; ++i) mass += s.mass[i];

        // The impulse of a Runge-Kutta step is made of the loads of its stages with the weights of the method.
        const double weight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
        for (int cycle = 0; cycle < 5; ++cycle) {
            const Vec2 before = momentum();
            Vec2 impulse = Vec2::Zero();
            for (std::size_t k = 0; k < built.listing.size(); ++k) {
                const std::string& name = built.listing[k].name;
                if (name == "FE Newton solve" || name == "exchange") continue;
                built.executor.execute([&] { built.listing[k].body(); });
                const std::string last =
                    viscosity.empty() ? "fluxes (stage " : "viscosity (stage ";  // once rates are complete
                if (!name.starts_with(last)) continue;
                const auto stage = std::size_t(name[last.size()] - '1');
                built.run("interface loads");
                impulse += weight[stage] * model.clock.step * load_of(built);
            }
            REQUIRE(model.fluid->held_back == 0);
            const Vec2 gained = momentum() - before - mass * model.clock.step * Vec2(0, -9.81);
            CAPTURE(cycle);
            INFO("relative error ", (gained + impulse).norm() / impulse.norm());
            CHECK(impulse.norm() > 0);
            CHECK((gained + impulse).norm() <= 1e-11 * impulse.norm());
        }
        CHECK(model.clock.steps == 5);
        CHECK(model.clock.elapsed == doctest::Approx(model.clock.time));
    }
}

TEST_CASE("water at rest on an elastic floor weighs ρ g H L") {
    // Near the two corners the floor shares its load with the side walls, so the error falls with Δx.
    const double weight = 1000 * 9.81 * 2.0 * 1.0;
    double last_error = 1;
    for (const auto& [spacing, tolerance] : {std::pair{"0.05", 0.025}, {"0.025", 0.015}, {"0.0125", 0.01}}) {
        CAPTURE(spacing);
        Built built(with(plate, "spacing = 0.1", std::string("spacing = ") + spacing));
        built.start();
        built.compute_loads();
        const double error = std::fabs(load_of(built).y() / -weight - 1);
        INFO("load ", load_of(built).y(), " N/m, ", 100 * error, " % from the weight; sideways ", load_of(built).x());
        CHECK(error < tolerance);
        CHECK(error < last_error);
        CHECK(std::fabs(load_of(built).x()) < 1e-3 * weight);
        last_error = error;
    }
}

TEST_CASE("still water behind a gate on the floor presses with hydrostatics, however fine the gate's elements") {
    // Panels shorter than half a spacing used to meet the floor in several corners, each of which mirrored the water.
    const double high = 0.079, load = 1000 * 9.81 * (0.14 * high - 0.5 * high * high);
    double first = 0;
    for (const char* elements : {"[1, 10]", "[1, 40]", "[1, 160]", "[1, 320]"}) {
        CAPTURE(elements);
        Built built(with(with(gate, "spacing = 0.005", "spacing = 0.0025"), "elements = [1, 10]",
                         std::string("elements = ") + elements));
        built.start();
        built.compute_loads();
        if (first == 0) first = load_of(built).x();
        INFO("load ", load_of(built).x(), " N/m, ", 100 * (load_of(built).x() / load - 1), " % from hydrostatics");
        CHECK(load_of(built).x() == doctest::Approx(load).epsilon(0.01));
        CHECK(load_of(built).x() == doctest::Approx(first).epsilon(1e-9));
    }
}

TEST_CASE("a submerged body is lifted by the water it displaces") {
    Built built(surrounded_body(8, 8, 4, 4));
    built.start();
    built.compute_loads();
    const double lift = 1000 * 9.81 * 0.4 * 0.4;
    INFO("lift ", load_of(built).y(), " N/m, ", 100 * (load_of(built).y() / lift - 1), " % from Archimedes, sideways ",
         load_of(built).x());
    CHECK(load_of(built).y() == doctest::Approx(lift).epsilon(0.02));
    CHECK(std::fabs(load_of(built).x()) < 0.02 * lift);
}
