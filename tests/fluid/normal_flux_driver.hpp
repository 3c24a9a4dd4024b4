// The step of a fluid between normal flux walls without tasks: what engine/listings.cpp lists, written as plain calls.
#pragma once
#include <functional>

#include "physics/fluid/shifting.hpp"
#include "physics/fluid/walls/normal_flux.hpp"
#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

namespace aquagraph::fluid::test {

template <int D>
class FluxDriver {
  public:
    FluxDriver(Fluid<D> fluid, Panels<D> panels) : fluid(std::move(fluid)) {
        walls.panels = std::move(panels);
        walls.panels.update_geometry();
        walls.panels.find_joints();
    }

    Fluid<D> fluid;
    NormalFluxWalls<D> walls;
    std::function<void(Panels<D>& panels, double time)> motion;  // places vertices and sets their velocities
    double time = 0;
    std::size_t floored = 0;  // summed over substeps

    void rebuild(BlockLoop loop = serial_loop) {
        if (motion) motion(walls.panels, time);
        rebuild_lists(fluid, walls, loop);
        built_ = walls.panels.position;
    }

    void rates(double at, BlockLoop loop = serial_loop, bool first = true) {
        auto& s = fluid.particles;
        if (motion) {
            motion(walls.panels, at);
            walls.update_geometry();
        }
        if (walls.is_periodic())
            loop(walls.images.blocks(),
                 [&](std::size_t block) { walls.images.update_state(s, Vec<D>(fluid.flux.gravity), block); });
        loop(fluid.blocks(), [&](std::size_t block) { walls.compute_gamma(s, fluid.kernel, block); });
        floored += walls.floored();
        loop(fluid.blocks(), [&](std::size_t block) {
            compute_gradients(s, fluid.lists, fluid.kernel, fluid.lanes(block), fluid.gradients());
            walls.complete_gradients(s, fluid.lists, fluid.kernel, fluid.flux, block);
        });
        if (walls.is_periodic())
            loop(walls.images.blocks(),
                 [&](std::size_t block) { walls.images.update_gradients(s, Vec<D>(fluid.flux.gravity), block); });
        if (first && fluid.transport == Transport::shifting) {
            loop(fluid.blocks(), [&](std::size_t block) {
                detect_free_surface(s, fluid.lists, fluid.kernel, fluid.surface, fluid.lanes(block));
            });
            loop(fluid.blocks(), [&](std::size_t block) { walls.complete_crowding(fluid.surface, block); });
            loop(fluid.blocks(), [&](std::size_t block) {
                compute_shift(s, fluid.lists, fluid.kernel, fluid.surface, fluid.lanes(block));
            });
            if (walls.is_periodic())
                loop(walls.images.blocks(), [&](std::size_t block) { walls.images.update_shift(s, block); });
        }
        loop(fluid.blocks(), [&](std::size_t block) {
            compute_fluxes(s, fluid.lists, fluid.kernel, fluid.flux, fluid.tait, fluid.lanes(block));
            if (fluid.viscosity.dynamic > 0) {
                add_viscosity(s, fluid.lists, fluid.kernel, fluid.viscosity, fluid.lanes(block));
                walls.add_shear(s, fluid.kernel, fluid.viscosity, fluid.spacing, block);
            }
            walls.add_fluxes(s, fluid.kernel, fluid.flux, fluid.tait.reference_density, block);
        });
    }

    void step(double dt, BlockLoop loop = serial_loop) {
        if (!hold(dt, loop)) rebuild(loop);
        for (int stage = 0; stage < fluid.integration.stages(); ++stage) {
            rates(time + fluid.integration.stage_time(stage) * dt, loop, stage == 0);
            if (fluid.ledger.kept) {
                fluid.ledger.part.assign(1, energies());
                fluid.ledger.accumulate(fluid.integration.scheme, stage, dt);
            }
            loop(fluid.blocks(), [&](std::size_t block) {
                advance_stage(fluid.particles, fluid.integration, fluid.tait, stage, dt, fluid.lanes(block));
            });
        }
        fluid.held_back += walls.hold_back(fluid.particles, fluid.spacing);
        time += dt;
    }

    // Rates of all blocks, of_wall added up by wall.
    EnergyRates energies(std::vector<double>* of_wall = nullptr) const {
        EnergyRates rates;
        std::vector<double> work(walls.panels.names.size(), 0.0);
        for (std::size_t block = 0; block < fluid.blocks(); ++block)
            rates.add(1, walls.energy_rates(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, fluid.tait,
                                            fluid.viscosity, fluid.spacing, block, work));
        if (of_wall) *of_wall = work;
        return rates;
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

    Vec<D> total_force() const {
        std::vector<Vec<D>> forces(walls.panels.position.size(), Vec<D>::Zero());
        walls.add_reactions(fluid.particles, fluid.kernel, fluid.flux, forces);
        Vec<D> total = Vec<D>::Zero();
        for (const auto& f : forces) total += f;
        return total;
    }

  private:
    bool hold(double dt, BlockLoop loop) {
        if (fluid.rebuilds == 0) return false;
        Travel most;
        for (std::size_t block = 0; block < fluid.blocks(); ++block)
            most = largest(most, travel(fluid.particles, fluid.lanes(block)));
        double wall2 = 0, wall_speed2 = 0;
        for (std::size_t k = 0; k < built_.size(); ++k) {
            wall2 = std::max(wall2, (walls.panels.position[k] - built_[k]).squaredNorm());
            wall_speed2 = std::max(wall_speed2, walls.panels.velocity[k].squaredNorm());
        }
        const ComingStep coming{dt, std::sqrt(wall2) + dt * std::sqrt(wall_speed2)};
        return lists_hold(fluid, &walls, most, coming, loop);
    }

    std::vector<Vec<D>> built_;
};

}  // namespace aquagraph::fluid::test
