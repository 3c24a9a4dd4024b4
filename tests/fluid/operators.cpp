// Renormalised gradients: exact on linear fields wherever they are used, and the fullness that decides where.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "physics/fluid/gradients.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

template <int D>
void gradients_everywhere(Particles<D>& s, double radius) {
    const auto lists = lists_of<D>(s, radius, 0.2 * radius);
    for (std::size_t block = 0; block < s.blocks(); ++block)
        compute_gradients<D>(s, lists, WendlandC2<D>(radius), lanes_of_block(s, block));
}

// A free patch, all of whose outer particles belong to the surface, and some spray beside it.
template <int D>
void check_linear_fields(const std::array<int, D>& cells) {
    CAPTURE(D);
    const double spacing = 0.05, radius = 4 * spacing;
    Random random;
    auto points = lattice<D>(cells, spacing, 0.2, random);
    for (int k = 0; k < 20; ++k) {  // spray
        Point<D> x;
        x.fill(0.0);
        x[0] = cells[0] * spacing + (1 + 0.8 * k) * spacing;
        x[D - 1] = 0.5 * spacing * random();
        points.push_back(x);
    }
    Particles<D> s = place<D>(points, spacing);
    double G[D], V[D][D];
    for (std::size_t a = 0; a < D; ++a) {
        G[a] = 3000 * random();
        for (std::size_t b = 0; b < D; ++b) V[a][b] = 5 * random();
    }
    for (std::size_t i = 0; i < s.count; ++i) {
        s.volume[i] *= 1 + 0.2 * random();
        s.p[i] = 1000;
        for (std::size_t a = 0; a < D; ++a) {
            s.p[i] += G[a] * s.x[a][i];
            s.v[a][i] = 1;
            for (std::size_t b = 0; b < D; ++b) s.v[a][i] += V[a][b] * s.x[b][i];
            s.grad_p[a][i] = s.grad_v[a][0][i] = 1e30;  // must be overwritten
        }
    }
    gradients_everywhere(s, radius);

    std::size_t reconstructed = 0, near_surface = 0, bare = 0;
    double largest_error = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (s.fullness[i] > fullness_to_reconstruct) {
            ++reconstructed;
            near_surface += s.fullness[i] < 0.6;
            for (std::size_t a = 0; a < D; ++a) {
                largest_error = std::max(largest_error, std::fabs(s.grad_p[a][i] - G[a]) / 3000);
                for (std::size_t b = 0; b < D; ++b)
                    largest_error = std::max(largest_error, std::fabs(s.grad_v[a][b][i] - V[a][b]) / 5);
            }
        } else {
            ++bare;
            for (std::size_t a = 0; a < D; ++a) {
                CHECK(s.grad_p[a][i] == 0);
                for (std::size_t b = 0; b < D; ++b) CHECK(s.grad_v[a][b][i] == 0);
            }
        }
    }
    CAPTURE(largest_error);
    CHECK(largest_error < 1e-12);
    CHECK(reconstructed > s.count / 2);
    CHECK(near_surface > 50);
    CHECK(bare > 5);
}

template <int D>
void check_fullness(int along) {
    CAPTURE(D);
    const double spacing = 0.05;
    Random random;
    std::array<int, D> cells;
    cells.fill(along);
    const auto points = lattice<D>(cells, spacing, 0, random);
    Particles<D> s = place<D>(points, spacing);
    gradients_everywhere(s, 4 * spacing);
    const auto at = [&](Point<D> x) {
        std::size_t nearest = 0;
        double best = 1e9;
        for (std::size_t i = 0; i < s.count; ++i) {
            double r2 = 0;
            for (std::size_t d = 0; d < D; ++d) r2 += (points[i][d] - x[d]) * (points[i][d] - x[d]);
            if (r2 < best) {
                best = r2;
                nearest = i;
            }
        }
        return s.fullness[nearest];
    };
    const double middle = 0.5 * along * spacing;
    Point<D> x;
    x.fill(middle);
    const double inside = at(x);
    x[0] = 0;
    const double face = at(x);
    x.fill(0);
    const double corner = at(x);
    CAPTURE(inside);
    CAPTURE(face);
    CAPTURE(corner);
    CHECK(inside == doctest::Approx(1).epsilon(0.01));
    CHECK(face < 0.75);
    CHECK(face > 0.4);
    CHECK(corner < face);
    CHECK(corner > 0);
}

}  // namespace

