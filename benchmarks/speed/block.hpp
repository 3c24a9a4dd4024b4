// A free block of water, its particles on a lattice disturbed by a tenth of the spacing, in a vortex: what the
// measurements of this folder run on. A step is what engine/listings.cpp lists for a fluid without walls.
#pragma once
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "physics/fluid/fluid.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/rebuild.hpp"
#include "physics/fluid/time_step.hpp"
#include "physics/fluid/travel.hpp"

namespace aquagraph::benchmarks {

// Seconds spent per part of a step.
using Times = std::map<std::string, double>;

template <class F>
double seconds_of(F&& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

template <int D>
class WaterBlock {
  public:
    // n particles along every edge of length 1; R/Δx; largest speed over the speed of sound.
    WaterBlock(std::size_t n, double radius_over_spacing, double mach, const fluid::FluxParameters& flux = {})
        : fluid{.spacing = 1.0 / double(n),
                .tait = {1000, 20},
                .kernel = fluid::WendlandC2<D>(radius_over_spacing / double(n)),
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
                .ledger = {}} {
        fluid.lists.radius = fluid.kernel.radius();
        fluid.lists.skin = fluid::skin_ratio<D>(false) * fluid.lists.radius;
        std::size_t count = 1;
        for (int d = 0; d < D; ++d) count *= n;
        auto& s = fluid.particles;
        fluid.prepare_particles();
        s.resize(count, 0);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> noise(-0.1, 0.1);
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t rest = i;
            for (std::size_t d = 0; d < D; ++d) {
                s.x[d][i] = (double(rest % n) + 0.5 + noise(random)) / double(n);
                rest /= n;
            }
            s.v[0][i] = mach * fluid.tait.sound_speed * std::sin(2 * std::numbers::pi * s.x[1][i]);
            s.v[1][i] = -mach * fluid.tait.sound_speed * std::sin(2 * std::numbers::pi * s.x[0][i]);
            s.id[i] = std::int64_t(i);
            s.mass[i] = fluid.tait.reference_density * std::pow(fluid.spacing, D);
            s.fullness[i] = 1;
        }
        rebuild(serial_loop);
    }

    void rebuild(BlockLoop loop) { fluid::rebuild_lists<D>(fluid, nullptr, loop); }

    // One step of RK4; adds the seconds of its parts to `times`.
    void step(BlockLoop loop, Times& times) {
        auto& s = fluid.particles;
        const auto timed = [&](const char* name, auto&& work) { times[name] += seconds_of(work); };
        const auto each_block = [&](const char* name, auto&& work) {
            timed(name, [&] { loop(fluid.blocks(), [&](std::size_t block) { work(fluid.lanes(block)); }); });
        };
        double dt = 0;
        timed("step, lists", [&] {
            struct Block {
                fluid::StepLimits limits;
                fluid::Travel travel;
            };
            std::vector<Block> of(fluid.blocks());
            loop(fluid.blocks(), [&](std::size_t block) {
                const auto lanes = fluid.lanes(block);
                of[block] = {step_limits(s, fluid.cfl, fluid.kernel.radius(), lanes, fluid.viscous_rate()),
                             fluid::travel(s, lanes)};
            });
            fluid::StepLimits limits;
            fluid::Travel travel;
            for (const Block& block : of) {
                limits = combine(limits, block.limits);
                travel = largest(travel, block.travel);
            }
            dt = limits.step();
            const fluid::GhostWalls<D>* none = nullptr;
            if (!lists_hold(fluid, none, travel, {dt, 0}, loop)) rebuild(loop);
            prune(s, fluid.lists, skin_of_step(travel, dt, 0, fluid.lists.radius), loop);
        });
        for (int stage = 0; stage < fluid.integration.stages(); ++stage) {
            each_block("gradients",
                       [&](auto lanes) { compute_gradients(s, fluid.lists, fluid.kernel, lanes, fluid.gradients()); });
            each_block("fluxes", [&](auto lanes) {
                compute_fluxes(s, fluid.lists, fluid.kernel, fluid.flux, fluid.tait, lanes);
            });
            each_block("Runge-Kutta",
                       [&](auto lanes) { advance_stage(s, fluid.integration, fluid.tait, stage, dt, lanes); });
        }
    }

    // Lanes that a pass computes per pair within R, on the lists for a run and on those of one step.
    double lanes_per_pair(bool pruned) const {
        double entries = 0;
        for (const auto& block : pruned ? fluid.lists.inner : fluid.lists.blocks)
            entries += block.particle.back().open_end + block.particle.back().masked_end;
        return entries * fluid::W / double(fluid.lists.pairs());
    }

    // Whether the run means anything.
    bool finite() const {
        const auto& s = fluid.particles;
        for (std::size_t i = 0; i < s.count; ++i)
            for (std::size_t d = 0; d < D; ++d)
                if (!std::isfinite(s.x[d][i]) || !std::isfinite(s.v[d][i])) return false;
        return true;
    }

    fluid::Fluid<D> fluid;
};

}  // namespace aquagraph::benchmarks
