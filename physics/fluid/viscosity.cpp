#include "physics/fluid/viscosity.hpp"

#include <cmath>

#include "physics/fluid/motions.hpp"
#include "physics/fluid/pair_loop.hpp"
#include "physics/fluid/viscous_pair.hpp"

namespace aquagraph::fluid {

namespace {

template <int D, class Kernel, ViscousOperator form>
struct ViscosityPass : Motions<D> {
    using typename Motions<D>::Own;
    using Motions<D>::x, Motions<D>::v;
    Kernel kernel;
    double dynamic;
    const double* volume;
    const double* mass;
    double* acceleration[D];

    ViscosityPass(Particles<D>& s, const Kernel& kernel, double dynamic)
        : Motions<D>(s), kernel(kernel), dynamic(dynamic), volume(s.volume.data()), mass(s.mass.data()) {
        for (int d = 0; d < D; ++d) acceleration[d] = s.acceleration[d].data();
    }

    struct Sum {
        double laplacian[D][W];
    };

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], dv[D], laplacian[D], r2 = 1e-200;
        for (int d = 0; d < D; ++d) {
            dx[d] = x[d][j] - i.x[d];
            dv[d] = v[d][j] - i.v[d];
            r2 += dx[d] * dx[d];
        }
        const double w = kernel.slope(std::sqrt(r2) * kernel.inverse_radius()) * volume[j] * seen;
        viscous_pair<D, form>(dx, dv, r2, w, laplacian);
        for (int d = 0; d < D; ++d) sum.laplacian[d][l] += laplacian[d];
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        const double kinematic = dynamic * volume[i] / mass[i];
        for (int d = 0; d < D; ++d) acceleration[d][i] += kinematic * add_lanes(sum.laplacian[d]);
    }
};

}  // namespace

template <int D>
void add_viscosity(Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel, const Viscosity& viscosity,
                   LaneRange lanes) {
    kernel.visit([&](const auto& k) {
        using K = std::remove_cvref_t<decltype(k)>;
        if (viscosity.form == ViscousOperator::morris)
            pair_loop<D>(lists, lanes, ViscosityPass<D, K, ViscousOperator::morris>(s, k, viscosity.dynamic));
        else
            pair_loop<D>(lists, lanes, ViscosityPass<D, K, ViscousOperator::monaghan_gingold>(s, k, viscosity.dynamic));
    });
}

template void add_viscosity(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const Viscosity&, LaneRange);
template void add_viscosity(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const Viscosity&, LaneRange);

}  // namespace aquagraph::fluid
