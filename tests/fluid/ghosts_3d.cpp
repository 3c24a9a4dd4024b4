// Ghosts of walls made of triangles: mirror images, turned images at edges, reflected ones in corners; what walls do to
// a flow.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/fluid/basins_3d.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;
using aquagraph::solid::test::ThreadedLoop;

namespace {

constexpr double spacing = 0.1, reach = 5 * spacing;

// A wall askew that moves and stretches: a square with a point in the middle, off centre.
struct SlantedWall {
    Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(0.8, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.5, Vec3::UnitX())).toRotationMatrix();
    Vec3 n = turn.col(2), origin = Vec3(0.3, -0.2, 0.1);
    double length = 2;
    Eigen::Matrix3d stretching =
        0.3 * turn.col(0) * turn.col(1).transpose() - 0.2 * turn.col(1) * turn.col(1).transpose();

    Panels<3> panels(bool no_slip) const {
        Panels<3> made;
        std::vector<Vec3> points;
        for (const Vec3& x : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0), Vec3(0.8, 1.3, 0)})
            points.push_back(origin + turn * x);
        made.add_wall("slant", points, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, no_slip);
        for (std::size_t k = 0; k < points.size(); ++k) made.velocity[k] = velocity(points[k]);
        return made;
    }
    Vec3 velocity(const Vec3& x) const { return Vec3(1.1, 0.4, -0.3) + stretching * (x - origin); }
    Vec3 local(const Vec3& x) const { return turn.transpose() * (x - origin); }
};

std::vector<Point<3>> layers_above(const SlantedWall& wall, double jitter, Random& random) {
    std::vector<Point<3>> points;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = 0; k < 9; ++k) {
                const auto at = [&](int c) { return (c + 0.5 + jitter * random()) * spacing; };
                const Vec3 x = wall.origin + wall.turn * Vec3(at(i), at(j), at(k));
                points.push_back({x.x(), x.y(), x.z()});
            }
    return points;
}

void check_images(bool no_slip) {
    CAPTURE(no_slip);
    const SlantedWall wall;
    Random random;
    const Vec3 gravity(0.5, 1, -9.81);
    for (const double jitter : {0.0, 0.3}) {  // without, feet lie on the lines between triangles
        Particles<3> s = place<3>(layers_above(wall, jitter, random), spacing);
        disorder(s, spacing, random);
        GhostWalls<3> walls = make_ghost_walls(wall.panels(no_slip));
        walls.rebuild(s, spacing, reach, gravity);
        CHECK(walls.corners.empty());
        std::vector<int> images(s.count, 0);
        double error = 0, error_p = 0;
        for (std::size_t g = 0; g < walls.ghosts.size(); ++g) {
            const std::size_t j = walls.ghosts[g].parent, lane = s.ghost_begin() + g;
            ++images[j];
            const Vec3 x = position(s, j), foot = x - wall.local(x).z() * wall.n;
            error = std::max(error, (position(s, lane) - (2 * foot - x)).norm());
            const Vec3 v_w = wall.velocity(foot), u = velocity(s, j) - v_w;
            const Vec3 expected = no_slip ? Vec3(v_w - u) : Vec3(v_w + u - 2 * u.dot(wall.n) * wall.n);
            error = std::max(error, (velocity(s, lane) - expected).norm());
            const double rho = s.mass[j] / s.volume[j];
            error_p = std::max(error_p, std::fabs(s.p[lane] - s.p[j] - rho * gravity.dot(position(s, lane) - x)));
            CHECK(s.volume[lane] == s.volume[j]);
            CHECK(s.impedance[lane] == s.impedance[j]);
        }
        CHECK(error < 1e-13);
        CHECK(error_p < 1e-9);
        // Everything within reach once, nothing else.
        int wrong = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            const Vec3 x = wall.local(position(s, i));
            wrong += images[i] != (x.z() < reach && x.x() >= 0 && x.x() < 2 && x.y() >= 0 && x.y() < 2 ? 1 : 0);
        }
        CHECK(wrong == 0);
        CHECK(walls.ghosts.size() > 1000);
    }
}

}  // namespace

TEST_CASE("ghosts of a flat, moving wall of triangles are mirror images, one for each particle") {
    check_images(false);
    check_images(true);
}

