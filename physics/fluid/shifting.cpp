#include "physics/fluid/shifting.hpp"

#include <algorithm>
#include <cmath>

#include "physics/fluid/pair_loop.hpp"

namespace aquagraph::fluid {

namespace {

// How many particles of the surface stand within R.
template <int D>
struct NearSurfacePass {
    double radius2;
    const double* x[D];
    const double* at_surface;
    double* near;  // of the block's lanes
    std::size_t first;

    struct Own {
        double x[D];
    };
    struct Sum {
        double count[W];
    };

    Own load(std::size_t i) const {
        Own own;
        for (int d = 0; d < D; ++d) own.x[d] = x[d][i];
        return own;
    }
    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double r2 = 0;
        for (int d = 0; d < D; ++d) {
            const double dx = x[d][j] - i.x[d];
            r2 += dx * dx;
        }
        sum.count[l] += r2 < radius2 ? at_surface[j] * seen : 0.0;
    }
    void store(std::size_t i, const Own&, const Sum& sum) const { near[i - first] = add_lanes(sum.count); }
};

}  // namespace

template <int D>
void compute_shift(Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                   const FreeSurface<D>& surface, LaneRange lanes) {
    const double radius = kernel.radius();
    double near[clusters_per_block * W];
    NearSurfacePass<D> pass{radius * radius, {}, surface.at_surface.data(), near, lanes.begin};
    for (int d = 0; d < D; ++d) pass.x[d] = s.x[d].data();
    pair_loop<D>(lists, lanes, pass);

    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        double speed2 = 0, k2 = 0, k[D], n[D];
        for (std::size_t d = 0; d < D; ++d) {
            k[d] = surface.crowding[d][i];
            n[d] = surface.normal[d][i];
            speed2 += s.v[d][i] * s.v[d][i];
        }
        // Along the surface only, where there is one near.
        if (near[i - lanes.begin] > 0 || surface.at_surface[i] > 0) {
            double outward = 0;
            for (std::size_t d = 0; d < D; ++d) outward += k[d] * n[d];
            for (std::size_t d = 0; d < D; ++d) k[d] -= outward * n[d];
        }
        for (std::size_t d = 0; d < D; ++d) k2 += k[d] * k[d];
        const double crowding = radius * std::sqrt(k2);
        const double scale = crowding > 0.25 ? 0.25 / crowding : 1.0;
        const bool splash = s.fullness[i] < fullness_of_splash;
        for (std::size_t d = 0; d < D; ++d) s.shift[d][i] = splash ? 0.0 : -std::sqrt(speed2) * radius * scale * k[d];
    }
}

template void compute_shift(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, const FreeSurface<2>&,
                            LaneRange);
template void compute_shift(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, const FreeSurface<3>&,
                            LaneRange);

}  // namespace aquagraph::fluid