TEST_CASE("gradients are exact on linear fields, at free surfaces too, and zero where there is too little around") {
    check_linear_fields<2>({24, 21});
    check_linear_fields<3>({11, 10, 9});
}

TEST_CASE("fullness is one inside and less at a surface") {
    check_fullness<2>(17);
    check_fullness<3>(11);
}

TEST_CASE("a particle alone and a straight row of particles have no fullness and no gradient") {
    for (const int n : {1, 30}) {
        std::vector<Point<2>> row;
        for (int k = 0; k < n; ++k) row.push_back({0.1 * k, 0.2});
        Particles<2> s = place<2>(row, 0.1);
        for (std::size_t i = 0; i < s.count; ++i) s.p[i] = 100.0 * static_cast<double>(i);
        gradients_everywhere(s, 0.4);
        for (std::size_t i = 0; i < s.count; ++i) {
            CHECK(std::fabs(s.fullness[i]) < 1e-14);
            CHECK(s.grad_p[0][i] == 0);
            CHECK(s.grad_p[1][i] == 0);
        }
    }
}

namespace {

// A symmetric matrix made from its eigenvalues, the smallest of them `low`, and its inverse made from theirs.
template <int D>
struct Moment {
    Eigen::Matrix<double, D, D> matrix = Eigen::Matrix<double, D, D>::Zero(), inverse = matrix;

    Moment(double low, Random& random) {
        for (int a = 0; a < D; ++a) {
            matrix(a, a) = a == 0 ? low : low + (1.5 - low) * 0.5 * (1 + random());
            inverse(a, a) = 1 / matrix(a, a);
        }
        for (int a = 0; a < D; ++a)
            for (int b = a + 1; b < D; ++b) {  // turned in the plane of each pair of axes
                Eigen::Matrix<double, D, D> turn = Eigen::Matrix<double, D, D>::Identity();
                const double angle = M_PI * random();
                turn(a, a) = turn(b, b) = std::cos(angle);
                turn(a, b) = std::sin(angle);
                turn(b, a) = -std::sin(angle);
                matrix = (turn * matrix * turn.transpose()).eval();
                inverse = (turn * inverse * turn.transpose()).eval();
            }
    }
};

template <int D>
void check_inverse() {
    CAPTURE(D);
    Random random;
    constexpr int entries = D * (D + 1) / 2;
    double largest_error = 0;
    for (const double low : {0.21, 0.5, 0.9, 1.4999999, 0.1, 0.001, -0.05}) {
        for (int k = 0; k < 200; ++k) {
            const Moment<D> made(low, random);
            double m[entries], before[entries];
            for (int r = 0, n = 0; r < D; ++r)
                for (int c = r; c < D; ++c, ++n) m[n] = before[n] = made.matrix(r, c);
            const double smallest = invert_moment<D>(m, 0.2);
            largest_error = std::max(largest_error, std::fabs(smallest - low));
            if (low < 0.2) {
                CHECK(std::equal(m, m + entries, before));
                continue;
            }
            const Eigen::Matrix<double, D, D> by_eigen = made.matrix.inverse();
            for (int r = 0, n = 0; r < D; ++r)
                for (int c = r; c < D; ++c, ++n) {
                    CHECK(std::fabs(m[n] - made.inverse(r, c)) < 2e-14 * made.inverse.norm());
                    CHECK(std::fabs(m[n] - by_eigen(r, c)) < 2e-14 * made.inverse.norm());
                }
        }
    }
    CAPTURE(largest_error);
    CHECK(largest_error < (D == 2 ? 1e-15 : 1e-13));  // 3 × 3: by trigonometry
}

}  // namespace

TEST_CASE("moments are inverted, their smallest eigenvalue is found, and they are left alone below the threshold") {
    check_inverse<2>();
    check_inverse<3>();
}
