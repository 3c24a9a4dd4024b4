#include "physics/fluid/walls/wall_forces.hpp"

namespace aquagraph::fluid {

template <int D>
bool WallForces<D>::is_of_wall(const GhostWalls<D>& walls, std::size_t particle, std::size_t ghost) const {
    const Ghost& from = walls.ghosts[ghost];
    const auto wall_of = [&](int panel) { return walls.panels.panels[std::size_t(panel)].wall; };
    if (from.is_image()) return false;
    if (from.corner < 0) return wall_of(from.panel) == wall_;
    // Where sight slips through the corner between its panels, the first of them.
    const Corner<D>& corner = walls.corners[std::size_t(from.corner)];
    const int entry = walls.visibility.entry_panel(particle, ghost);
    if (entry >= 0)
        for (std::size_t k = 0; k < corner.panels; ++k)
            if (walls.patch[std::size_t(corner.panel[k])] == walls.patch[std::size_t(entry)])
                return wall_of(corner.panel[k]) == wall_;
    return wall_of(corner.panel[0]) == wall_;
}

template <int D>
void WallForces<D>::rebuild(const Fluid<D>& fluid, const GhostWalls<D>& walls) {
    if (rebuilt_for_ == fluid.rebuilds) return;
    rebuilt_for_ = fluid.rebuilds;
    const Particles<D>& particles = fluid.particles;
    const std::size_t first_ghost_cluster = particles.clusters();
    lists_.radius = fluid.lists.radius;
    lists_.skin = fluid.lists.skin;
    lists_.blocks.resize(fluid.lists.blocks.size());
    needed_.assign(particles.clusters(), 0);
    clusters_.clear();
    for (std::size_t block = 0; block < fluid.blocks(); ++block) {
        const NeighbourBlock& from = fluid.lists.blocks[block];
        NeighbourBlock& to = lists_.blocks[block];
        to.open.clear();
        to.masked.clear();
        to.mask.clear();
        to.particle.assign(from.particle.size(), {0, 0, 0, 0});
        const LaneRange lanes = fluid.lanes(block);
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            const std::size_t before = to.masked.size();
            const auto keep = [&](std::uint32_t cluster, unsigned seen) {
                if (cluster < first_ghost_cluster) return;
                unsigned mask = 0;
                for (std::size_t l = 0; l < W; ++l) {
                    const std::size_t ghost = cluster * W + l - particles.ghost_begin();
                    if (!((seen >> l) & 1u) || ghost >= particles.ghost_count || !is_of_wall(walls, i, ghost)) continue;
                    mask |= 1u << l;
                    needed_[walls.ghosts[ghost].parent / W] = 1;
                }
                if (mask == 0) return;
                to.masked.push_back(cluster);
                to.mask.push_back(std::uint8_t(mask));
            };
            const auto begin = from.particle[i - lanes.begin], end = from.particle[i - lanes.begin + 1];
            for (auto k = begin.open_end; k < end.open_end; ++k) keep(from.open[k], 0xff);
            for (auto k = begin.masked_end; k < end.masked_end; ++k) keep(from.masked[k], from.mask[k]);
            to.particle[i - lanes.begin + 1] = {0, std::uint32_t(to.masked.size()), 0, 0};
            if (to.masked.size() == before) continue;
            needed_[i / W] = 1;
            if (clusters_.empty() || clusters_.back() != i / W) clusters_.push_back(std::uint32_t(i / W));
        }
    }
    gradient_clusters_.clear();
    for (std::size_t c = 0; c < needed_.size(); ++c)
        if (needed_[c]) gradient_clusters_.push_back(std::uint32_t(c));
    part_.assign(blocks(), Vec<D>::Zero());
}

template <int D>
void WallForces<D>::compute(Fluid<D>& fluid, std::size_t block) {
    Particles<D>& particles = fluid.particles;
    Vec<D> sum = Vec<D>::Zero();
    const std::size_t end = std::min(clusters_.size(), (block + 1) * clusters_per_part);
    for (std::size_t k = block * clusters_per_part; k < end; ++k) {
        const LaneRange lanes = lanes_of_cluster(particles, clusters_[k]);
        double acceleration[D][W], deviation_rate[W], mass_rate[W];
        const bool exchange = particles.has_mass_exchange;
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            deviation_rate[i - lanes.begin] = particles.deviation_rate[i];
            if (exchange) mass_rate[i - lanes.begin] = particles.mass_rate[i];
            for (std::size_t d = 0; d < D; ++d) acceleration[d][i - lanes.begin] = particles.acceleration[d][i];
        }
        compute_fluxes(particles, lists_, fluid.kernel, fluid.flux, fluid.tait, lanes);
        if (fluid.viscosity.dynamic > 0) add_viscosity(particles, lists_, fluid.kernel, fluid.viscosity, lanes);
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            for (std::size_t d = 0; d < D; ++d) {
                sum[int(d)] -= particles.mass[i] * (particles.acceleration[d][i] - fluid.flux.gravity[d]);
                particles.acceleration[d][i] = acceleration[d][i - lanes.begin];
            }
            particles.deviation_rate[i] = deviation_rate[i - lanes.begin];
            if (exchange) particles.mass_rate[i] = mass_rate[i - lanes.begin];
        }
    }
    part_[block] = sum;
}

template <int D>
Vec<D> WallForces<D>::force() const {
    Vec<D> sum = Vec<D>::Zero();
    for (const Vec<D>& part : part_) sum += part;
    return sum;
}

template <int D>
EnergyRates WallForces<D>::power(const Fluid<D>& fluid, std::size_t block) const {
    EnergyRates sum;
    const std::size_t end = std::min(clusters_.size(), (block + 1) * clusters_per_part);
    for (std::size_t k = block * clusters_per_part; k < end; ++k)
        sum.add(1, energy_rates(fluid.particles, lists_, fluid.kernel, fluid.flux, fluid.tait, fluid.viscosity,
                                lanes_of_cluster(fluid.particles, clusters_[k])));
    return sum;
}

template class WallForces<2>;
template class WallForces<3>;

}  // namespace aquagraph::fluid
