#include "physics/fluid/free_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/fluid/pair_loop.hpp"
#include "physics/fluid/time_integration.hpp"

namespace aquagraph::fluid {

namespace {

// Σ ∇W ω and Σ (λ_j - λ_i) ∇W ω. The renormalisation of the second would turn the normal by little where it is used.
template <int D, class Kernel>
struct NormalPass {
    Kernel kernel;
    const double* x[D];
    const double* volume;
    const double* fullness;
    double* normal[D];
    double* crowding[D];

    NormalPass(const Particles<D>& s, FreeSurface<D>& surface, const Kernel& kernel)
        : kernel(kernel), volume(s.volume.data()), fullness(s.fullness.data()) {
        for (int d = 0; d < D; ++d) {
            x[d] = s.x[d].data();
            normal[d] = surface.normal[d].data();
            crowding[d] = surface.crowding[d].data();
        }
    }

    struct Own {
        double x[D], fullness;
    };
    struct Sum {
        double crowding[D][W], gradient[D][W];
    };

    Own load(std::size_t i) const {
        Own own;
        own.fullness = fullness[i];
        for (int d = 0; d < D; ++d) own.x[d] = x[d][i];
        return own;
    }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], r2 = 0;
        for (int d = 0; d < D; ++d) {
            dx[d] = x[d][j] - i.x[d];
            r2 += dx[d] * dx[d];
        }
        const double w = kernel.slope(std::sqrt(r2) * kernel.inverse_radius()) * volume[j] * seen;
        const double difference = (fullness[j] - i.fullness) * w;
        for (int d = 0; d < D; ++d) {
            sum.crowding[d][l] += w * dx[d];
            sum.gradient[d][l] += difference * dx[d];
        }
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        double n[D], square = 0;
        for (int d = 0; d < D; ++d) {
            crowding[d][i] = add_lanes(sum.crowding[d]);
            n[d] = -add_lanes(sum.gradient[d]);
            square += n[d] * n[d];
        }
        const double scale = square > 0 ? 1 / std::sqrt(square) : 0;
        for (int d = 0; d < D; ++d) normal[d][i] = scale * n[d];
    }
};

// Whether nobody stands in the umbrella of particle i.
template <int D>
bool open_ahead(const Particles<D>& s, const NeighbourLists<D>& lists, const FreeSurface<D>& surface, double h,
                std::size_t i, LaneRange lanes) {
    const std::size_t block_begin = lanes.begin / (clusters_per_block * W) * (clusters_per_block * W);
    const NeighbourBlock& list = lists.blocks[block_begin / (clusters_per_block * W)];
    const auto from = list.particle[i - block_begin], to = list.particle[i - block_begin + 1];
    const auto stands_ahead = [&](std::size_t j) {
        double r2 = 0, ahead = 0, from_T2 = 0;
        for (std::size_t d = 0; d < D; ++d) {
            const double dx = s.x[d][j] - s.x[d][i], n = surface.normal[d][i];
            r2 += dx * dx;
            ahead += n * dx;
            from_T2 += (dx - h * n) * (dx - h * n);
        }
        if (s.volume[j] == 0 || r2 == 0) return false;
        if (r2 >= 2 * h * h) return from_T2 < h * h;
        return ahead > std::sqrt(0.5 * r2);
    };
    for (auto k = from.open_end; k < to.open_end; ++k)
        for (std::size_t l = 0; l < W; ++l)
            if (stands_ahead(std::size_t(list.open[k]) * W + l)) return false;
    for (auto k = from.masked_end; k < to.masked_end; ++k)
        for (std::size_t l = 0; l < W; ++l)
            if (((list.mask[k] >> l) & 1u) && stands_ahead(std::size_t(list.masked[k]) * W + l)) return false;
    return true;
}

}  // namespace

template <int D>
void FreeSurface<D>::resize(const Particles<D>& particles) {
    const auto fit = [](Scalars& values, std::size_t n) {
        if (n > values.capacity()) values.reserve(n + n / 4 + 16 * W);
        values.resize(n);
    };
    for (int d = 0; d < D; ++d) {
        fit(normal[d], particles.clusters() * W);
        fit(crowding[d], particles.clusters() * W);
    }
    fit(at_surface, particles.size());
    std::fill(at_surface.begin(), at_surface.end(), 0.0);
}

template <int D>
void detect_free_surface(const Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                         FreeSurface<D>& surface, LaneRange lanes) {
    kernel.visit([&](const auto& k) {
        pair_loop<D>(lists, lanes, NormalPass<D, std::remove_cvref_t<decltype(k)>>(s, surface, k));
    });
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        bool at_surface = s.fullness[i] < fullness_of_splash;
        if (!at_surface && s.fullness[i] < fullness_of_interior)
            at_surface = open_ahead(s, lists, surface, 0.5 * kernel.radius(), i, lanes);
        surface.at_surface[i] = at_surface ? 1 : 0;
    }
}

template struct FreeSurface<2>;
template struct FreeSurface<3>;
template void detect_free_surface(const Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, FreeSurface<2>&,
                                  LaneRange);
template void detect_free_surface(const Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, FreeSurface<3>&,
                                  LaneRange);

}  // namespace aquagraph::fluid
