// Inside or outside, and how far: closed forms, and the two ways of asking against each other.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "physics/geometry/facet_tree.hpp"
#include "physics/geometry/inside.hpp"
#include "physics/geometry/shapes.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::geometry;
using aquagraph::fluid::test::Random;

namespace {

template <int D>
Vec<D> somewhere(Random& random, double size) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = size * random();
    return x;
}

// Slowly and surely: the nearest of many places of every facet.
double distance_by_sampling(const Surface<3>& s, const Vec<3>& x) {
    double least = 1e9;
    constexpr int n = 40;
    for (std::size_t f = 0; f < s.facets.size(); ++f)
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j) {
                const Vec<3> at = (i * s.vertex(f, 0) + j * s.vertex(f, 1) + (n - i - j) * s.vertex(f, 2)) / n;
                least = std::min(least, (x - at).norm());
            }
    return least;
}

// A star with sharp and reentrant corners, extruded and turned.
Surface<3> star() {
    std::vector<Vec<2>> corners;
    for (int k = 0; k < 10; ++k) {
        const double r = k % 2 ? 0.3 : 1, angle = std::numbers::pi * k / 5;
        corners.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    std::reverse(corners.begin(), corners.end());
    auto made = extrude(corners, true, 2, -0.4, 0.5, true);
    transform(made, 1, Vec<3>(1, 1, 0.3), 0.8, Vec<3>(0.1, 0, -0.1));
    return made;
}

}  // namespace

TEST_CASE("the distance to a box, a circle and a sphere, and its sign") {
    Random random;
    const FacetTree<3> brick(box<3>(Vec<3>(-0.5, -0.3, -0.2), Vec<3>(0.5, 0.3, 0.2), FluidSide::outside));
    const FacetTree<2> square(box<2>(Vec<2>(-0.5, -0.3), Vec<2>(0.5, 0.3), FluidSide::outside));
    const FacetTree<3> ball(sphere(Vec<3>(0, 0, 0), 0.5, 1e-3, FluidSide::outside));
    for (int k = 0; k < 2000; ++k) {
        const Vec<3> x = somewhere<3>(random, 1);
        const auto of_box = [](const auto& from) {  // positive outside
            return from.cwiseMax(0.0).norm() + std::min(from.maxCoeff(), 0.0);
        };
        const Vec<3> from = x.cwiseAbs() - Vec<3>(0.5, 0.3, 0.2);
        CHECK(brick.nearest(x).signed_distance() == doctest::Approx(of_box(from)).epsilon(1e-12));
        const Vec<2> y = x.head<2>(), from2 = y.cwiseAbs() - Vec<2>(0.5, 0.3);
        CHECK(square.nearest(y).signed_distance() == doctest::Approx(of_box(from2)).epsilon(1e-12));
        CHECK(std::fabs(ball.nearest(x).signed_distance() - (x.norm() - 0.5)) < 1.01e-3);
    }
    CHECK(brick.nearest(Vec<3>(2, 0, 0), 1).facet == -1);
    CHECK(brick.nearest(Vec<3>(2, 0, 0), 2).distance == doctest::Approx(1.5));
}

TEST_CASE("parity along a column and the pseudo-normal agree on a star, and the tree on the distance") {
    Random random;
    const Surface<3> surface = star();
    const FacetTree<3> tree(surface);
    const InsideTest<3> inside(surface);
    int within = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec<3> x = somewhere<3>(random, 1.2);
        const auto nearest = tree.nearest(x);
        if (nearest.distance < 1e-9) continue;
        CHECK(inside(x) == (nearest.side() < 0));
        within += inside(x);
        if (k % 500 == 0) CHECK(nearest.distance == doctest::Approx(distance_by_sampling(surface, x)).epsilon(2e-2));
    }
    const double volume = within * std::pow(2.4, 3) / 20000, exact = enclosed_volume(surface);
    CHECK(volume == doctest::Approx(exact).epsilon(0.08));
}

TEST_CASE("columns that run exactly along edges, vertices and upright faces") {
    // All places of a lattice that the edges of the bodies lie on; the true answer is known wherever no surface is.
    const double h = 0.125;
    auto ell =
        extrude(std::vector<Vec<2>>{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}, true, 1, 0, 1, true);
    const InsideTest<3> inside(ell);
    const InsideTest<2> flat(
        polyline(std::vector<Vec<2>>{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}, true));
    for (int i = -2; i <= 10; ++i)
        for (int k = -2; k <= 10; ++k) {
            const double x = i * h, z = (k + 0.5) * h;
            const bool on_side = x == 0 || (x == 1 && z < 0.5) || (x == 0.5 && z > 0.5);
            const bool expected = z > 0 && z < 1 && x > 0 && x < (z < 0.5 ? 1 : 0.5);
            if (!on_side) CHECK(flat(Vec<2>(x, z)) == expected);
            for (int j = -2; j <= 10; ++j) {
                const double y = j * h;
                if (!on_side && y != 0 && y != 1) CHECK(inside(Vec<3>(x, y, z)) == (expected && y > 0 && y < 1));
            }
        }
    // An octahedron: every column through its axis meets two vertices.
    Surface<3> octahedron;
    octahedron.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    octahedron.facets = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    const InsideTest<3> in(octahedron);
    for (int i = -8; i <= 8; ++i)
        for (int j = -8; j <= 8; ++j)
            for (int k = -8; k <= 8; ++k) {
                const double sum = (std::abs(i) + std::abs(j) + std::abs(k)) * h;
                if (sum != 1) CHECK(in(Vec<3>(i * h, j * h, k * h)) == (sum < 1));
            }
}

TEST_CASE("at the rim of an open surface no side is defined") {
    const FacetTree<3> plane(rectangle(Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0, 1, 0)));
    CHECK(plane.nearest(Vec<3>(0.5, 0.5, 0.2)).side() > 0);
    CHECK(plane.nearest(Vec<3>(0.4, 0.5, -0.2)).side() < 0);
    CHECK(!plane.nearest(Vec<3>(0.5, 0.5, -0.2)).rim);  // on the diagonal, which two triangles share
    CHECK(plane.nearest(Vec<3>(1.5, 0.5, -0.2)).rim);
    CHECK(plane.nearest(Vec<3>(-1, -1, 0.1)).rim);
    const FacetTree<2> line(polyline(std::vector<Vec<2>>{{0, 0}, {1, 0}, {1, 1}}, false));
    CHECK(!line.nearest(Vec<2>(2, -1)).rim);
    CHECK(line.nearest(Vec<2>(2, -1)).side() < 0);
    CHECK(line.nearest(Vec<2>(0.9, 0.1)).side() > 0);
    CHECK(line.nearest(Vec<2>(-1, 0.1)).rim);
}
