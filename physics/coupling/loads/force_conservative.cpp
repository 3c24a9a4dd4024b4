#include "physics/coupling/loads/force_conservative.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "physics/fluid/schemes/flux_pass.hpp"
#include "physics/fluid/viscous_pair.hpp"

namespace aquagraph::coupling {

using fluid::W;

namespace {
bool is_wet(const fluid::GhostWalls<2>& walls, int panel) {
    return panel >= 0 && walls.panels.panels[std::size_t(panel)].wet;
}
}  // namespace

void ForceConservativeLoad::mark_wet_clusters(const fluid::GhostWalls<2>& walls) {
    is_wet_cluster_.assign((walls.ghosts.size() + W - 1) / W, 0);
    for (std::size_t g = 0; g < walls.ghosts.size(); ++g) {
        const fluid::Ghost& ghost = walls.ghosts[g];
        bool wet = is_wet(walls, ghost.panel);
        if (ghost.corner >= 0)
            for (const int panel : walls.corners[std::size_t(ghost.corner)].panel) wet |= is_wet(walls, panel);
        if (wet) is_wet_cluster_[g / W] = 1;
    }
}

void ForceConservativeLoad::collect(const fluid::Particles<2>& particles, const fluid::NeighbourLists<2>& lists,
                                    const fluid::GhostWalls<2>& walls, std::size_t block,
                                    std::vector<Pair>& pairs) const {
    const std::size_t first_ghost_cluster = particles.clusters();
    const double reach2 = lists.reach() * lists.reach();
    const auto counts = [&](std::uint32_t cluster) {
        return cluster >= first_ghost_cluster && is_wet_cluster_[cluster - first_ghost_cluster];
    };

    pairs.clear();
    const auto visit = [&](std::size_t i, std::uint32_t cluster, unsigned mask) {
        for (std::size_t l = 0; l < W; ++l) {
            const std::size_t lane = cluster * W + l, g = lane - particles.ghost_begin();
            if (!((mask >> l) & 1u) || g >= particles.ghost_count) continue;
            const double dx = particles.x[0][lane] - particles.x[0][i], dy = particles.x[1][lane] - particles.x[1][i];
            if (dx * dx + dy * dy >= reach2) continue;
            const fluid::Ghost& ghost = walls.ghosts[g];
            if (ghost.corner < 0) {
                if (is_wet(walls, ghost.panel)) pairs.push_back({std::uint32_t(g), std::uint32_t(i), ghost.panel});
                continue;
            }
            // A corner's ghost loads the panel through which it is seen: the corner's own one of that patch. Where
            // sight slips through the corner between the two, the wet one.
            const int entry = walls.visibility.entry_panel(i, g);
            for (const int panel : walls.corners[std::size_t(ghost.corner)].panel) {
                if (is_wet(walls, panel) &&
                    (entry < 0 || walls.patch[std::size_t(panel)] == walls.patch[std::size_t(entry)])) {
                    pairs.push_back({std::uint32_t(g), std::uint32_t(i), panel});
                    break;
                }
            }
        }
    };
    const auto& list = lists.blocks[block];
    const fluid::LaneRange lanes = lanes_of_block(particles, block);
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        if (!walls.grid.at(Vec2(particles.x[0][i], particles.x[1][i]))) continue;  // no ghost in sight
        const auto from = list.particle[i - lanes.begin], to = list.particle[i - lanes.begin + 1];
        for (auto k = from.open_end; k < to.open_end; ++k)
            if (counts(list.open[k])) visit(i, list.open[k], 0xff);
        for (auto k = from.masked_end; k < to.masked_end; ++k)
            if (counts(list.masked[k])) visit(i, list.masked[k], list.mask[k]);
    }
}

void ForceConservativeLoad::rebuild(const fluid::Particles<2>& particles, const fluid::NeighbourLists<2>& lists,
                                    const fluid::GhostWalls<2>& walls, BlockLoop loop) {
    mark_wet_clusters(walls);
    const std::size_t blocks = lists.blocks.size();
    if (pairs_of_block_.size() < blocks) pairs_of_block_.resize(blocks);
    loop(blocks, [&](std::size_t block) { collect(particles, lists, walls, block, pairs_of_block_[block]); });
    pairs_.clear();
    for (std::size_t block = 0; block < blocks; ++block)
        pairs_.insert(pairs_.end(), pairs_of_block_[block].begin(), pairs_of_block_[block].end());
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
        return std::tie(a.ghost, a.panel, a.fluid) < std::tie(b.ghost, b.panel, b.fluid);
    });

    sources_.clear();
    fluid_.clear();
    needed_.assign(particles.clusters(), 0);
    for (const Pair& pair : pairs_) {
        if (sources_.empty() || sources_.back().ghost != pair.ghost || sources_.back().panel != pair.panel) {
            sources_.push_back({pair.ghost, pair.panel, std::uint32_t(fluid_.size()), 0});
            needed_[walls.ghosts[pair.ghost].parent / W] = 1;
        }
        fluid_.push_back(pair.fluid);
        needed_[pair.fluid / W] = 1;
        sources_.back().end = std::uint32_t(fluid_.size());
    }
    force_.assign(sources_.size(), Vec2::Zero());
    clusters_.clear();
    for (std::size_t c = 0; c < needed_.size(); ++c)
        if (needed_[c]) clusters_.push_back(std::uint32_t(c));
}

