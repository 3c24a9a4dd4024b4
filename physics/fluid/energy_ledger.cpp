#include "physics/fluid/energy_ledger.hpp"

#include "physics/fluid/schemes/flux_pass.hpp"
#include "physics/fluid/viscous_pair.hpp"

namespace aquagraph::fluid {

namespace {

// Power per own volume of the pairs of each particle, of one block.
struct PairPowers {
    double motion[PairEnergies::most];       // into E_K
    double compression[PairEnergies::most];  // into E_C
    double passed_on[PairEnergies::most];    // what passes from j to i unchanged, of lanes from a first one on
};

template <int D, class Pair>
struct FluxEnergyPass {
    Pair pair_flux;
    FluxFields<D> fields;
    std::size_t passed_on_from, first;
    PairPowers& powers;

    using Own = PairState<D>;
    struct Sum {
        double motion[W], compression[W], passed_on[W];
    };

    Own load(std::size_t i) const { return fields.load(i); }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], r, r2, w, a = 0, b = 0;
        const PairFlux flux = pair_flux(i, fields, j, fields.volume[j] * seen, dx);
        pair_geometry<D>(i, fields, j, fields.volume[j] * seen, pair_flux.kernel, dx, r, r2, w);
        for (int d = 0; d < D; ++d) {
            a += i.v[d] * dx[d];
            b += fields.v[d][j] * dx[d];
        }
        const double p_j = fields.p[j];
        sum.motion[l] -= flux.pressure * a;
        sum.compression[l] -= i.p * flux.dilation;
        const double power = (i.p * b + p_j * a) * w - 0.5 * ((i.p + p_j) * w - flux.pressure) * (a + b);
        sum.passed_on[l] -= j >= passed_on_from ? power : 0.0;
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        powers.motion[i - first] = add_lanes(sum.motion);
        powers.compression[i - first] = add_lanes(sum.compression);
        powers.passed_on[i - first] = add_lanes(sum.passed_on);
    }
};

// µ (…) of the viscous operator times the velocity.
template <int D, class Kernel, ViscousOperator form>
struct ViscousEnergyPass {
    Kernel kernel;
    double dynamic;
    FluxFields<D> fields;
    std::size_t passed_on_from, first;
    PairPowers& powers;

    using Own = PairState<D>;
    struct Sum {
        double motion[W], passed_on[W];
    };

    Own load(std::size_t i) const { return fields.load(i); }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], dv[D], r, r2, w, force[D], own = 0, middle = 0;
        pair_geometry<D>(i, fields, j, fields.volume[j] * seen, kernel, dx, r, r2, w);
        for (int d = 0; d < D; ++d) dv[d] = fields.v[d][j] - i.v[d];
        viscous_pair<D, form>(dx, dv, r2, w, force);
        for (int d = 0; d < D; ++d) {
            own += dynamic * force[d] * i.v[d];
            middle += dynamic * force[d] * (i.v[d] + 0.5 * dv[d]);
        }
        sum.motion[l] += own;
        sum.passed_on[l] += j >= passed_on_from ? middle : 0.0;
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        powers.motion[i - first] = add_lanes(sum.motion);
        powers.passed_on[i - first] = add_lanes(sum.passed_on);
    }
};

template <int D>
void flux_powers(const Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                 const FluxParameters& parameters, const Tait& tait, std::size_t passed_on_from, LaneRange lanes,
                 PairPowers& powers) {
    const FluxFields<D> fields(s);
    visit_pair<D>(kernel, parameters, tait, [&](const auto& pair) {
        using Pair = std::remove_cvref_t<decltype(pair)>;
        pair_loop<D>(lists, lanes, FluxEnergyPass<D, Pair>{pair, fields, passed_on_from, lanes.begin, powers});
    });
}

template <int D>
void viscous_powers(const Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                    const Viscosity& viscosity, std::size_t passed_on_from, LaneRange lanes, PairPowers& powers) {
    const FluxFields<D> fields(s);
    kernel.visit([&](const auto& k) {
        using K = std::remove_cvref_t<decltype(k)>;
        const auto run = [&]<ViscousOperator form>(std::integral_constant<ViscousOperator, form>) {
            pair_loop<D>(
                lists, lanes,
                ViscousEnergyPass<D, K, form>{k, viscosity.dynamic, fields, passed_on_from, lanes.begin, powers});
        };
        if (viscosity.form == ViscousOperator::morris)
            run(std::integral_constant<ViscousOperator, ViscousOperator::morris>());
        else
            run(std::integral_constant<ViscousOperator, ViscousOperator::monaghan_gingold>());
    });
}

}  // namespace

