// Values and surfaces at places between particles, against fields whose values are known everywhere.
#include "physics/fluid/probes.hpp"

#include <doctest/doctest.h>

#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.1;

template <int D>
Fluid<D> fluid_of(const std::vector<Point<D>>& points, double support_ratio) {
    Fluid<D> fluid = make_fluid<D>(spacing, water);
    fluid.kernel = WendlandC2<D>(support_ratio * spacing);
    fluid.particles = test::place<D>(points, spacing);
    return fluid;
}

template <int D>
std::array<int, D> cells(int n) {
    std::array<int, D> all;
    all.fill(n);
    return all;
}

// 7 + x + 2y + 3z
template <int D>
double linear(const Eigen::Matrix<double, D, 1>& x) {
    double value = 7;
    for (int d = 0; d < D; ++d) value += (d + 1) * x[d];
    return value;
}

template <int D>
void set_linear_pressure(Particles<D>& s) {
    for (std::size_t i = 0; i < s.count; ++i) {
        Eigen::Matrix<double, D, 1> x;
        for (int d = 0; d < D; ++d) x[d] = s.x[std::size_t(d)][i];
        s.p[i] = linear<D>(x);
    }
}

template <int D>
double value_at(const Fluid<D>& fluid, const Eigen::Matrix<double, D, 1>& x, Interpolation how,
                std::optional<Eigen::Matrix<double, D, 1>> side = {}) {
    PlaceInFluid<D> place;
    place.look(fluid, x, side, how);
    return place.of(fluid.particles.p);
}

}  // namespace

TEST_CASE_TEMPLATE("a linear field is interpolated as stated", Dimension, std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>) {
    constexpr int D = Dimension::value;
    using Vector = Eigen::Matrix<double, D, 1>;
    for (const double ratio : {2.6, 4.0}) {
        CAPTURE(ratio);
        Random random;
        Fluid<D> regular = fluid_of<D>(lattice<D>(cells<D>(14), spacing, 0, random), ratio);
        Fluid<D> disordered = fluid_of<D>(lattice<D>(cells<D>(14), spacing, 0.2, random), ratio);
        set_linear_pressure(regular.particles);
        set_linear_pressure(disordered.particles);
        const double slope = std::sqrt(D == 2 ? 5.0 : 14.0);
        double worst = 0;
        for (int k = 0; k < 50; ++k) {
            Vector x;
            for (int d = 0; d < D; ++d) x[d] = 0.7 + 0.2 * random();
            worst = std::max(worst, std::fabs(value_at(regular, x, Interpolation::shepard) - linear<D>(x)));
            CHECK(value_at(regular, x, Interpolation::linear) == doctest::Approx(linear<D>(x)).epsilon(1e-12));
            CHECK(value_at(disordered, x, Interpolation::linear) == doctest::Approx(linear<D>(x)).epsilon(1e-12));
            CHECK(std::fabs(value_at(disordered, x, Interpolation::shepard) - linear<D>(x)) < 0.15 * spacing * slope);
        }
        CHECK(worst < 0.01 * spacing * slope);
        // On the lower face, as on a wall: Shepard's value is that of a place inside, the linear one is right.
        Vector wall = Vector::Constant(0.7), normal = Vector::Zero();
        wall[D - 1] = 0;
        normal[D - 1] = 1;
        CHECK(value_at(regular, wall, Interpolation::linear, {normal}) ==
              doctest::Approx(linear<D>(wall)).epsilon(1e-12));
        const double inside = value_at(regular, wall, Interpolation::shepard, {normal}) - linear<D>(wall);
        CHECK(inside > 0.2 * ratio * spacing * D);
        CHECK(inside < 0.24 * ratio * spacing * D);
    }
}

TEST_CASE("a place on a wall sees its own side only") {
    // Two basins, 3 Δx apart, at 1 Pa and 2 Pa.
    Random random;
    auto points = lattice<2>({10, 10}, spacing, 0, random);
    for (const auto& point : lattice<2>({10, 10}, spacing, 0, random)) points.push_back({point[0] + 1.3, point[1]});
    Fluid<2> fluid = fluid_of<2>(points, 4);
    for (std::size_t i = 0; i < 200; ++i) fluid.particles.p[i] = i < 100 ? 1 : 2;
    const Eigen::Vector2d left{1.0, 0.5}, right{1.3, 0.5}, outwards{-1, 0};
    CHECK(value_at<2>(fluid, left, Interpolation::shepard, {outwards}) == doctest::Approx(1).epsilon(1e-14));
    CHECK(value_at<2>(fluid, right, Interpolation::shepard, {Eigen::Vector2d(1, 0)}) ==
          doctest::Approx(2).epsilon(1e-14));
    CHECK(value_at<2>(fluid, right, Interpolation::shepard) < 1.9999);
}

TEST_CASE("in the air there is nothing, and a sheet falls back to Shepard's form") {
    Random random;
    Fluid<2> sheet = fluid_of<2>(lattice<2>({20, 1}, spacing, 0, random), 2.6);
    set_linear_pressure(sheet.particles);
    PlaceInFluid<2> place;
    place.look(sheet, {1.0, 1.0}, {}, Interpolation::linear);
    CHECK_FALSE(place.wet());
    CHECK(place.of(sheet.particles.p) == 0);
    const Eigen::Vector2d above{1.0, 0.2};
    CHECK(value_at<2>(sheet, above, Interpolation::linear) == value_at<2>(sheet, above, Interpolation::shepard));
}

TEST_CASE_TEMPLATE("the surface of a step", Dimension, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
    constexpr int D = Dimension::value;
    // Water 1.2 m deep for x < 2 m and 0.5 m deep beyond it, with a spray of single drops above.
    Random random;
    std::array<int, D> deep = cells<D>(16), shallow = cells<D>(16);
    deep[0] = shallow[0] = 20;
    deep[D - 1] = 12;
    shallow[D - 1] = 5;
    auto points = lattice<D>(deep, spacing, 0, random);
    for (Point<D> point : lattice<D>(shallow, spacing, 0, random)) {
        point[0] += 2;
        points.push_back(point);
    }
    Point<D> drop;
    drop.fill(0.8);
    drop[D - 1] = 2.5;
    points.push_back(drop);
    for (const double ratio : {2.6, 4.0}) {
        CAPTURE(ratio);
        const Fluid<D> fluid = fluid_of<D>(points, ratio);
        SurfaceOver<D> surface;
        const auto level = [&](double x) {
            std::array<double, D> foot;
            foot.fill(0.8);
            foot[0] = x;
            foot[D - 1] = 0;
            return surface.height(fluid, foot);
        };
        for (const double x : {0.75, 0.8, 1.0, 1.23}) {
            CAPTURE(x);
            CHECK(std::fabs(level(x) - 1.2) < 0.02 * spacing);
        }
        for (const double x : {2.8, 3.0, 3.14}) {
            CAPTURE(x);
            CHECK(std::fabs(level(x) - 0.5) < 0.02 * spacing);
        }
        CHECK(std::fabs(level(0) - 1.2) < 0.05 * spacing);  // on the side wall
        CHECK(level(5) == 0);                               // beyond the water
        CHECK(level(2 - 0.5 * spacing) > 1.0);              // the step is smeared over the support
        CHECK(level(2 + 0.5 * spacing) < 1.1);
    }
}