TEST_CASE("every particle has one ghost per flat face, however its feet lie on the lines between triangles") {
    // Lattice points over the diagonals of squares, and over the joint of two walls that do not share vertices.
    Panels<3> panels;
    panels.add_wall("left", {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}, false);
    panels.add_wall("right", {{1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 0}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}},
                    false);
    Random random;
    auto points = lattice<3>({18, 18, 4}, spacing, 0, random);
    for (auto& x : points)
        for (const std::size_t d : {0u, 1u}) x[d] += 0.5 * spacing;
    for (const double turned : {0.0, 0.3, 1.1}) {
        CAPTURE(turned);
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(turned, Vec3(1, 2, 3).normalized()).toRotationMatrix();
        Panels<3> of = panels;
        for (Vec3& x : of.position) x = turn * x;
        auto there = points;
        for (auto& p : there) {
            const Vec3 x = turn * Vec3(p[0], p[1], p[2]);
            p = {x.x(), x.y(), x.z()};
        }
        Particles<3> s = place<3>(there, spacing);
        GhostWalls<3> walls = make_ghost_walls(of);
        walls.rebuild(s, spacing, reach, Vec3::Zero());
        std::vector<int> images(s.count, 0);
        for (const Ghost& ghost : walls.ghosts) ++images[ghost.parent];
        CHECK(std::count(images.begin(), images.end(), 1) == long(s.count));
    }
}

TEST_CASE("edges turn the water about their line, corners reflect it through their point") {
    const Vec3 size(1.2, 1.1, 2);
    for (const bool no_slip : {false, true}) {
        CAPTURE(no_slip);
        Random random;
        Particles<3> s = place<3>(lattice<3>({12, 11, 8}, spacing, 0.3, random), spacing);
        disorder(s, spacing, random);
        Panels<3> panels = tank(size, no_slip);
        const Vec3 v_w(0.3, -0.2, 0.5), gravity(0.5, 1, -9.81);
        for (Vec3& v : panels.velocity) v = v_w;
        GhostWalls<3> walls = make_ghost_walls(panels);
        walls.rebuild(s, spacing, reach, gravity);
        for (std::size_t block = 0; block < walls.blocks(); ++block) walls.update_gradients(s, gravity, block);
        CHECK(walls.corners.size() == 8 + 4);
        double error = 0, error_gradient = 0;
        std::size_t by_kind[4] = {};
        for (std::size_t g = 0; g < walls.ghosts.size(); ++g) {
            const std::size_t j = walls.ghosts[g].parent, lane = s.ghost_begin() + g;
            const Vec3 x = position(s, j), image = position(s, lane);
            // Which coordinates are mirrored at which planes: that is all a box's ghosts are.
            Vec3 sign(1, 1, 1);
            int mirrored = 0;
            for (int d = 0; d < 3; ++d) {
                if (std::fabs(image[d] - x[d]) < 1e-12) continue;
                sign[d] = -1;
                ++mirrored;
                const double plane = d < 2 && x[d] > 0.5 * size[d] ? size[d] : 0;
                error = std::max(error, std::fabs(image[d] + x[d] - 2 * plane));
            }
            REQUIRE(mirrored >= 1);
            ++by_kind[mirrored];
            const Vec3 u = velocity(s, j) - v_w, expected = v_w + (no_slip ? Vec3(-u) : Vec3(sign.cwiseProduct(u)));
            error = std::max(error, (velocity(s, lane) - expected).norm());
            const Vec3 weight = s.mass[j] / s.volume[j] * gravity;
            for (std::size_t a = 0; a < 3; ++a) {
                const double p = weight[int(a)] + sign[int(a)] * (s.grad_p[a][j] - weight[int(a)]);
                error_gradient = std::max(error_gradient, std::fabs(s.grad_p[a][lane] - p) / 1e4);
                for (std::size_t b = 0; b < 3; ++b) {
                    const double t = no_slip ? -1 : sign[int(a)];
                    error_gradient = std::max(error_gradient,
                                              std::fabs(s.grad_v[a][b][lane] - t * s.grad_v[a][b][j] * sign[int(b)]));
                }
            }
        }
        CHECK(error < 1e-13);
        CHECK(error_gradient < 1e-12);
        std::size_t expected[4] = {};
        for (std::size_t i = 0; i < s.count; ++i) {
            const Vec3 x = position(s, i);
            const double to[5] = {x.x(), size.x() - x.x(), x.y(), size.y() - x.y(), x.z()};
            for (const double d : to) expected[1] += d < reach;
            for (const int a : {0, 1})
                for (const int b : {2, 3}) {
                    expected[2] += std::hypot(to[a], to[b]) < reach;
                    expected[3] += std::hypot(to[a], to[b], to[4]) < reach;
                }
            for (const int a : {0, 1, 2, 3}) expected[2] += std::hypot(to[a], to[4]) < reach;
        }
        for (const int kind : {1, 2, 3}) CHECK(by_kind[kind] == expected[kind]);
    }
}

