#include "physics/fluid/rebuild.hpp"

namespace aquagraph::fluid {

namespace {

// Order in space; pressure, impedance and volume follow from what has been re-sorted.
template <int D>
void sort(Fluid<D>& fluid, BlockLoop loop) {
    Particles<D>& particles = fluid.particles;
    fluid.reorder.apply(particles, fluid.order.sort(particles.x, particles.count, fluid.spacing, loop), loop);
    loop(fluid.blocks(), [&](std::size_t block) {
        const LaneRange lanes = fluid.lanes(block);
        update_state(particles, fluid.tait, lanes);
        for (std::size_t i = lanes.begin; i < lanes.end; ++i)
            for (std::size_t d = 0; d < D; ++d) particles.x_built[d][i] = particles.x[d][i];
    });
    fluid.integration.resize(particles);
}

}  // namespace

template <int D>
void rebuild_lists(Fluid<D>& fluid, GhostWalls<D>* walls, BlockLoop loop) {
    Particles<D>& particles = fluid.particles;
    if (walls && walls->periodic.any()) walls->periodic.wrap(particles);
    sort(fluid, loop);
    if (walls) walls->rebuild(particles, fluid.spacing, fluid.lists.reach(), Vec<D>(fluid.flux.gravity));
    fluid.search.build(particles, fluid.lists, walls ? &walls->visibility : nullptr, loop);
    if (fluid.transport == Transport::shifting) fluid.surface.resize(particles);
    ++fluid.rebuilds;
}

template <int D>
void rebuild_lists(Fluid<D>& fluid, NormalFluxWalls<D>& walls, BlockLoop loop) {
    sort(fluid, loop);
    walls.rebuild(fluid.particles, fluid.spacing, fluid.lists.reach(), loop);
    fluid.search.build(fluid.particles, fluid.lists, &walls.sight, loop);
    ++fluid.rebuilds;
}

template void rebuild_lists(Fluid<2>&, GhostWalls<2>*, BlockLoop);
template void rebuild_lists(Fluid<3>&, GhostWalls<3>*, BlockLoop);
template void rebuild_lists(Fluid<2>&, NormalFluxWalls<2>&, BlockLoop);
template void rebuild_lists(Fluid<3>&, NormalFluxWalls<3>&, BlockLoop);

}  // namespace aquagraph::fluid
