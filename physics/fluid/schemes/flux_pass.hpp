// The two flux passes over pairs (pair_loop.hpp), for any pair flux, and the choice of the pair flux by the scene.
#pragma once
#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/pair_loop.hpp"
#include "physics/fluid/schemes/ale_pair.hpp"
#include "physics/fluid/schemes/artificial_viscosity.hpp"
#include "physics/fluid/schemes/delta_sph.hpp"

namespace aquagraph::fluid {

// Particles keep their mass: acceleration and dρ/dt.
template <int D, class Pair>
struct FluxPass {
    Pair pair_flux;
    FluxFields<D> fields;
    const double* mass;
    const double* deviation;
    double* acceleration[D];
    double* deviation_rate;
    double gravity[D];
    double reference_density;

    FluxPass(Particles<D>& s, const Pair& pair_flux, const FluxParameters& parameters, const Tait& tait)
        : pair_flux(pair_flux),
          fields(s),
          mass(s.mass.data()),
          deviation(s.deviation.data()),
          deviation_rate(s.deviation_rate.data()),
          reference_density(tait.reference_density) {
        for (int d = 0; d < D; ++d) {
            acceleration[d] = s.acceleration[d].data();
            gravity[d] = parameters.gravity[d];
        }
    }

    struct Own : PairState<D> {
        double volume;
    };
    struct Sum {
        double lane[D + 1][W];  // forces, dilation
    };

    Own load(std::size_t i) const { return {fields.load(i), fields.volume[i]}; }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D];
        const PairFlux flux = pair_flux(i, fields, j, fields.volume[j] * seen, dx);
        for (int d = 0; d < D; ++d) sum.lane[d][l] -= flux.pressure * dx[d];
        sum.lane[D][l] += flux.dilation;
    }

    // What the pair gives to both.
    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, Sum& to_i, Sum& to_j, std::size_t l) const {
        double dx[D];
        const PairFlux flux = pair_flux(i, fields, j, 1.0, dx);  // per volume of the other
        const double on_i = flux.pressure * fields.volume[j], on_j = flux.pressure * i.volume;
        for (int d = 0; d < D; ++d) {
            to_i.lane[d][l] -= on_i * dx[d];
            to_j.lane[d][l] += on_j * dx[d];
        }
        to_i.lane[D][l] += flux.dilation * fields.volume[j];
        to_j.lane[D][l] += ((flux.closing + flux.closing) - flux.dilation) * i.volume;
    }

    void store(std::size_t i, const Own& own, const Sum& sum) const {
        const double inverse_density = own.volume / mass[i];
        for (int d = 0; d < D; ++d) acceleration[d][i] = gravity[d] + inverse_density * add_lanes(sum.lane[d]);
        deviation_rate[i] = -(reference_density + deviation[i]) * add_lanes(sum.lane[D]);
    }
};

// Particles exchange mass: d(m v)/dt over m, dm/dt and dρ/dt = (dm/dt - ρ dω/dt)/ω.
template <int D, class Pair>
struct AleFluxPass {
    Pair pair_flux;
    FluxFields<D> fields;
    const double* shift[D];
    const double* exchange;
    const double* mass;
    const double* deviation;
    double* acceleration[D];
    double* deviation_rate;
    double* mass_rate;
    double gravity[D];
    double reference_density;

    AleFluxPass(Particles<D>& s, const Pair& pair_flux, const FluxParameters& parameters, const Tait& tait)
        : pair_flux(pair_flux),
          fields(s),
          exchange(s.exchange.data()),
          mass(s.mass.data()),
          deviation(s.deviation.data()),
          deviation_rate(s.deviation_rate.data()),
          mass_rate(s.mass_rate.data()),
          reference_density(tait.reference_density) {
        for (int d = 0; d < D; ++d) {
            shift[d] = s.shift[d].data();
            acceleration[d] = s.acceleration[d].data();
            gravity[d] = parameters.gravity[d];
        }
    }

    struct Own : PairState<D> {
        double shift[D];
    };
    struct Sum {
        double momentum[D][W], mass[W], dilation[W];
    };

    Own load(std::size_t i) const {
        Own own{fields.load(i), {}};
        for (int d = 0; d < D; ++d) own.shift[d] = shift[d][i];
        return own;
    }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        const AleFlux<D> flux = pair_flux(i, i.shift, fields, shift, j, seen, exchange[j]);
        for (int d = 0; d < D; ++d) sum.momentum[d][l] -= flux.momentum[d];
        sum.mass[l] -= flux.mass;
        sum.dilation[l] += flux.dilation;
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        const double inverse_density = fields.volume[i] / mass[i];
        for (int d = 0; d < D; ++d) acceleration[d][i] = gravity[d] + inverse_density * add_lanes(sum.momentum[d]);
        const double mass_sum = add_lanes(sum.mass);
        mass_rate[i] = fields.volume[i] * mass_sum;
        deviation_rate[i] = mass_sum - (reference_density + deviation[i]) * add_lanes(sum.dilation);
    }
};

// Calls f(pair) with the pair flux of the scene's scheme between particles that keep their mass, which is also what
// walls of any scheme exert.
template <int D, class F>
decltype(auto) visit_pair(const Kernel<D>& kernel, const FluxParameters& parameters, const Tait& tait, F&& f) {
    return kernel.visit([&](const auto& k) {
        using K = std::remove_cvref_t<decltype(k)>;
        switch (parameters.scheme) {
            case Scheme::delta_sph:
                return f(DeltaSphPair<D, K>(k, tait, parameters.delta, parameters.alpha));
            case Scheme::artificial_viscosity:
                return f(ArtificialViscosityPair<D, K>(k, parameters.alpha));
            default:
                break;
        }
        const auto with_solver = [&](auto muscl) {
            switch (parameters.solver) {
                case RiemannSolver::low_dissipation:
                    return f(RiemannPair<D, K, muscl(), RiemannSolver::low_dissipation>{k, tait});
                case RiemannSolver::exact:
                    return f(RiemannPair<D, K, muscl(), RiemannSolver::exact>{k, tait});
                default:
                    return f(RiemannPair<D, K, muscl(), RiemannSolver::acoustic>{k, tait});
            }
        };
        return parameters.muscl ? with_solver(std::true_type()) : with_solver(std::false_type());
    });
}

// The same for pairs that exchange mass.
template <int D, class F>
decltype(auto) visit_ale_pair(const Kernel<D>& kernel, const FluxParameters& parameters, const Tait& tait, F&& f) {
    return kernel.visit([&](const auto& k) {
        using K = std::remove_cvref_t<decltype(k)>;
        const DensitySeries density(tait);
        const auto with_solver = [&](auto muscl) {
            switch (parameters.solver) {
                case RiemannSolver::low_dissipation:
                    return f(AlePair<D, K, muscl(), RiemannSolver::low_dissipation>{k, tait, density});
                case RiemannSolver::exact:
                    return f(AlePair<D, K, muscl(), RiemannSolver::exact>{k, tait, density});
                default:
                    return f(AlePair<D, K, muscl(), RiemannSolver::acoustic>{k, tait, density});
            }
        };
        return parameters.muscl ? with_solver(std::true_type()) : with_solver(std::false_type());
    });
}

}  // namespace aquagraph::fluid
