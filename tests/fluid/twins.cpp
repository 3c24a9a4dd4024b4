// Brute-force twins of the two pair passes: a plain double loop over all pairs, written from the formulas of
// method.md with their divisions by r, e_ij and W' left in, and riemann.hpp's solver called by name.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/gradients.hpp"
#include "physics/fluid/riemann.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

template <int D>
Vector<D> at(const Vectors<D>& field, std::size_t i) {
    Vector<D> value;
    for (int d = 0; d < D; ++d) value[d] = field[static_cast<std::size_t>(d)][i];
    return value;
}
template <int D>
Matrix<D> at(const Tensors<D>& field, std::size_t i) {
    Matrix<D> value;
    for (int a = 0; a < D; ++a)
        for (int b = 0; b < D; ++b) value(a, b) = field[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)][i];
    return value;
}

// ½ of (2.58): the limiter by cases.
double limited(double a, double b) {
    if (a > 0 && b > 0) return std::min(a, b);
    if (a < 0 && b < 0) return std::max(a, b);
    return 0;
}

// A disordered cloud with ghosts around, denser and emptier places, and particles with no neighbour at all.
template <int D>
Particles<D> cloud(double spacing, Random& random) {
    std::array<int, D> cells;
    cells.fill(D == 2 ? 25 : 9);
    auto points = lattice<D>(cells, spacing, 0.35, random);
    Point<D> away;
    away.fill(100 * spacing);
    points.push_back(away);
    std::vector<Point<D>> ghosts;
    for (int k = 0; k < 60; ++k) {
        Point<D> x;
        for (double& component : x) component = 0.5 * cells[0] * spacing * (1 + 1.2 * random());
        ghosts.push_back(x);
    }
    Particles<D> s = place<D>(points, spacing, ghosts);
    disorder(s, spacing, random);
    return s;
}

template <int D>
void check_gradients() {
    CAPTURE(D);
    const double spacing = 0.05, radius = 3.3 * spacing;
    Random random;
    const WendlandC2<D> kernel(radius);
    Particles<D> s = cloud<D>(spacing, random);
    const auto lists = lists_of<D>(s, radius, 0.25 * radius);
    for (std::size_t block = 0; block < s.blocks(); ++block)
        compute_gradients<D>(s, lists, kernel, lanes_of_block(s, block));

    double error_fullness = 0, error_p = 0, error_v = 0;
    std::size_t full = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        Matrix<D> inverse_B = Matrix<D>::Zero();
        Vector<D> sum_p = Vector<D>::Zero();
        Matrix<D> sum_v = Matrix<D>::Zero();
        double magnitude_p = 0, magnitude_v = 0;
        each_lane(s, [&](std::size_t j) {
            const double r = distance(s, i, j);
            if (j == i || r >= radius) return;
            const Vector<D> e_ij = (at<D>(s.x, j) - at<D>(s.x, i)) / r;
            const Vector<D> grad_W = -kernel.derivative(r) * e_ij;
            const double w = s.volume[j];
            inverse_B += r * e_ij * grad_W.transpose() * w;
            const double dp = s.p[j] - s.p[i];
            const Vector<D> dv = at<D>(s.v, j) - at<D>(s.v, i);
            sum_p += dp * grad_W * w;
            sum_v += dv * grad_W.transpose() * w;
            magnitude_p += std::fabs(dp) * grad_W.norm() * w;
            magnitude_v += dv.norm() * grad_W.norm() * w;
        });
        double smallest;
        if constexpr (D == 2) {  // of a symmetric 2 × 2 matrix: half trace minus root of its square less determinant
            const double half = 0.5 * inverse_B.trace();
            smallest = half - std::sqrt(std::max(0.0, half * half - inverse_B.determinant()));
            error_fullness = std::max(error_fullness, std::fabs(smallest - s.fullness[i]));
        } else {  // an eigenvalue makes A - λ singular, and none is smaller: A - (λ - ε) is positive
            smallest = s.fullness[i];
            const Matrix<D> shifted = inverse_B - (smallest - 1e-9) * Matrix<D>::Identity();
            error_fullness =
                std::max(error_fullness, std::fabs((inverse_B - smallest * Matrix<D>::Identity()).determinant()));
            CHECK(shifted(0, 0) > 0);
            CHECK(shifted(0, 0) * shifted(1, 1) > shifted(0, 1) * shifted(0, 1));
        }
        Matrix<D> B = Matrix<D>::Zero();
        if (smallest > fullness_to_reconstruct) {
            B = inverse_B.inverse();
            ++full;
        }
        const Vector<D> grad_p = B * sum_p;
        const Matrix<D> grad_v = sum_v * B.transpose();
        if (B.norm() == 0) {
            CHECK(at<D>(s.grad_p, i).norm() == 0);
            CHECK(at<D>(s.grad_v, i).norm() == 0);
        } else {
            error_p = std::max(error_p, (grad_p - at<D>(s.grad_p, i)).norm() / (B.norm() * magnitude_p));
            error_v = std::max(error_v, (grad_v - at<D>(s.grad_v, i)).norm() / (B.norm() * magnitude_v));
        }
    }
    CAPTURE(error_fullness);
    CAPTURE(error_p);
    CAPTURE(error_v);
    CHECK(full > s.count / 2);
    CHECK(full < s.count);
    CHECK(error_fullness < 1e-13);
    CHECK(error_p < 1e-13);
    CHECK(error_v < 1e-13);
}

