#include "tasks/flux_walls.hpp"

#include <cmath>
#include <memory>

#include "physics/fluid/rebuild.hpp"
#include "tasks/parallel_loop.hpp"
#include "tasks/resources.hpp"
#include "tasks/statistics.hpp"
#include "tasks/stepping.hpp"

namespace aquagraph::tasks {

namespace {

template <int D>
class FluxWallSearch {
  public:
    FluxWallSearch(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const Clock& clock)
        : fluid_(fluid), walls_(walls), clock_(clock) {}

    void operator()() {
        if (lists_hold()) return;
        const fluid::Escape escape = walls_.deepest(fluid_.particles);
        if (escape.depth >= 0.5 * fluid_.spacing)
            throw SickParticle({fluid::Ailment::passed_wall, escape.particle},
                               "a particle has passed through wall '" + walls_.panels.name(std::size_t(escape.panel)) +
                                   "' and is " + std::to_string(escape.depth / fluid_.spacing) + " spacings behind it");
        if (!fluid_.closed) fluid_.removed += remove_outside(fluid_.particles, fluid_.domain);
        rebuild_lists(fluid_, walls_, parallel_loop);
        built_ = walls_.panels.position;
        built_once_ = true;
    }

  private:
    struct Reach {
        double displacement2 = 0, speed2 = 0;
    };

    // Two particles come closer by at most twice the largest displacement, a particle and a wall by that of both. The
    // coming step is counted in at present speeds.
    bool lists_hold() {
        if (!built_once_) return false;
        const auto& s = fluid_.particles;
        scratch_.resize(fluid_.blocks());
        const Reach reach = reduce_blocks(
            fluid_.blocks(), Reach{},
            [&](std::size_t block) {
                Reach r{largest_displacement_squared(s, block), 0};
                const auto lanes = fluid_.lanes(block);
                for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
                    double v2 = 0;
                    for (std::size_t d = 0; d < D; ++d) v2 += s.v[d][i] * s.v[d][i];
                    r.speed2 = std::max(r.speed2, v2);
                }
                return r;
            },
            [](const Reach& a, const Reach& b) {
                return Reach{std::max(a.displacement2, b.displacement2), std::max(a.speed2, b.speed2)};
            },
            std::span<Reach>(scratch_));
        double wall2 = 0, wall_speed2 = 0;
        for (std::size_t k = 0; k < built_.size(); ++k) {
            wall2 = std::max(wall2, (walls_.panels.position[k] - built_[k]).squaredNorm());
            wall_speed2 = std::max(wall_speed2, walls_.panels.velocity[k].squaredNorm());
        }
        const double moved = std::sqrt(reach.displacement2) + std::sqrt(wall2) +
                             clock_.step * (std::sqrt(reach.speed2) + std::sqrt(wall_speed2));
        return moved < 0.5 * fluid_.lists.skin;
    }

    fluid::Fluid<D>& fluid_;
    fluid::NormalFluxWalls<D>& walls_;
    const Clock& clock_;
    std::vector<Reach> scratch_;
    bool built_once_ = false;           // by this task
    std::vector<fluid::Vec<D>> built_;  // vertices of walls when the lists were built
};

}  // namespace

template <int D>
Task neighbour_search(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const Clock& clock,
                      const std::string& label) {
    // Held by pointer: the graph copies bodies.
    auto search = std::make_shared<FluxWallSearch<D>>(fluid, walls, clock);
    return {.name = "neighbour search (" + label + ")",
            .reads = {resource::clock_step},
            .writes = {resource::fluid, resource::walls},
            .body = [search] { (*search)(); }};
}

template <int D>
Task wall_gamma(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall gamma (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists, resource::fluid_state},
            .writes = {resource::wall_gamma},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(),
                               [&](std::size_t block) { walls.compute_gamma(fluid.particles, fluid.kernel, block); });
                walls.floor_count += walls.floored();
            }};
}

template <int D>
Task wall_gradients(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall gradients (" + label + ")",
            .reads = {resource::walls, resource::wall_gamma, resource::fluid_lists, resource::fluid_state},
            .writes = {resource::fluid_gradients, resource::wall_moments},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    walls.complete_gradients(fluid.particles, fluid.lists, fluid.kernel, fluid.flux, block);
                    report_work(walls.pairs(block));
                });
            }};
}

template <int D>
Task wall_fluxes(fluid::Fluid<D>& fluid, fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall fluxes (" + label + ")",
            .reads = {resource::walls, resource::wall_gamma, resource::wall_moments, resource::fluid_lists,
                      resource::fluid_state, resource::fluid_gradients},
            .writes = {resource::fluid_rates},
            .body = [&fluid, &walls] {
                for_each_block(fluid.blocks(), [&](std::size_t block) {
                    walls.add_fluxes(fluid.particles, fluid.kernel, fluid.flux, fluid.tait.reference_density, block);
                    report_work(walls.pairs(block));
                });
            }};
}

template <int D>
Task wall_contact(fluid::Fluid<D>& fluid, const fluid::NormalFluxWalls<D>& walls, const std::string& label) {
    return {.name = "wall contact (" + label + ")",
            .reads = {resource::walls, resource::fluid_lists},
            .writes = {resource::fluid_state},
            .body = [&fluid, &walls] { fluid.held_back += walls.hold_back(fluid.particles, fluid.spacing); }};
}

template Task neighbour_search(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const Clock&, const std::string&);
template Task neighbour_search(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const Clock&, const std::string&);
template Task wall_gamma(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_gamma(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);
template Task wall_gradients(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_gradients(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);
template Task wall_fluxes(fluid::Fluid<2>&, fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_fluxes(fluid::Fluid<3>&, fluid::NormalFluxWalls<3>&, const std::string&);
template Task wall_contact(fluid::Fluid<2>&, const fluid::NormalFluxWalls<2>&, const std::string&);
template Task wall_contact(fluid::Fluid<3>&, const fluid::NormalFluxWalls<3>&, const std::string&);

}  // namespace aquagraph::tasks
