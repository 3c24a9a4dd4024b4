#include "physics/fluid/energy_ledger.hpp"

#include "physics/fluid/schemes/flux_pass.hpp"
#include "physics/fluid/viscous_pair.hpp"

namespace aquagraph::fluid {

namespace {

// Power per own volume of the pairs of each particle, of one block.
template <int D>
struct PairPowers {
    double total[clusters_per_block * W];  // into E_K and E_C
    double walls[clusters_per_block * W];  // of it, by the work of walls
};

template <int D, class Pair>
struct FluxEnergyPass {
    Pair pair_flux;
    FluxFields<D> fields;
    std::size_t ghost_begin, first;
    PairPowers<D>& powers;

    using Own = PairState<D>;
    struct Sum {
        double total[W], walls[W];
    };

    Own load(std::size_t i) const { return fields.load(i); }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], r, w, a = 0, b = 0;
        const PairFlux flux = pair_flux(i, fields, j, seen, dx);
        pair_geometry<D>(i, fields, j, seen, pair_flux.kernel, dx, r, w);
        for (int d = 0; d < D; ++d) {
            a += i.v[d] * dx[d];
            b += fields.v[d][j] * dx[d];
        }
        const double p_j = fields.p[j];
        sum.total[l] -= flux.pressure * a + i.p * flux.dilation;
        const double wall = (i.p * b + p_j * a) * w - 0.5 * ((i.p + p_j) * w - flux.pressure) * (a + b);
        sum.walls[l] -= j >= ghost_begin ? wall : 0.0;
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        powers.total[i - first] = add_lanes(sum.total);
        powers.walls[i - first] = add_lanes(sum.walls);
    }
};

// µ (…) of the viscous operator times the velocity.
template <int D, class Kernel, ViscousOperator form>
struct ViscousEnergyPass {
    Kernel kernel;
    double dynamic;
    FluxFields<D> fields;
    std::size_t ghost_begin, first;
    PairPowers<D>& powers;

    using Own = PairState<D>;
    struct Sum {
        double total[W], walls[W];
    };

    Own load(std::size_t i) const { return fields.load(i); }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], dv[D], r, w, force[D], own = 0, middle = 0;
        pair_geometry<D>(i, fields, j, seen, kernel, dx, r, w);
        for (int d = 0; d < D; ++d) dv[d] = fields.v[d][j] - i.v[d];
        viscous_pair<D, form>(dx, dv, r * r, w, force);
        for (int d = 0; d < D; ++d) {
            own += dynamic * force[d] * i.v[d];
            middle += dynamic * force[d] * (i.v[d] + 0.5 * dv[d]);
        }
        sum.total[l] += own;
        sum.walls[l] += j >= ghost_begin ? middle : 0.0;
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        powers.total[i - first] = add_lanes(sum.total);
        powers.walls[i - first] = add_lanes(sum.walls);
    }
};

}  // namespace

EnergyRates& EnergyRates::add(double weight, const EnergyRates& rates) {
    compression += weight * rates.compression;
    dissipation += weight * rates.dissipation;
    viscous += weight * rates.viscous;
    walls += weight * rates.walls;
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
EnergyRates energy_rates(const Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                         const FluxParameters& parameters, const Tait& tait, const Viscosity& viscosity,
                         LaneRange lanes) {
    EnergyRates rates;
    PairPowers<D> powers;
    const FluxFields<D> fields(s);
    visit_pair<D>(kernel, parameters, tait, [&](const auto& pair) {
        using Pair = std::remove_cvref_t<decltype(pair)>;
        pair_loop<D>(lists, lanes, FluxEnergyPass<D, Pair>{pair, fields, s.ghost_begin(), lanes.begin, powers});
    });
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const std::size_t k = i - lanes.begin;
        rates.compression += s.p[i] * s.volume[i] / (tait.reference_density + s.deviation[i]) * s.deviation_rate[i];
        rates.walls += s.volume[i] * powers.walls[k];
        rates.dissipation += s.volume[i] * (powers.walls[k] - powers.total[k]);
        if (s.has_shift)
            for (std::size_t d = 0; d < D; ++d) rates.displacement += s.mass[i] * parameters.gravity[d] * s.shift[d][i];
    }
    if (viscosity.dynamic == 0) return rates;
    kernel.visit([&](const auto& k) {
        using K = std::remove_cvref_t<decltype(k)>;
        const auto run = [&]<ViscousOperator form>(std::integral_constant<ViscousOperator, form>) {
            pair_loop<D>(
                lists, lanes,
                ViscousEnergyPass<D, K, form>{k, viscosity.dynamic, fields, s.ghost_begin(), lanes.begin, powers});
        };
        if (viscosity.form == ViscousOperator::morris)
            run(std::integral_constant<ViscousOperator, ViscousOperator::morris>());
        else
            run(std::integral_constant<ViscousOperator, ViscousOperator::monaghan_gingold>());
    });
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const std::size_t k = i - lanes.begin;
        rates.walls += s.volume[i] * powers.walls[k];
        rates.viscous += s.volume[i] * (powers.walls[k] - powers.total[k]);
    }
    return rates;
}

template EnergyRates energy_rates(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&,
                                  const FluxParameters&, const Tait&, const Viscosity&, LaneRange);
template EnergyRates energy_rates(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&,
                                  const FluxParameters&, const Tait&, const Viscosity&, LaneRange);

}  // namespace aquagraph::fluid
