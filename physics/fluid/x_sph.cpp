#include "physics/fluid/x_sph.hpp"

#include <cmath>

#include "physics/fluid/motions.hpp"
#include "physics/fluid/pair_loop.hpp"

namespace aquagraph::fluid {

namespace {

template <int D, class Kernel>
struct XSphPass : Motions<D> {
    using typename Motions<D>::Own;
    using Motions<D>::x, Motions<D>::v;
    Kernel kernel;
    double epsilon;
    const double* volume;
    double* shift[D];

    XSphPass(Particles<D>& s, const Kernel& kernel, double epsilon)
        : Motions<D>(s), kernel(kernel), epsilon(epsilon), volume(s.volume.data()) {
        for (int d = 0; d < D; ++d) shift[d] = s.shift[d].data();
    }

    struct Sum {
        double difference[D][W];
    };

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double r2 = 0;
        for (int d = 0; d < D; ++d) {
            const double dx = x[d][j] - i.x[d];
            r2 += dx * dx;
        }
        const double weight = kernel.value(std::sqrt(r2)) * volume[j] * seen;
        for (int d = 0; d < D; ++d) sum.difference[d][l] += weight * (v[d][j] - i.v[d]);
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        for (int d = 0; d < D; ++d) shift[d][i] = epsilon * add_lanes(sum.difference[d]);
    }
};

}  // namespace

template <int D>
void compute_x_sph(Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel, double epsilon,
                   LaneRange lanes) {
    kernel.visit([&](const auto& k) {
        pair_loop<D>(lists, lanes, XSphPass<D, std::remove_cvref_t<decltype(k)>>(s, k, epsilon));
    });
}

template void compute_x_sph(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, double, LaneRange);
template void compute_x_sph(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, double, LaneRange);

}  // namespace aquagraph::fluid
