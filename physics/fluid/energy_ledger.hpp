// Where the fluid's energy goes (thesis 5.2-5.3): E_K + E_P + E_C + E_V + E_viscous = initial energy + work of the
// walls.
//     E_K, E_P   kinetic and potential, from the state (health.hpp)
//     E_C        compression: Σ p_i (ω_i/ρ_i) dρ_i/dt
//     E_V        what stabilises the scheme, irreversible: (5.18) of δ-SPH, (5.31) of Riemann-SPH
//     E_viscous  what viscosity turns into heat
//     walls      power of mirror images j on particles i (5.20), (5.32), with Π' = p_i + p_j - 2 p_e:
//                -Σ_i Σ_j [(p_i v_j + p_j v_i) - ½ Π' (v_i + v_j)]·∇W_ij ω_i ω_j, and friction on no-slip walls
//                likewise
// Rates are accumulated with the weights of the time integration, so the balance closes to its error. The pairs are
// those of the flux pass once more: it costs about as much as the fluxes, and is done only where a scene asks for it.
// Schemes without mass exchange. Walls of normal fluxes: walls/normal_flux.hpp, with a defect besides.
#pragma once
#include <vector>

#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/viscosity.hpp"

namespace aquagraph::fluid {

struct EnergyRates {  // [W] ([W/m] in 2D)
    double compression = 0, dissipation = 0, viscous = 0, walls = 0;
    double defect = 0;        // of walls of normal fluxes: energy that is neither dissipated nor kept
    double displacement = 0;  // potential energy that X-SPH's δv takes out, moving particles against or along gravity
    EnergyRates& add(double weight, const EnergyRates& rates);
};

struct EnergyLedger {
    bool kept = false;
    EnergyRates sum;                // since the start [J]
    EnergyRates last;               // Verlet: of the step before
    double lost = 0;                // kinetic and potential, of particles taken out or stopped at walls [J]
    std::vector<EnergyRates> part;  // of each block

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(sum, last, lost);
    }

    // Adds the rates of a stage, blocks in order, weighted as the integration weighs its stages.
    void accumulate(IntegrationScheme scheme, int stage, double dt);
};

// What the pairs of each particle of one block do, per its volume [W/m^D].
struct PairEnergies {
    static constexpr std::size_t most = clusters_per_block * W;
    double motion[most];          // of pressures times its velocity
    double dissipated[most];      // by the pair fluxes, its half
    double viscous_motion[most];  // of viscosity times its velocity
    double heat[most];            // of viscosity, its half
};
template <int D>
void pair_energies(const Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                   const FluxParameters& parameters, const Tait& tait, const Viscosity& viscosity, LaneRange lanes,
                   PairEnergies& energies);

// The rates of these particles (of one block), in the state in which the flux pass has just been.
template <int D>
EnergyRates energy_rates(const Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                         const FluxParameters& parameters, const Tait& tait, const Viscosity& viscosity,
                         LaneRange lanes);

extern template void pair_energies(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&,
                                   const FluxParameters&, const Tait&, const Viscosity&, LaneRange, PairEnergies&);
extern template void pair_energies(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&,
                                   const FluxParameters&, const Tait&, const Viscosity&, LaneRange, PairEnergies&);
extern template EnergyRates energy_rates(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&,
                                         const FluxParameters&, const Tait&, const Viscosity&, LaneRange);
extern template EnergyRates energy_rates(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&,
                                         const FluxParameters&, const Tait&, const Viscosity&, LaneRange);

}  // namespace aquagraph::fluid
