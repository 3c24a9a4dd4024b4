// Prescribed motions against closed forms; velocities against differences of positions.
#include "physics/fluid/walls/motion.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

using namespace aquagraph;
using namespace aquagraph::fluid;
using doctest::Approx;

namespace {

constexpr double pi = std::numbers::pi;

// Fourth order central difference.
template <class F>
auto difference(const F& f, double t, double h) -> decltype(f(t)) {
    return (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h);
}

}  // namespace

TEST_CASE("laws of motion against their closed forms, rates against differences") {
    const ConstantRate constant{2.5, {}}, ramped{2.5, {0.4}};
    CHECK(constant.at(0.7).value == Approx(1.75));
    CHECK(constant.at(0.7).rate == 2.5);
    CHECK(ramped.at(0.4).value == Approx(2.5 * 0.2));
    CHECK(ramped.at(1).value == Approx(2.5 * 0.8));
    CHECK(ramped.at(0.2).rate == Approx(1.25));
    CHECK(ramped.at(0).rate == 0);

    const Harmonic wave{0.3, 2, 0.5, {}}, rising{0.3, 2, 0.5, {0.8}};
    CHECK(wave.at(0).value == 0);
    CHECK(wave.at(0.1).value == Approx(0.3 * (std::sin(0.4 * pi + 0.5) - std::sin(0.5))));
    CHECK(wave.at(0.1).rate == Approx(0.3 * 4 * pi * std::cos(0.4 * pi + 0.5)));
    CHECK(rising.at(0).value == 0);
    CHECK(rising.at(0).rate == 0);
    CHECK(rising.at(1).value == Approx(0.3 * std::sin(4 * pi + 0.5)));

    const TimeTable table({-0.5, 0, 0.2, 0.5, 0.6, 1.5}, {1, 2, 4, 4.1, 3, -2});
    for (const TimeLaw& law : {TimeLaw(constant), TimeLaw(ramped), TimeLaw(wave), TimeLaw(rising), TimeLaw(table)})
        for (const double t : {0.03, 0.13, 0.27, 0.39, 0.55, 0.9, 1.4}) {
            CAPTURE(t);
            const double rate = difference([&](double s) { return evaluate(law, s).value; }, t, 1e-3);
            CHECK(evaluate(law, t).rate == Approx(rate).epsilon(1e-8));
            const double acceleration = difference([&](double s) { return evaluate(law, s).rate; }, t, 1e-3);
            CHECK(evaluate(law, t).acceleration == Approx(acceleration).epsilon(1e-6));
        }
}

