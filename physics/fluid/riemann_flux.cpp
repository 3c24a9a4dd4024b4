#include "physics/fluid/riemann_flux.hpp"

#include "physics/fluid/pair_loop.hpp"

namespace aquagraph::fluid {

namespace {

template <int D, bool muscl>
struct FluxPass {
    FluxFields<D> fields;
    const double* mass;
    const double* deviation;
    double* acceleration[D];
    double* deviation_rate;
    double gravity[D];
    double inverse_radius, slope_factor, reference_density;

    using Own = PairState<D>;
    struct Sum {
        double force[D][W], dilation[W];
    };

    Own load(std::size_t i) const { return fields.load(i); }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D];
        const PairFlux flux = pair_flux<D, muscl>(i, fields, j, seen, inverse_radius, slope_factor, dx);
        for (int d = 0; d < D; ++d) sum.force[d][l] -= flux.pressure * dx[d];
        sum.dilation[l] += flux.dilation;
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        const double inverse_density = fields.volume[i] / mass[i];
        for (int d = 0; d < D; ++d) acceleration[d][i] = gravity[d] + inverse_density * add_lanes(sum.force[d]);
        deviation_rate[i] = -(reference_density + deviation[i]) * add_lanes(sum.dilation);
    }
};

template <int D, bool muscl>
void run(Particles<D>& s, const NeighbourLists<D>& lists, const WendlandC2<D>& kernel, const FluxParameters& parameters,
         double reference_density, LaneRange lanes) {
    FluxPass<D, muscl> pass{.fields = FluxFields<D>(s),
                            .mass = s.mass.data(),
                            .deviation = s.deviation.data(),
                            .acceleration = {},
                            .deviation_rate = s.deviation_rate.data(),
                            .gravity = {},
                            .inverse_radius = 1 / kernel.radius(),
                            .slope_factor = kernel.slope_factor(),
                            .reference_density = reference_density};
    for (int d = 0; d < D; ++d) {
        pass.acceleration[d] = s.acceleration[d].data();
        pass.gravity[d] = parameters.gravity[d];
    }
    pair_loop<D>(lists, lanes, pass);
}

}  // namespace

template <int D>
void compute_fluxes(Particles<D>& s, const NeighbourLists<D>& lists, const WendlandC2<D>& kernel,
                    const FluxParameters& parameters, double reference_density, LaneRange lanes) {
    if (parameters.muscl)
        run<D, true>(s, lists, kernel, parameters, reference_density, lanes);
    else
        run<D, false>(s, lists, kernel, parameters, reference_density, lanes);
}

template void compute_fluxes(Particles<2>&, const NeighbourLists<2>&, const WendlandC2<2>&, const FluxParameters&,
                             double, LaneRange);
template void compute_fluxes(Particles<3>&, const NeighbourLists<3>&, const WendlandC2<3>&, const FluxParameters&,
                             double, LaneRange);

}  // namespace aquagraph::fluid
