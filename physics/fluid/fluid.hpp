// Everything that a fluid without walls is: particles, their lists, and the choices of the scene.
#pragma once
#include <string>

#include "physics/fluid/energy_ledger.hpp"
#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/free_surface.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/health.hpp"
#include "physics/fluid/neighbour_search.hpp"
#include "physics/fluid/relative_travel.hpp"
#include "physics/fluid/search_record.hpp"
#include "physics/fluid/spatial_order.hpp"
#include "physics/fluid/time_integration.hpp"
#include "physics/fluid/viscosity.hpp"

namespace aquagraph::fluid {

// Skin of the neighbour lists over R: longer lists cost every pruning more, shorter ones are rebuilt more often. On the
// gate at 2 mm 0.12, 0.2, 0.25, 0.3 took 25.3, 25.7, 24.4, 24.6 s, the search 19.5, 12.4, 9.8, 8.6 % of it. Water in
// 2D that meets no wall seldom needs new lists (relative_travel.hpp), and is 1 to 2 % faster with shorter ones.
template <int D>
constexpr double skin_ratio(bool walls) {
    return D == 2 && !walls ? 0.15 : 0.25;
}

template <int D>
struct Fluid {
    double spacing;  // Δx [m]
    Tait tait;
    Kernel<D> kernel;
    FluxParameters flux;
    double cfl;
    Domain<D> domain;
    bool closed;  // leaving the domain is an error

    Viscosity viscosity{};  // µ = 0: none
    Transport transport = Transport::none;
    double x_sph = 0.5;  // ε
    // Besides viscous_decay, at walls of normal fluxes (walls/normal_flux.hpp) [µ/(ρ R²)]; 0: none is no-slip.
    double wall_friction = 0;

    Particles<D> particles;
    NeighbourLists<D> lists;
    TimeIntegration<D> integration;
    NeighbourSearch<D> search;
    SpatialOrder<D> order;
    Reorder<D> reorder;
    FreeSurface<D> surface;  // with shifting
    EnergyLedger ledger;
    SearchRecord<D> record{};
    RelativeTravel<D> relative_travel{};

    long rebuilds = 0;          // of the lists
    long outrun = 0;            // steps in which some particle went further than the step's lists allowed for
    std::size_t removed = 0;    // particles that have left an open domain
    std::size_t held_back = 0;  // times that a lone particle was stopped at a wall (walls/ghosts.hpp)

    // For a checkpoint. Lists are made again as they were made (rebuild.hpp).
    template <class Archive>
    void archive(Archive& fields) {
        fields(particles, ledger, record, rebuilds, outrun, removed, held_back);
    }

    // Tells the particles what they carry besides; before they are made.
    void prepare_particles() {
        particles.has_mass_exchange = flux.scheme == Scheme::riemann_ale;
        particles.has_shift = transport != Transport::none;
    }
    GradientsOf gradients() const { return {flux.reads_pressure_gradient(), flux.reads_velocity_gradient()}; }
    double kinematic_viscosity() const { return viscosity.dynamic / tait.reference_density; }
    // Inverse of the largest step that viscosity allows for [1/s].
    double viscous_rate() const {
        return (viscous_decay(viscosity.form) + wall_friction) * kinematic_viscosity() /
               (kernel.radius() * kernel.radius() * integration.decay_of_step());
    }

    std::size_t blocks() const { return particles.blocks(); }
    LaneRange lanes(std::size_t block) const { return lanes_of_block(particles, block); }
};

// Kinetic and potential energy of all particles.
template <int D>
FluidEnergies total_energies(const Fluid<D>& fluid) {
    FluidEnergies sum;
    for (std::size_t block = 0; block < fluid.blocks(); ++block) {
        const FluidEnergies part = energies(fluid.particles, fluid.flux.gravity, fluid.lanes(block));
        sum.kinetic += part.kinetic;
        sum.potential += part.potential;
    }
    return sum;
}

// Memory of everything that is as long as there are particles [bytes], ghosts' shares included.
template <int D>
double bytes_per_particle(const Fluid<D>& fluid) {
    if (fluid.particles.count == 0) return 0;
    std::size_t bytes = fluid.particles.bytes() + fluid.integration.bytes() + fluid.search.bytes() +
                        fluid.order.bytes() + fluid.reorder.bytes() + fluid.relative_travel.bytes();
    for (const auto* lists : {&fluid.lists.blocks, &fluid.lists.inner})
        for (const NeighbourBlock& block : *lists)
            bytes += bytes_of(block.particle, block.open, block.masked, block.mask);
    return double(bytes) / double(fluid.particles.count);
}

// Runs something that takes energy out of the water otherwise than by pair forces, and books it.
template <int D, class F>
void book_loss(Fluid<D>& fluid, F&& f) {
    if (!fluid.ledger.kept) return f();
    const FluidEnergies before = total_energies(fluid);
    f();
    const FluidEnergies after = total_energies(fluid);
    fluid.ledger.lost += before.kinetic + before.potential - after.kinetic - after.potential;
}

}  // namespace aquagraph::fluid