TEST_CASE("a table passes through its rows, with continuous velocity and without overshoot") {
    const std::vector<double> time{-0.5, 0, 0.2, 0.5, 0.6, 1.5}, value{1, 2, 4, 4.1, 3, -2};
    const TimeTable table(time, value);
    for (std::size_t k = 0; k < time.size(); ++k) {
        CHECK(table.at(time[k]).value == Approx(value[k] - 2));
        if (k == 0 || k + 1 == time.size()) continue;
        CHECK(table.at(time[k] - 1e-12).rate == Approx(table.at(time[k] + 1e-12).rate).epsilon(1e-8));
    }
    for (std::size_t k = 0; k + 1 < time.size(); ++k)
        for (int n = 0; n <= 100; ++n) {
            const double x = table.at(time[k] + (time[k + 1] - time[k]) * n / 100).value + 2;
            CHECK(x >= std::min(value[k], value[k + 1]) - 1e-12);
            CHECK(x <= std::max(value[k], value[k + 1]) + 1e-12);
        }
    CHECK(table.at(7).value == Approx(-4));
    CHECK(table.at(7).rate == 0);
    CHECK(table.end() == 1.5);
    // Straight lines come out straight.
    const TimeTable line({0, 0.3, 1}, {0, 0.6, 2});
    CHECK(line.at(0.77).value == Approx(1.54));
    CHECK(line.at(0.77).rate == Approx(2));
    // A smooth curve is followed to second order at least.
    const auto error = [](int n) {
        std::vector<double> t, x;
        for (int k = 0; k <= n; ++k) {
            t.push_back(double(k) / n);
            x.push_back(std::exp(t.back()));
        }
        const TimeTable sampled(t, x);
        double worst = 0;
        for (int k = 0; k <= 1000; ++k)
            worst = std::max(worst, std::fabs(sampled.at(k / 1000.0).value + 1 - std::exp(k / 1000.0)));
        return worst;
    };
    CHECK(error(40) < error(20) / 3.5);
    CHECK(error(20) < 2e-3);

    CHECK_THROWS_WITH_AS(TimeTable({0}, {1}), "a table needs at least two rows", std::invalid_argument);
    CHECK_THROWS_WITH_AS(TimeTable({0, 1, 1}, {1, 2, 3}), doctest::Contains("time does not increase in row 3"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(TimeTable({1, 2}, {1, 2}), doctest::Contains("must hold t = 0"), std::invalid_argument);
}

TEST_CASE("walls turn about a point that moves, vertices have the velocity of their places") {
    Panels<2> panels;
    const int tank = panels.add_wall("tank", {{0, 0}, {1, 0}, {1, 1}}, false, false);
    const int still = panels.add_wall("still", {{5, 5}, {6, 5}}, false, false);
    RigidMotion<2> motion;
    motion.centre = Vec2(0.5, 0);
    motion.translations.push_back({Vec2(2, -1), ConstantRate{0.5, {}}});
    motion.rotations.push_back(Harmonic{0.3, 1, 0, {}});
    MovingWalls<2> moving;
    moving.add(panels, tank, motion);
    (void)still;
    const auto drawn = panels.position;
    const auto at = [&](double t, std::size_t v) {
        moving.place(panels, t);
        return Vec2(panels.position[v]);
    };
    for (const double t : {0.01, 0.1, 0.45}) {
        const double angle = 0.3 * std::sin(2 * pi * t);
        for (std::size_t v = 0; v < 3; ++v) {
            const Vec2 arm = drawn[v] - Vec2(0.5, 0);
            const Vec2 expected = Vec2(0.5 + t, -0.5 * t) + Vec2(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                                                                 std::sin(angle) * arm.x() + std::cos(angle) * arm.y());
            CHECK((at(t, v) - expected).norm() < 1e-14);
            const Vec2 velocity = panels.velocity[v];
            CHECK((velocity - difference([&](double s) { return at(s, v); }, t, 1e-3)).norm() < 1e-8);
        }
    }
    CHECK(at(0.3, 4) == drawn[4]);
    CHECK(panels.velocity[4] == Vec2(0, 0));
    moving.place(panels, 0);
    for (std::size_t v = 0; v < drawn.size(); ++v) CHECK(panels.position[v] == drawn[v]);
    double fastest = 0, farthest = 0;
    for (std::size_t v = 0; v < 3; ++v) farthest = std::max(farthest, (at(0.2, v) - drawn[v]).norm());
    for (std::size_t v = 0; v < 3; ++v) fastest = std::max(fastest, panels.velocity[v].norm());
    CHECK(moving.largest_speed(0.2) == Approx(fastest));
    CHECK(moving.largest_distance(drawn, 0.2) == Approx(farthest));
}

TEST_CASE("in three dimensions about an axis through a point") {
    Panels<3> panels;
    const int plate = panels.add_wall("plate", {{1, 0, 0}, {2, 0, 0.5}, {1, 1, 1}}, {{{0, 1, 2}}}, false);
    RigidMotion<3> motion;
    motion.centre = Vec3(1, 2, 3);
    motion.axis = Vec3(1, 1, 1).normalized();
    motion.rotations.push_back(ConstantRate{2 * pi / 3, {}});
    motion.translations.push_back({Vec3(0, 0, 1), Harmonic{0.2, 1.5, 1, {0.3}}});
    MovingWalls<3> moving;
    moving.add(panels, plate, motion);
    const auto drawn = panels.position;
    const auto at = [&](double t, std::size_t v) {
        moving.place(panels, t);
        return Vec3(panels.position[v]);
    };
    for (std::size_t v = 0; v < 3; ++v) {
        for (const double t : {0.05, 0.4, 0.83}) {
            at(t, v);
            const Vec3 velocity = panels.velocity[v];
            CHECK((velocity - difference([&](double s) { return at(s, v); }, t, 1e-3)).norm() < 1e-8);
        }
        // A third of a turn about the diagonal makes x of y, y of z, z of x.
        const Vec3 arm = drawn[v] - motion.centre, turned(arm.z(), arm.x(), arm.y());
        CHECK((at(1, v) - motion.centre - turned - Vec3(0, 0, 0.2 * std::sin(3 * pi + 1))).norm() < 1e-12);
    }
}