template <int D>
void check_fluxes(bool muscl) {
    CAPTURE(D);
    CAPTURE(muscl);
    const double spacing = 0.05, radius = 3.3 * spacing, rho_0 = water.reference_density;
    Random random(7);
    const WendlandC2<D> kernel(radius);
    Particles<D> s = cloud<D>(spacing, random);
    const auto lists = lists_of<D>(s, radius, 0.25 * radius);
    FluxParameters parameters{.muscl = muscl, .gravity = {0.3, -9.81, 2}};
    for (std::size_t block = 0; block < s.blocks(); ++block)
        compute_fluxes<D>(s, lists, kernel, parameters, water, lanes_of_block(s, block));

    double error_force = 0, error_dilation = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        Vector<D> force = Vector<D>::Zero();
        double dilation = 0, magnitude_force = 0, magnitude_dilation = 0;
        const double rho_i = rho_0 + s.deviation[i];
        const Vector<D> v_i = at<D>(s.v, i);
        each_lane(s, [&](std::size_t j) {
            const double r = distance(s, i, j);
            if (j == i || r >= radius) return;
            const Vector<D> x_ij = at<D>(s.x, j) - at<D>(s.x, i), e_ij = x_ij / r;
            const Vector<D> grad_W = -kernel.derivative(r) * e_ij;
            Vector<D> v_L = v_i, v_R = at<D>(s.v, j);
            double p_L = s.p[i], p_R = s.p[j];
            if (muscl) {
                const double dp = s.p[j] - s.p[i];
                p_L += 0.5 * limited(at<D>(s.grad_p, i).dot(x_ij), dp);
                p_R -= 0.5 * limited(at<D>(s.grad_p, j).dot(x_ij), dp);
                const Matrix<D> grad_v_i = at<D>(s.grad_v, i), grad_v_j = at<D>(s.grad_v, j);
                for (int e = 0; e < D; ++e) {
                    const double dv = at<D>(s.v, j)[e] - v_i[e];
                    v_L[e] += 0.5 * limited(grad_v_i.row(e).dot(x_ij), dv);
                    v_R[e] -= 0.5 * limited(grad_v_j.row(e).dot(x_ij), dv);
                }
            }
            const InterfaceState state =
                acoustic_riemann(v_L.dot(e_ij), p_L, s.impedance[i], v_R.dot(e_ij), p_R, s.impedance[j]);
            const double along = grad_W.dot(e_ij), w = s.volume[j];
            force -= 2 * state.pressure * grad_W * w;
            dilation += 2 * (state.velocity - v_i.dot(e_ij)) * along * w;
            magnitude_force += 2 * std::fabs(state.pressure) * along * w;
            magnitude_dilation += 2 * (std::fabs(state.velocity) + v_i.norm()) * along * w;
        });
        const double inverse_density = s.volume[i] / s.mass[i];
        Vector<D> acceleration = inverse_density * force;
        for (int d = 0; d < D; ++d) acceleration[d] += parameters.gravity[d];
        const double deviation_rate = -rho_i * dilation;
        if (magnitude_force == 0) {
            CHECK(at<D>(s.acceleration, i) == acceleration);
            CHECK(s.deviation_rate[i] == 0);
            continue;
        }
        error_force = std::max(error_force,
                               (at<D>(s.acceleration, i) - acceleration).norm() / (inverse_density * magnitude_force));
        error_dilation =
            std::max(error_dilation, std::fabs(s.deviation_rate[i] - deviation_rate) / (rho_i * magnitude_dilation));
    }
    CAPTURE(error_force);
    CAPTURE(error_dilation);
    CHECK(error_force < 1e-13);
    CHECK(error_dilation < 1e-13);
}

}  // namespace

TEST_CASE("gradients are those of a double loop over the formulas") {
    check_gradients<2>();
    check_gradients<3>();
}

TEST_CASE("fluxes are those of a double loop over the formulas") {
    for (const bool muscl : {false, true}) {
        check_fluxes<2>(muscl);
        check_fluxes<3>(muscl);
    }
}
