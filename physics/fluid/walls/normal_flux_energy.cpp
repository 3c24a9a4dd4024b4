// The energy ledger of a fluid between walls of normal fluxes.
#include "physics/fluid/walls/wall_flux.hpp"

namespace aquagraph::fluid {

template <int D>
template <class K>
typename NormalFluxWalls<D>::WallEnergies NormalFluxWalls<D>::wall_energies(const NearBlock& b, std::size_t k,
                                                                            const Particles<D>& s, const K& kernel,
                                                                            const FluxParameters& parameters,
                                                                            const Viscosity& viscosity,
                                                                            double spacing) const {
    const PointFields<D> fields(points);
    const std::size_t i = b.near[k].particle;
    const Range range = points_of(b, k);
    WallFlux<D> own(s, i, parameters, s.volume[i] / s.mass[i]), at_rest = own;
    own.lower_impedance(fields, &b.point[range.begin], range.end - range.begin, kernel, gamma_[i]);
    at_rest.impedance = 0;  // p_s is then p_L
    WallEnergies sum;
    for (std::size_t q = range.begin; q < range.end; ++q) {
        const std::size_t point = b.point[q];
        if (point == points.size()) continue;
        double weight, p_s, p_L, dilation;
        own(fields, point, kernel, weight, p_s, dilation);
        at_rest(fields, point, kernel, weight, p_L, dilation);
        sum.dissipated -= (p_s - p_L) * dilation;
        if (viscosity.dynamic == 0 || !panels.panels[std::size_t(points.cell[point].panel)].no_slip) continue;
        Vec<D> slip;
        for (int d = 0; d < D; ++d) slip[d] = s.v[std::size_t(d)][i] - points.velocity[std::size_t(d)][point];
        sum.heat -= wall_friction<D>(kernel, viscosity, points.place(point) - place(s, i), points.outward(point),
                                     points.area[point], shear_rate(s, i, point, spacing))
                        .dot(slip);
    }
    return sum;
}

template <int D>
EnergyRates NormalFluxWalls<D>::energy_rates(const Particles<D>& s, const NeighbourLists<D>& lists,
                                             const Kernel<D>& kernel, const FluxParameters& parameters,
                                             const Tait& tait, const Viscosity& viscosity, double spacing,
                                             std::size_t block, std::span<double> of_wall) const {
    const NearBlock& b = near_[block];
    const LaneRange lanes = lanes_of_block(s, block);
    PairEnergies pairs;
    pair_energies(s, lists, kernel, parameters, tait, viscosity, lanes, pairs);
    EnergyRates rates;
    double motion = 0, before = 0;
    for (const double power : of_wall) before += power;
    std::size_t near = 0;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const std::size_t at = i - lanes.begin;
        rates.compression += s.p[i] * s.volume[i] / (tait.reference_density + s.deviation[i]) * s.deviation_rate[i];
        motion += s.volume[i] * (pairs.motion[at] + pairs.viscous_motion[at]);
        WallEnergies walls;
        if (near < b.near.size() && b.near[near].particle == i) {
            for (std::size_t d = 0; d < D; ++d) motion += s.v[d][i] * b.reaction[near * D + d];
            kernel.visit([&](const auto& k) { walls = wall_energies(b, near, s, k, parameters, viscosity, spacing); });
            add_powers(b, near, s, kernel, parameters, of_wall);
            ++near;
        }
        const double share = s.volume[i] / gamma_[i];
        rates.dissipation += share * (pairs.dissipated[at] + walls.dissipated);
        rates.viscous += share * (pairs.heat[at] + walls.heat);
        if (s.has_shift)
            for (std::size_t d = 0; d < D; ++d) rates.displacement += s.mass[i] * parameters.gravity[d] * s.shift[d][i];
    }
    rates.walls = -before;
    for (const double power : of_wall) rates.walls += power;
    rates.defect = rates.walls - motion - rates.compression - rates.dissipation - rates.viscous;
    return rates;
}

template EnergyRates NormalFluxWalls<2>::energy_rates(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&,
                                                      const FluxParameters&, const Tait&, const Viscosity&, double,
                                                      std::size_t, std::span<double>) const;
template EnergyRates NormalFluxWalls<3>::energy_rates(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&,
                                                      const FluxParameters&, const Tait&, const Viscosity&, double,
                                                      std::size_t, std::span<double>) const;

}  // namespace aquagraph::fluid
