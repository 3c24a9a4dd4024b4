// Everything that a fluid without walls is: particles, their lists, and the choices of the scene.
#pragma once
#include <string>

#include "physics/fluid/health.hpp"
#include "physics/fluid/riemann_flux.hpp"
#include "physics/fluid/runge_kutta.hpp"

namespace aquagraph::fluid {

// Skin of the neighbour lists over R: longer lists cost every pass more, shorter ones are rebuilt more often. On the
// gate at 2 mm 0.12, 0.2, 0.25, 0.3 took 25.3, 25.7, 24.4, 24.6 s, the search 19.5, 12.4, 9.8, 8.6 % of it.
inline constexpr double skin_ratio = 0.25;

template <int D>
struct Fluid {
    double spacing;  // Δx [m]
    Tait tait;
    WendlandC2<D> kernel;
    FluxParameters flux;
    double cfl;
    Domain<D> domain;
    bool closed;  // leaving the domain is an error

    Particles<D> particles;
    NeighbourLists<D> lists;
    RungeKutta<D> runge_kutta;
    NeighbourSearch<D> search;
    SpatialOrder<D> order;
    Reorder<D> reorder;

    long rebuilds = 0;          // of the lists
    std::size_t removed = 0;    // particles that have left an open domain
    std::size_t held_back = 0;  // times that a lone particle was stopped at a wall (walls/ghosts.hpp)

    std::size_t blocks() const { return particles.blocks(); }
    LaneRange lanes(std::size_t block) const { return lanes_of_block(particles, block); }
};

}  // namespace aquagraph::fluid