TEST_CASE("a lone particle behind a wall is put back, one too deep is found") {
    for (const bool turned : {false, true}) {  // onto the first or the second triangle of the floor
        const double along = turned ? 0.7 : 0.3;
        Particles<3> s = place<3>({{along, 1 - along, 0.01}}, spacing);
        GhostWalls<3> walls = make_ghost_walls(tank({1, 1, 1}));
        walls.rebuild(s, spacing, reach, Vec3::Zero());
        s.x[2][0] = -0.02;
        s.v[2][0] = -3;
        s.v[0][0] = 2;
        s.x[0][0] = 1 - along;  // over the other triangle since the lists were built
        CHECK(walls.deepest(s).depth == doctest::Approx(0.02));
        CHECK(walls.hold_back(s, spacing) == 1);
        CHECK(s.x[2][0] > 0);
        CHECK(s.v[2][0] == 0);
        CHECK(s.v[0][0] == 2);
        s.x[2][0] = -0.08;
        CHECK(walls.hold_back(s, spacing) == 0);
        const Escape escape = walls.deepest(s);
        CHECK(escape.depth == doctest::Approx(0.08));
        CHECK(escape.particle == 0);
        CHECK(walls.panels.normal[std::size_t(escape.panel)].z() == doctest::Approx(1));
    }
}

namespace {

// A disordered layer between floor and lid, periodic along x and y, that flows along x.
Driver<3> channel(bool no_slip, const Vec3& flow, double lid_speed) {
    const std::array<int, 3> cells{8, 7, 6};
    const double x = 8 * spacing, y = 7 * spacing, z = 6 * spacing;
    Panels<3> panels;
    panels.add_wall("floor", {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}, {{0, 1, 2}, {0, 2, 3}}, no_slip);
    panels.add_wall("lid", {{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}}, {{0, 1, 2}, {0, 2, 3}}, no_slip);
    for (std::size_t v = 4; v < 8; ++v) panels.velocity[v] = Vec3(lid_speed, 0, 0);
    Driver<3> driver(make_fluid<3>(spacing, water));
    Random random(5);
    driver.fluid.particles = place<3>(lattice<3>(cells, spacing, 0.1, random), spacing);
    for (std::size_t i = 0; i < driver.fluid.particles.count; ++i)
        for (int d = 0; d < 3; ++d) driver.fluid.particles.v[std::size_t(d)][i] = flow[d] + 0.2 * random();
    driver.walls = make_ghost_walls(panels);
    driver.walls->periodic = {{true, true, false}, Vec3::Zero(), Vec3(x, y, z)};
    return driver;
}

Vec3 momentum(const Driver<3>& driver) {
    const auto& s = driver.fluid.particles;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < s.count; ++i) sum += s.mass[i] * velocity(s, i);
    return sum;
}

}  // namespace

TEST_CASE("walls of free slip keep the momentum along them, those without slip take it or give it") {
    Driver<3> slippery = channel(false, {1, -0.5, 0}, 3), rough = channel(true, {1, -0.5, 0}, 0),
              dragged = channel(true, {0, 0, 0}, 2);
    const Vec3 before = momentum(slippery), before_dragged = momentum(dragged);
    for (int k = 0; k < 30; ++k) {
        slippery.step(slippery.largest_step());
        rough.step(rough.largest_step());
        dragged.step(dragged.largest_step());
    }
    CHECK(slippery.fluid.rebuilds > 1);
    CHECK(std::fabs(momentum(slippery).x() - before.x()) < 1e-11 * before.norm());
    CHECK(std::fabs(momentum(slippery).y() - before.y()) < 1e-11 * before.norm());
    CHECK(momentum(rough).x() < 0.995 * before.x());
    CHECK(momentum(rough).y() > 0.995 * before.y());
    CHECK(momentum(dragged).x() - before_dragged.x() > 0.005 * before.norm());
}

TEST_CASE("a box of water with a body in it: the same bits on 1, 2 and 4 threads") {
    std::vector<double> serial;
    for (const unsigned threads : {0u, 2u, 4u}) {
        CAPTURE(threads);
        const ThreadedLoop threaded{threads};
        const BlockLoop loop = threads == 0 ? BlockLoop(serial_loop) : BlockLoop(threaded);
        Driver<3> driver(make_fluid<3>(spacing, water, {.gravity = {0, 0, -9.81}}));
        const auto points = cells_where({12, 11, 9}, spacing, [](const Vec3& x) { return x.x() < 0.6 || x.x() > 0.7; });
        driver.fluid.particles = place<3>(points, spacing);
        Panels<3> panels = tank({1.2, 1.1, 1.5});
        add_box(panels, "plate", {0.6, -0.5, 0}, {0.7, 2, 1.5}, false);
        driver.walls = make_ghost_walls(panels);
        driver.motion = [](Panels<3>& moved, double time) {
            for (std::size_t v = 8; v < 16; ++v) {
                moved.position[v].x() = (v % 2 == 0 ? 0.6 : 0.7) + 0.5 * time * time;
                moved.velocity[v].x() = time;
            }
        };
        for (int step = 0; step < 12; ++step) driver.step(driver.largest_step(), loop);
        CHECK(driver.fluid.particles.blocks() > 7);
        const auto state = state_by_id(driver.fluid.particles);
        if (threads == 0) serial = state;
        CHECK(state == serial);
    }
}
