#include "physics/fluid/gradients.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "physics/fluid/pair_loop.hpp"

namespace aquagraph::fluid {

template <>
double invert_moment<2>(double (&m)[3], double threshold) {
    const double xx = m[0], xy = m[1], yy = m[2];
    const double mean = 0.5 * (xx + yy);
    const double smallest = mean - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    if (smallest > threshold) {
        const double inverse = 1 / (xx * yy - xy * xy);
        m[0] = yy * inverse;
        m[1] = -xy * inverse;
        m[2] = xx * inverse;
    }
    return smallest;
}

template <>
double invert_moment<3>(double (&m)[6], double threshold) {
    Eigen::Matrix3d a;
    a << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
    const double smallest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().computeDirect(a, Eigen::EigenvaluesOnly).eigenvalues()[0];
    if (smallest > threshold) {
        const Eigen::Matrix3d b = a.inverse();
        m[0] = b(0, 0);
        m[1] = b(0, 1);
        m[2] = b(0, 2);
        m[3] = b(1, 1);
        m[4] = b(1, 2);
        m[5] = b(2, 2);
    }
    return smallest;
}

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

template <int D>
struct GradientPass {
    static constexpr int moments = D * (D + 1) / 2;
    const double* x[D];
    const double* v[D];
    const double* p;
    const double* volume;
    double* grad_p[D];
    double* grad_v[D][D];
    double* fullness;
    double inverse_radius, slope_factor;

    struct Own {
        double x[D], v[D], p;
    };
    struct Sum {
        double moment[moments][W], p[D][W], v[D][D][W];
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
        const double u = std::max(0.0, 1 - std::sqrt(r2) * inverse_radius);
        const double w = slope_factor * u * u * u * volume[j] * seen;  // ∇W_ij ω_j = w (x_j - x_i)
        const double dp = (p[j] - i.p) * w;
        // Flat loops with constant trip counts: GCC does not unroll a triangular nest early enough to vectorise the
        // lanes.
        for (int k = 0; k < moments; ++k) sum.moment[k][l] += w * dx[row<D>[k]] * dx[column<D>[k]];
        for (int a = 0; a < D; ++a) sum.p[a][l] += dp * dx[a];
        for (int e = 0; e < D; ++e) {
            const double dv = (v[e][j] - i.v[e]) * w;
            for (int a = 0; a < D; ++a) sum.v[e][a][l] += dv * dx[a];
        }
    }

    void store(std::size_t i, const Own&, const Sum& sum) const {
        double b[moments];
        for (int k = 0; k < moments; ++k) b[k] = add_lanes(sum.moment[k]);
        const double smallest = invert_moment<D>(b, fullness_to_reconstruct);
        fullness[i] = smallest;
        const bool full = smallest > fullness_to_reconstruct;
        double B[D][D];
        for (int a = 0, k = 0; a < D; ++a)
            for (int c = a; c < D; ++c, ++k) B[a][c] = B[c][a] = full ? b[k] : 0.0;
        const auto apply = [&](const double(&raw)[D][W], auto&& out) {
            double g[D];
            for (int a = 0; a < D; ++a) g[a] = add_lanes(raw[a]);
            for (int a = 0; a < D; ++a) {
                double value = 0;
                for (int c = 0; c < D; ++c) value += B[a][c] * g[c];
                out(a) = value;
            }
        };
        apply(sum.p, [&](int a) -> double& { return grad_p[a][i]; });
        for (int e = 0; e < D; ++e) apply(sum.v[e], [&](int a) -> double& { return grad_v[e][a][i]; });
    }
};

}  // namespace

template <int D>
void compute_gradients(Particles<D>& s, const NeighbourLists<D>& lists, const WendlandC2<D>& kernel, LaneRange lanes) {
    GradientPass<D> pass;
    pass.p = s.p.data();
    pass.volume = s.volume.data();
    pass.fullness = s.fullness.data();
    for (int d = 0; d < D; ++d) {
        pass.x[d] = s.x[d].data();
        pass.v[d] = s.v[d].data();
        pass.grad_p[d] = s.grad_p[d].data();
        for (int e = 0; e < D; ++e) pass.grad_v[d][e] = s.grad_v[d][e].data();
    }
    pass.inverse_radius = 1 / kernel.radius();
    pass.slope_factor = kernel.slope_factor();
    pair_loop<D>(lists, lanes, pass);
}

template void compute_gradients(Particles<2>&, const NeighbourLists<2>&, const WendlandC2<2>&, LaneRange);
template void compute_gradients(Particles<3>&, const NeighbourLists<3>&, const WendlandC2<3>&, LaneRange);

}  // namespace aquagraph::fluid