namespace {
template <class Pair>
Vec2 force_on_ghost(const fluid::FluxFields<2>& fields, const Pair& pair_flux, std::size_t lane,
                    const std::uint32_t* neighbour, std::size_t n) {
    const auto own = fields.load(lane);
    double fx = 0, fy = 0;
#pragma omp simd reduction(- : fx, fy)
    for (std::size_t k = 0; k < n; ++k) {
        double dx[2];
        const auto flux = pair_flux(own, fields, neighbour[k], fields.volume[neighbour[k]], dx);
        fx -= flux.pressure * dx[0];
        fy -= flux.pressure * dx[1];
    }
    return fields.volume[lane] * Vec2(fx, fy);
}

// The viscous part, µ ω_g ω_i L_gi: what the operator takes from the particles.
template <fluid::ViscousOperator form, class Kernel>
Vec2 friction_on_ghost(const fluid::Particles<2>& s, const Kernel& kernel, double dynamic, std::size_t lane,
                       const std::uint32_t* neighbour, std::size_t n) {
    double sum[2] = {};
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = neighbour[k];
        const double dx[2] = {s.x[0][i] - s.x[0][lane], s.x[1][i] - s.x[1][lane]},
                     dv[2] = {s.v[0][i] - s.v[0][lane], s.v[1][i] - s.v[1][lane]},
                     r2 = dx[0] * dx[0] + dx[1] * dx[1] + 1e-200;
        double laplacian[2];
        fluid::viscous_pair<2, form>(dx, dv, r2, kernel.slope(std::sqrt(r2) * kernel.inverse_radius()) * s.volume[i],
                                     laplacian);
        for (int d = 0; d < 2; ++d) sum[d] += laplacian[d];
    }
    return dynamic * s.volume[lane] * Vec2(sum[0], sum[1]);
}
}  // namespace

void ForceConservativeLoad::compute(const fluid::Fluid<2>& fluid, std::size_t block) {
    const fluid::FluxFields<2> fields(fluid.particles);
    const std::size_t end = std::min(sources_.size(), (block + 1) * sources_per_block);
    fluid::visit_pair<2>(fluid.kernel, fluid.flux, fluid.tait, [&](const auto& pair_flux) {
        for (std::size_t s = block * sources_per_block; s < end; ++s) {
            const Source& source = sources_[s];
            const std::size_t lane = fluid.particles.ghost_begin() + source.ghost;
            force_[s] =
                force_on_ghost(fields, pair_flux, lane, fluid_.data() + source.begin, source.end - source.begin);
        }
    });
    if (fluid.viscosity.dynamic == 0) return;
    const auto add_friction = [&]<fluid::ViscousOperator form>() {
        fluid.kernel.visit([&](const auto& kernel) {
            for (std::size_t s = block * sources_per_block; s < end; ++s) {
                const Source& source = sources_[s];
                force_[s] += friction_on_ghost<form>(fluid.particles, kernel, fluid.viscosity.dynamic,
                                                     fluid.particles.ghost_begin() + source.ghost,
                                                     fluid_.data() + source.begin, source.end - source.begin);
            }
        });
    };
    if (fluid.viscosity.form == fluid::ViscousOperator::morris)
        add_friction.template operator()<fluid::ViscousOperator::morris>();
    else
        add_friction.template operator()<fluid::ViscousOperator::monaghan_gingold>();
}

void ForceConservativeLoad::spread(const fluid::Particles<2>& particles, const fluid::GhostWalls<2>& walls,
                                   std::vector<Vec2>& vertex_forces) const {
    vertex_forces.assign(walls.panels.position.size(), Vec2::Zero());
    for (std::size_t k = 0; k < sources_.size(); ++k) {
        const Source& source = sources_[k];
        // A corner's ghost acts at the corner: there the wall velocity that it gives to the fluid is taken. Of a corner
        // that slides along a floor the part across the floor is the floor's, in velocity and in force.
        const fluid::Ghost& ghost = walls.ghosts[source.ghost];
        const std::size_t p = std::size_t(source.panel);
        const Vec2 x =
            ghost.corner < 0 ? walls.before_wall(particles, ghost) : walls.corners[std::size_t(ghost.corner)].point;
        const double s =
            std::clamp((x - walls.panels.start(p)).dot(walls.panels.tangent[p]) / walls.panels.measure[p], 0.0, 1.0);
        Vec2 force = force_[k];
        if (ghost.corner >= 0) {
            for (const int f : walls.corners[std::size_t(ghost.corner)].floor)
                if (f >= 0 && std::size_t(f) != p) {
                    const Vec2& up = walls.panels.normal[std::size_t(f)];
                    force -= force.dot(up) * up;
                }
        }
        vertex_forces[std::size_t(walls.panels.panels[p].vertex[0])] += (1 - s) * force;
        vertex_forces[std::size_t(walls.panels.panels[p].vertex[1])] += s * force;
    }
}

}  // namespace aquagraph::coupling
