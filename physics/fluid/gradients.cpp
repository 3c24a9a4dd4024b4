#include "physics/fluid/gradients.hpp"

#include <cmath>
#include <type_traits>

#include "physics/fluid/pair_loop.hpp"

namespace aquagraph::fluid {

namespace {

// Row and column of the k-th entry of a symmetric matrix's upper triangle.
template <int D>
constexpr int row[6] = {0, 0, 0, 1, 1, 2};
template <int D>
constexpr int column[6] = {0, 1, 2, 1, 2, 2};
template <>
constexpr int row<2>[6] = {0, 0, 1};
template <>
constexpr int column<2>[6] = {0, 1, 1};

template <int D, class Kernel, bool pressure, bool velocity>
struct GradientPass {
    static constexpr int moments = D * (D + 1) / 2;
    // Rows of the sums: the moment, ∇p, ∇v.
    static constexpr int row_of_p = moments, row_of_v = row_of_p + (pressure ? D : 0),
                         rows = row_of_v + (velocity ? D * D : 0);
    // Sums of the particles of a cluster, side by side: so the inversions of its moments share their vectors.
    struct ClusterSums {
        double total[rows][W];
    };

    Kernel kernel;
    ClusterSums& cluster;
    std::size_t end;
    const double* x[D];
    const double* v[D];
    const double* p;
    const double* volume;
    double* grad_p[D];
    double* grad_v[D][D];
    double* fullness;

    GradientPass(Particles<D>& s, const Kernel& kernel, ClusterSums& cluster, std::size_t end)
        : kernel(kernel),
          cluster(cluster),
          end(end),
          p(s.p.data()),
          volume(s.volume.data()),
          fullness(s.fullness.data()) {
        for (int d = 0; d < D; ++d) {
            x[d] = s.x[d].data();
            v[d] = s.v[d].data();
            grad_p[d] = s.grad_p[d].data();
            for (int e = 0; e < D; ++e) grad_v[d][e] = s.grad_v[d][e].data();
        }
    }

    struct Own {
        double x[D], v[D], p;
    };
    struct Sum {
        double lane[rows][W];
    };

    Own load(std::size_t i) const {
        Own own;
        own.p = p[i];
        for (int d = 0; d < D; ++d) {
            own.x[d] = x[d][i];
            own.v[d] = v[d][i];
        }
        return own;
    }

    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], r2 = 0;
        for (int d = 0; d < D; ++d) {
            dx[d] = x[d][j] - i.x[d];
            r2 += dx[d] * dx[d];
        }
        // ∇W_ij ω_j = w (x_j - x_i)
        const double w = kernel.slope(std::sqrt(r2) * kernel.inverse_radius()) * volume[j] * seen;
        double gradient[D];
        for (int a = 0; a < D; ++a) gradient[a] = w * dx[a];
        // Flat loops with constant trip counts: GCC does not unroll a triangular nest early enough to vectorise the
        // lanes.
        for (int k = 0; k < moments; ++k) sum.lane[k][l] += gradient[row<D>[k]] * dx[column<D>[k]];
        if constexpr (pressure) {
            const double dp = p[j] - i.p;
            for (int a = 0; a < D; ++a) sum.lane[row_of_p + a][l] += dp * gradient[a];
        }
        if constexpr (velocity) {
            for (int e = 0; e < D; ++e) {
                const double dv = v[e][j] - i.v[e];
                for (int a = 0; a < D; ++a) sum.lane[row_of_v + e * D + a][l] += dv * gradient[a];
            }
        }
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        double total[rows];
        add_lanes(sum.lane, total);
        const std::size_t l = i % W;
        for (int k = 0; k < rows; ++k) cluster.total[k][l] = total[k];
        if (l < W - 1 && i + 1 < end) return;
        for (std::size_t unused = l + 1; unused < W; ++unused)
            for (int k = 0; k < rows; ++k) cluster.total[k][unused] = 0;
        finish(i - l);
    }

    // Inverts the moments of the cluster that begins here, and applies them.
    [[gnu::noinline]] void finish(std::size_t first) const {
        const auto& total = cluster.total;
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            double b[moments];
            for (int k = 0; k < moments; ++k) b[k] = total[k][l];
            const double smallest = invert_moment<D>(b, fullness_to_reconstruct);
            fullness[first + l] = smallest;
            const bool full = smallest > fullness_to_reconstruct;
            double B[D * D];
            for (int k = 0; k < moments; ++k)
                B[row<D>[k] * D + column<D>[k]] = B[column<D>[k] * D + row<D>[k]] = full ? b[k] : 0.0;
            if constexpr (pressure)
                for (int a = 0; a < D; ++a) {
                    double value = 0;
                    for (int c = 0; c < D; ++c) value += B[a * D + c] * total[row_of_p + c][l];
                    grad_p[a][first + l] = value;
                }
            if constexpr (velocity)
                for (int k = 0; k < D * D; ++k) {
                    const int e = k / D, a = k % D;
                    double value = 0;
                    for (int c = 0; c < D; ++c) value += B[a * D + c] * total[row_of_v + e * D + c][l];
                    grad_v[e][a][first + l] = value;
                }
        }
    }
};

}  // namespace

template <int D>
void compute_gradients(Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel, LaneRange lanes,
                       GradientsOf fields) {
    kernel.visit([&](const auto& k) {
        using K = std::remove_cvref_t<decltype(k)>;
        const auto run = [&]<class Pass>(std::type_identity<Pass>) {
            typename Pass::ClusterSums sums;
            pair_loop<D>(lists, lanes, Pass(s, k, sums, lanes.end));
        };
        if (fields.velocity)
            run(std::type_identity<GradientPass<D, K, true, true>>());
        else if (fields.pressure)
            run(std::type_identity<GradientPass<D, K, true, false>>());
        else
            run(std::type_identity<GradientPass<D, K, false, false>>());
    });
}

template void compute_gradients(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&, LaneRange, GradientsOf);
template void compute_gradients(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&, LaneRange, GradientsOf);

}  // namespace aquagraph::fluid
