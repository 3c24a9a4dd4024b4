// The fluid's step without tasks, threads as the caller likes: what engine/listings.cpp lists, written as plain calls.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "physics/fluid/filling.hpp"
#include "physics/fluid/fluid.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/rebuild.hpp"
#include "physics/fluid/shifting.hpp"
#include "physics/fluid/time_step.hpp"
#include "physics/fluid/travel.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/x_sph.hpp"

namespace aquagraph::fluid::test {

inline constexpr double support_ratio = 4;  // R/Δx

template <int D>
Fluid<D> make_fluid(double spacing, const Tait& tait, const FluxParameters& flux = {}) {
    Fluid<D> fluid{.spacing = spacing,
                   .tait = tait,
                   .kernel = WendlandC2<D>(support_ratio * spacing),
                   .flux = flux,
                   .cfl = 0.375,
                   .domain = {},
                   .closed = false,
                   .particles = {},
                   .lists = {},
                   .integration = {},
                   .search = {},
                   .order = {},
                   .reorder = {},
                   .surface = {},
                   .ledger = {}};
    fluid.lists.radius = fluid.kernel.radius();
    fluid.lists.skin = skin_ratio<D>(true) * fluid.kernel.radius();
    return fluid;
}

template <int D>
class Driver {
  public:
    explicit Driver(Fluid<D> fluid) : fluid(std::move(fluid)) {}

    Fluid<D> fluid;
    std::optional<GhostWalls<D>> walls;
    std::function<void(Panels<D>& panels, double time)> motion;  // places vertices and sets their velocities
    double time = 0;

    // Order, ghosts and lists.
    void rebuild(BlockLoop loop = serial_loop) {
        if (walls && motion) motion(walls->panels, time);
        rebuild_lists(fluid, walls ? &*walls : nullptr, loop);
        if (walls) built_ = walls->panels.position;
    }

    // Ghosts, gradients and rates of the present state, walls as they are at `at`.
    void rates(double at, BlockLoop loop = serial_loop, bool first = true) {
        auto& s = fluid.particles;
        if (walls) {
            if (motion) motion(walls->panels, at);
            walls->update_geometry();
            loop(walls->blocks(), [&](std::size_t block) { walls->update_state(s, gravity(), block); });
        }
        loop(fluid.blocks(), [&](std::size_t block) {
            compute_gradients(s, fluid.lists, fluid.kernel, fluid.lanes(block), fluid.gradients());
        });
        if (walls) loop(walls->blocks(), [&](std::size_t block) { walls->update_gradients(s, gravity(), block); });
        if (first) transport(loop);
        fluxes(loop);
        if (fluid.viscosity.dynamic > 0)
            loop(fluid.blocks(), [&](std::size_t block) {
                add_viscosity(s, fluid.lists, fluid.kernel, fluid.viscosity, fluid.lanes(block));
            });
    }

    // Of particles and ghosts as they are.
    void fluxes(BlockLoop loop = serial_loop) {
        loop(fluid.blocks(), [&](std::size_t block) {
            compute_fluxes(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, fluid.tait, fluid.lanes(block));
        });
    }

    void transport(BlockLoop loop) {
        auto& s = fluid.particles;
        if (fluid.transport == Transport::x_sph)
            loop(fluid.blocks(), [&](std::size_t block) {
                compute_x_sph(s, fluid.lists, fluid.kernel, fluid.x_sph, fluid.lanes(block));
            });
        if (fluid.transport == Transport::shifting) shifting(loop);
        if (walls && fluid.transport != Transport::none)
            loop(walls->blocks(), [&](std::size_t block) { walls->update_shift(s, block); });
    }

    void shifting(BlockLoop loop) {
        auto& s = fluid.particles;
        loop(fluid.blocks(), [&](std::size_t block) {
            detect_free_surface(s, fluid.lists, fluid.kernel, fluid.surface, fluid.lanes(block));
        });
        loop(fluid.blocks(), [&](std::size_t block) {
            compute_shift(s, fluid.lists, fluid.kernel, fluid.surface, fluid.lanes(block));
        });
    }

    void ledger(int stage, double dt, BlockLoop loop) {
        fluid.ledger.part.resize(fluid.blocks());
        loop(fluid.blocks(), [&](std::size_t block) {
            fluid.ledger.part[block] = energy_rates(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, fluid.tait,
                                                    fluid.viscosity, fluid.lanes(block));
        });
        fluid.ledger.accumulate(fluid.integration.scheme, stage, dt);
    }

    // What an integration that keeps the rates of the step before wants before the first one.
    void start(BlockLoop loop = serial_loop) {
        rebuild(loop);
        rates(time, loop);
    }

    void step(double dt, BlockLoop loop = serial_loop) {
        const Travel travel = most_travelled();
        const double wall_travel = dt * walls_speed();
        if (!hold(travel, dt, wall_travel, loop)) rebuild(loop);
        prune(fluid.particles, fluid.lists, skin_of_step(travel, dt, wall_travel, fluid.lists.radius), loop);
        if (fluid.integration.predicts())
            loop(fluid.blocks(), [&](std::size_t block) {
                predict(fluid.particles, fluid.integration, fluid.tait, dt, fluid.lanes(block));
            });
        for (int stage = 0; stage < fluid.integration.stages(); ++stage) {
            rates(time + fluid.integration.stage_time(stage) * dt, loop, stage == 0);
            if (fluid.ledger.kept) ledger(stage, dt, loop);
            loop(fluid.blocks(), [&](std::size_t block) {
                advance_stage(fluid.particles, fluid.integration, fluid.tait, stage, dt, fluid.lanes(block));
            });
        }
        if (walls) fluid.held_back += walls->hold_back(fluid.particles, fluid.spacing);
        time += dt;
    }

    double largest_step() const {
        StepLimits limits;
        for (std::size_t block = 0; block < fluid.blocks(); ++block)
            limits = combine(limits, step_limits(fluid.particles, fluid.cfl, fluid.kernel.radius(), fluid.lanes(block),
                                                 fluid.viscous_rate()));
        return limits.step();
    }

    void run(double until, BlockLoop loop = serial_loop) {
        while (time < until * (1 - 1e-12)) step(std::min(largest_step(), until - time), loop);
    }

    Vec<D> gravity() const { return Vec<D>(fluid.flux.gravity); }

  private:
    Travel most_travelled() const {
        Travel most;
        for (std::size_t block = 0; block < fluid.blocks(); ++block)
            most = largest(most, travel(fluid.particles, fluid.lanes(block)));
        return most;
    }

    double walls_speed() const {
        double speed2 = 0;
        if (walls)
            for (const Vec<D>& v : walls->panels.velocity) speed2 = std::max(speed2, v.squaredNorm());
        return std::sqrt(speed2);
    }

    bool hold(const Travel& travel, double dt, double wall_travel, BlockLoop loop) {
        if (fluid.rebuilds == 0) return false;
        double wall2 = 0;
        for (std::size_t k = 0; k < built_.size(); ++k)
            wall2 = std::max(wall2, (walls->panels.position[k] - built_[k]).squaredNorm());
        const GhostWalls<D>* known = walls ? &*walls : nullptr;
        return lists_hold(fluid, known, travel, {dt, std::sqrt(wall2) + wall_travel}, loop);
    }

    std::vector<Vec<D>> built_;
};

}  // namespace aquagraph::fluid::test