EnergyRates& EnergyRates::add(double weight, const EnergyRates& rates) {
    compression += weight * rates.compression;
    dissipation += weight * rates.dissipation;
    viscous += weight * rates.viscous;
    walls += weight * rates.walls;
    defect += weight * rates.defect;
    displacement += weight * rates.displacement;
    return *this;
}

void EnergyLedger::accumulate(IntegrationScheme scheme, int stage, double dt) {
    EnergyRates rates;
    for (const EnergyRates& block : part) rates.add(1, block);
    switch (scheme) {
        case IntegrationScheme::rk4:
            sum.add(dt / (stage == 0 || stage == 3 ? 6 : 3), rates);
            break;
        case IntegrationScheme::rk3: {
            constexpr double b[3] = {1.0 / 6, 3.0 / 10, 8.0 / 15};  // what the low-storage form amounts to
            sum.add(dt * b[stage], rates);
            break;
        }
        case IntegrationScheme::verlet:
            sum.add(0.5 * dt, last).add(0.5 * dt, rates);
            last = rates;
    }
}

template <int D>
void pair_energies(const Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                   const FluxParameters& parameters, const Tait& tait, const Viscosity& viscosity, LaneRange lanes,
                   PairEnergies& energies) {
    PairPowers powers;
    flux_powers(s, lists, kernel, parameters, tait, 0, lanes, powers);
    const std::size_t n = lanes.end - lanes.begin;
    for (std::size_t k = 0; k < n; ++k) {
        energies.motion[k] = powers.motion[k];
        energies.dissipated[k] = powers.passed_on[k] - powers.motion[k] - powers.compression[k];
        energies.viscous_motion[k] = energies.heat[k] = 0;
    }
    if (viscosity.dynamic == 0) return;
    viscous_powers(s, lists, kernel, viscosity, 0, lanes, powers);
    for (std::size_t k = 0; k < n; ++k) {
        energies.viscous_motion[k] = powers.motion[k];
        energies.heat[k] = powers.passed_on[k] - powers.motion[k];
    }
}

template <int D>
EnergyRates energy_rates(const Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                         const FluxParameters& parameters, const Tait& tait, const Viscosity& viscosity,
                         LaneRange lanes) {
    EnergyRates rates;
    PairPowers powers;
    flux_powers(s, lists, kernel, parameters, tait, s.ghost_begin(), lanes, powers);
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const std::size_t k = i - lanes.begin;
        rates.compression += s.p[i] * s.volume[i] / (tait.reference_density + s.deviation[i]) * s.deviation_rate[i];
        rates.walls += s.volume[i] * powers.passed_on[k];
        rates.dissipation += s.volume[i] * (powers.passed_on[k] - powers.motion[k] - powers.compression[k]);
        if (s.has_shift)
            for (std::size_t d = 0; d < D; ++d) rates.displacement += s.mass[i] * parameters.gravity[d] * s.shift[d][i];
    }
    if (viscosity.dynamic == 0) return rates;
    viscous_powers(s, lists, kernel, viscosity, s.ghost_begin(), lanes, powers);
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const std::size_t k = i - lanes.begin;
        rates.walls += s.volume[i] * powers.passed_on[k];
        rates.viscous += s.volume[i] * (powers.passed_on[k] - powers.motion[k]);
    }
    return rates;
}

template void pair_energies(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const FluxParameters&,
                            const Tait&, const Viscosity&, LaneRange, PairEnergies&);
template void pair_energies(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const FluxParameters&,
                            const Tait&, const Viscosity&, LaneRange, PairEnergies&);
template EnergyRates energy_rates(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&,
                                  const FluxParameters&, const Tait&, const Viscosity&, LaneRange);
template EnergyRates energy_rates(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&,
                                  const FluxParameters&, const Tait&, const Viscosity&, LaneRange);

}  // namespace aquagraph::fluid
