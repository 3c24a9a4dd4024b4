#include "physics/fluid/rebuild.hpp"

#include <stdexcept>
#include <utility>

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

// Ghosts and lists of particles that are in order.
template <int D>
void make_lists(Fluid<D>& fluid, GhostWalls<D>* walls, BlockLoop loop) {
    Particles<D>& particles = fluid.particles;
    if (walls) walls->rebuild(particles, fluid.spacing, fluid.lists.reach(), Vec<D>(fluid.flux.gravity), loop);
    fluid.search.build(particles, fluid.lists, walls ? &walls->visibility : nullptr, loop);
    if (fluid.transport == Transport::shifting) fluid.surface.resize(particles);
    fluid.relative_travel.lists_are_new();
}

template <int D>
void make_lists(Fluid<D>& fluid, NormalFluxWalls<D>* walls, BlockLoop loop) {
    walls->rebuild(fluid.particles, fluid.spacing, fluid.lists.reach(), loop);
    fluid.search.build(fluid.particles, fluid.lists, &walls->sight, loop);
    if (fluid.transport == Transport::shifting) fluid.surface.resize(fluid.particles);
}

// Particles and images come closer by at most twice the largest way of all plus twice that of walls.
template <int D>
bool hold_by_largest(const Fluid<D>& fluid, const Travel& travel, const ComingStep& coming) {
    return travel.so_far() + travel.of_step(coming.dt) + coming.walls_moved < 0.5 * fluid.lists.skin;
}

template <int D, class Walls>
void remake(Fluid<D>& fluid, Walls* walls, BlockLoop loop, FunctionRef<void()> also) {
    Particles<D>& particles = fluid.particles;
    Particles<D> now = particles;
    particles.resize(now.count, now.ghost_count);  // gradients too
    for (std::size_t d = 0; d < D; ++d)
        std::copy(particles.x_built[d].begin(), particles.x_built[d].end(), particles.x[d].begin());
    std::vector<Vec<D>> vertices;
    if (walls) {
        vertices = std::exchange(walls->panels.position, fluid.record.walls);
        if (walls->panels.position.size() != vertices.size())
            throw std::runtime_error("the walls had other vertices when the neighbour lists were made");
    }
    make_lists(fluid, walls, loop);
    also();
    fluid.integration.resize(particles);
    if (particles.ghost_count != now.ghost_count)
        throw std::runtime_error("there were " + std::to_string(now.ghost_count) + " ghosts, and now there are " +
                                 std::to_string(particles.ghost_count));
    std::swap(now.grad_p, particles.grad_p);
    std::swap(now.grad_v, particles.grad_v);
    particles = std::move(now);
    if (walls) {
        walls->panels.position = std::move(vertices);
        walls->update_geometry();
    }
}

}  // namespace

template <int D>
void rebuild_lists(Fluid<D>& fluid, GhostWalls<D>* walls, BlockLoop loop) {
    if (walls && walls->periodic.any()) walls->periodic.wrap(fluid.particles);
    sort(fluid, loop);
    make_lists(fluid, walls, loop);
    ++fluid.rebuilds;
}

template <int D>
void rebuild_lists(Fluid<D>& fluid, NormalFluxWalls<D>& walls, BlockLoop loop) {
    if (walls.is_periodic()) walls.images.periodic.wrap(fluid.particles);
    sort(fluid, loop);
    make_lists(fluid, &walls, loop);
    ++fluid.rebuilds;
}

template <int D>
bool lists_hold(Fluid<D>& fluid, const GhostWalls<D>* walls, const Travel& travel, const ComingStep& coming,
                BlockLoop loop) {
    if (hold_by_largest(fluid, travel, coming)) return true;
    if (travel.acceleration2 == 0) return false;  // before the first step it is not known
    const double reach = fluid.lists.reach();
    const auto was_near = [&](std::size_t i) { return walls->was_near(fluid.particles, i, reach); };
    const auto may_be_near = [&](std::size_t i) { return walls->is_near(fluid.particles, i, reach); };
    const NearWalls near{was_near, may_be_near};
    return fluid.relative_travel.holds(fluid.particles, fluid.search.grid(), fluid.lists, travel, coming,
                                       walls ? &near : nullptr, loop);
}

// What sees what across the edges of such walls is found out anew with the lists alone, and counts for more than pairs.
template <int D>
bool lists_hold(Fluid<D>& fluid, const NormalFluxWalls<D>*, const Travel& travel, const ComingStep& coming, BlockLoop) {
    return hold_by_largest(fluid, travel, coming);
}

template <int D>
void remake_lists(Fluid<D>& fluid, GhostWalls<D>* walls, BlockLoop loop, FunctionRef<void()> also) {
    remake(fluid, walls, loop, also);
}

template <int D>
void remake_lists(Fluid<D>& fluid, NormalFluxWalls<D>& walls, BlockLoop loop, FunctionRef<void()> also) {
    remake(fluid, &walls, loop, also);
}

template void remake_lists(Fluid<2>&, GhostWalls<2>*, BlockLoop, FunctionRef<void()>);
template void remake_lists(Fluid<3>&, GhostWalls<3>*, BlockLoop, FunctionRef<void()>);
template void remake_lists(Fluid<2>&, NormalFluxWalls<2>&, BlockLoop, FunctionRef<void()>);
template void remake_lists(Fluid<3>&, NormalFluxWalls<3>&, BlockLoop, FunctionRef<void()>);

template void rebuild_lists(Fluid<2>&, GhostWalls<2>*, BlockLoop);
template bool lists_hold(Fluid<2>&, const GhostWalls<2>*, const Travel&, const ComingStep&, BlockLoop);
template bool lists_hold(Fluid<2>&, const NormalFluxWalls<2>*, const Travel&, const ComingStep&, BlockLoop);
template void rebuild_lists(Fluid<3>&, GhostWalls<3>*, BlockLoop);
template bool lists_hold(Fluid<3>&, const GhostWalls<3>*, const Travel&, const ComingStep&, BlockLoop);
template bool lists_hold(Fluid<3>&, const NormalFluxWalls<3>*, const Travel&, const ComingStep&, BlockLoop);
template void rebuild_lists(Fluid<2>&, NormalFluxWalls<2>&, BlockLoop);
template void rebuild_lists(Fluid<3>&, NormalFluxWalls<3>&, BlockLoop);

}  // namespace aquagraph::fluid
