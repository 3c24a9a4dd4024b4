// Smallest eigenvalues and inverses of symmetric matrices whose eigenvalues are known.
#include "physics/fluid/moment.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using aquagraph::fluid::test::Random;

namespace {

template <int D>
using Matrix = Eigen::Matrix<double, D, D>;

template <int D>
void check_inverse(const Matrix<D>& turn, const Eigen::Matrix<double, D, 1>& eigenvalues, double threshold) {
    Matrix<D> matrix = turn * eigenvalues.asDiagonal() * turn.transpose();
    matrix = Matrix<D>(0.5 * (matrix + matrix.transpose()));
    CAPTURE(matrix);
    double m[D * (D + 1) / 2];
    for (int a = 0, k = 0; a < D; ++a)
        for (int c = a; c < D; ++c, ++k) m[k] = matrix(a, c);
    Eigen::Matrix<double, D, 1> sorted = eigenvalues;
    std::sort(sorted.data(), sorted.data() + D);
    const double expected = sorted[0], smallest = invert_moment<D>(m, threshold), size = matrix.norm();
    double error = 1e-14 * size + 1e-100;
    if (D == 3 && sorted[2] > sorted[0]) {  // what the header says
        const double spread = sorted[2] - sorted[0], gap = sorted[1] - sorted[0], rounding = 2e-16 * size / spread;
        error += spread * std::min(2 * std::sqrt(rounding), 4 * rounding * spread / (gap + 1e-300));
    }
    CHECK(std::fabs(smallest - expected) <= error);
    if (std::fabs(expected - threshold) < 1e-7) return;
    const Matrix<D> left = expected > threshold ? Matrix<D>(matrix.inverse()) : matrix;
    for (int a = 0, k = 0; a < D; ++a)
        for (int c = a; c < D; ++c, ++k)
            CHECK(std::fabs(m[k] - left(a, c)) <= 1e-13 * left.norm() * (size / std::max(expected, threshold)));
}

template <int D>
void check_inverses() {
    Random random;
    for (int k = 0; k < 2000; ++k) {
        Matrix<D> turn;
        if constexpr (D == 2)
            turn = Eigen::Rotation2Dd(4 * random()).toRotationMatrix();
        else
            turn = Eigen::Quaterniond(random(), random(), random(), random()).normalized().toRotationMatrix();
        Eigen::Matrix<double, D, 1> eigenvalues;
        for (double& value : eigenvalues) value = random();
        // Two or all of them the same, or nearly, as inside of water.
        const double apart[] = {1, 0, 1e-3, 1e-9, 1e-15};
        for (int a = 1; a < D; ++a)
            if (k % 3 == a || k % 3 == 0) eigenvalues[a] = eigenvalues[0] + apart[k / 3 % 5] * eigenvalues[a];
        check_inverse<D>(turn, eigenvalues, 0.2);
    }
    const auto turn = Matrix<D>::Identity();
    for (const double value : {0.0, 1e-120, 1.0}) {
        Eigen::Matrix<double, D, 1> eigenvalues = value * Eigen::Matrix<double, D, 1>::Ones();
        check_inverse<D>(turn, eigenvalues, 0.2);
        eigenvalues[0] *= 0.5;
        check_inverse<D>(turn, eigenvalues, 0.2);
    }
}

}  // namespace

TEST_CASE("the smallest eigenvalue of a moment, and its inverse where that is large enough") {
    check_inverses<2>();
    check_inverses<3>();
}
