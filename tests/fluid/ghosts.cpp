// Ghosts of a flat wall are mirror images: places, velocities, pressures and gradients.
#include "physics/fluid/walls/ghosts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/fluid/basins.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.05, reach = 5 * spacing;

// A wall askew, of three panels in one line, that moves and stretches. n points into the fluid.
struct SlantedWall {
    Vec2 n = Vec2(-0.6, 0.8), t = Vec2(0.8, 0.6), origin = Vec2(0.3, -0.2);
    double length = 3;

    Panels<2> panels(bool no_slip) const {
        Panels<2> made;
        std::vector<Vec2> points;
        for (const double s : {0.0, 0.9, 1.7, length}) points.push_back(origin + s * t);
        made.add_wall("slant", points, false, no_slip);
        for (std::size_t k = 0; k < points.size(); ++k) made.velocity[k] = velocity(points[k]);
        return made;
    }
    Vec2 velocity(const Vec2& x) const { return Vec2(1.1, 0.4) + 0.3 * (x - origin).dot(t) * t; }
    double height(const Vec2& x) const { return (x - origin).dot(n); }
    double along(const Vec2& x) const { return (x - origin).dot(t); }
};

// Rows of particles above the wall, thrown about by up to `jitter` spacings.
std::vector<Point<2>> rows_above(const SlantedWall& wall, double jitter, Random& random) {
    std::vector<Point<2>> points;
    for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 16; ++j) {
            const Vec2 x = wall.origin + (i + 0.5 + jitter * random()) * spacing * wall.t +
                           (j + 0.5 + jitter * random()) * spacing * wall.n;
            points.push_back({x.x(), x.y()});
        }
    return points;
}

Vec2 position(const Particles<2>& s, std::size_t i) {
    return {s.x[0][i], s.x[1][i]};
}

void check_images(bool no_slip) {
    CAPTURE(no_slip);
    const SlantedWall wall;
    Random random;
    const Vec2 gravity(0.5, -9.81);
    Particles<2> s = place<2>(rows_above(wall, 0.3, random), spacing);
    disorder(s, spacing, random);
    for (std::size_t i = 0; i < s.count; ++i) s.volume[i] = s.mass[i] / (1000 + s.deviation[i]);
    GhostWalls<2> walls = make_walls(wall.panels(no_slip));
    walls.rebuild(s, spacing, reach, gravity);
    CHECK(walls.corners.empty());

    std::vector<int> images(s.count, 0);
    for (std::size_t g = 0; g < walls.ghosts.size(); ++g) {
        const std::size_t j = walls.ghosts[g].parent, lane = s.ghost_begin() + g;
        ++images[j];
        const Vec2 x = position(s, j), foot = x - wall.height(x) * wall.n;
        CHECK((position(s, lane) - (2 * foot - x)).norm() < 1e-14);
        const Vec2 v(s.v[0][j], s.v[1][j]), v_w = wall.velocity(foot), u = v - v_w;
        const Vec2 expected = no_slip ? Vec2(v_w - u) : Vec2(v_w + u.dot(wall.t) * wall.t - u.dot(wall.n) * wall.n);
        CHECK((Vec2(s.v[0][lane], s.v[1][lane]) - expected).norm() < 1e-13);
        const double rho = 1000 + s.deviation[j];
        CHECK(std::fabs(s.p[lane] - s.p[j] - rho * gravity.dot(position(s, lane) - x)) < 1e-9);
        CHECK(s.volume[lane] == s.volume[j]);
        CHECK(s.impedance[lane] == s.impedance[j]);
    }
    // Everything within reach once, nothing else.
    for (std::size_t i = 0; i < s.count; ++i) {
        const Vec2 x = position(s, i);
        const bool mirrored = wall.height(x) < reach && wall.along(x) >= 0 && wall.along(x) < wall.length;
        CHECK(images[i] == (mirrored ? 1 : 0));
    }
    CHECK(walls.ghosts.size() > 200);
}

}  // namespace

TEST_CASE("ghosts of a flat, moving wall are mirror images") {
    check_images(false);
    check_images(true);
}

TEST_CASE("ghosts follow their parents and their wall") {
    const SlantedWall wall;
    Random random;
    Particles<2> s = place<2>(rows_above(wall, 0.3, random), spacing);
    GhostWalls<2> walls = make_walls(wall.panels(false));
    walls.rebuild(s, spacing, reach, Vec2::Zero());
    const Vec2 wall_moves(0.02, -0.013);
    for (std::size_t i = 0; i < s.count; ++i) s.x[0][i] += 0.01 * random();
    for (Vec2& x : walls.panels.position) x += wall_moves;
    walls.update_geometry();
    for (std::size_t block = 0; block < walls.blocks(); ++block) walls.update_state(s, Vec2::Zero(), block);
    for (std::size_t g = 0; g < walls.ghosts.size(); ++g) {
        const Vec2 x = position(s, walls.ghosts[g].parent);
        const double height = wall.height(x - wall_moves);
        CHECK(height > 0);
        // Closer than a twentieth of a spacing to the wall a ghost keeps its distance from its parent.
        const Vec2 expected = x - 2 * std::max(height, 0.05 * spacing) * wall.n;
        CHECK((position(s, s.ghost_begin() + g) - expected).norm() < 1e-14);
    }
}

TEST_CASE("linear fields that suit the wall have exact gradients up to it, and so have their ghosts") {
    const SlantedWall wall;
    const Vec2 gravity(1, -9.81);
    for (const bool no_slip : {false, true}) {
        CAPTURE(no_slip);
        Random random;
        Driver<2> driver(make_fluid<2>(spacing, water, {.muscl = true, .gravity = {gravity.x(), gravity.y(), 0}}));
        auto& s = driver.fluid.particles;
        s = place<2>(rows_above(wall, 0.3, random), spacing);
        driver.walls = make_walls(wall.panels(no_slip));
        for (Vec2& v : driver.walls->panels.velocity) v = Vec2(0.7, -0.2);
        driver.rebuild();
        // Hydrostatic pressure at one density; free slip: stretching along the wall, no slip: shear above it.
        Eigen::Matrix2d grad_v;
        if (no_slip)
            grad_v = 3 * wall.t * wall.n.transpose();
        else
            grad_v = 2 * wall.t * wall.t.transpose() - 2 * wall.n * wall.n.transpose();
        for (std::size_t i = 0; i < s.count; ++i) {
            const Vec2 from = position(s, i) - wall.origin, v = Vec2(0.7, -0.2) + grad_v * from;
            s.p[i] = 2e4 + 1000 * gravity.dot(from);
            for (int d = 0; d < 2; ++d) s.v[static_cast<std::size_t>(d)][i] = v[d];
        }
        driver.rates(0);
        double error_p = 0, error_v = 0;
        std::size_t tested = 0;
        const auto check = [&](std::size_t lane) {
            ++tested;
            error_p = std::max(error_p, (Vec2(s.grad_p[0][lane], s.grad_p[1][lane]) - 1000 * gravity).norm() / 1e4);
            for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b)
                    error_v = std::max(
                        error_v, std::fabs(s.grad_v[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)][lane] -
                                           grad_v(a, b)));
        };
        const auto inside = [&](std::size_t i) {  // away from the ends of the wall
            return wall.along(position(s, i)) > reach && wall.along(position(s, i)) < wall.length - reach;
        };
        for (std::size_t i = 0; i < s.count; ++i) {
            if (inside(i) && wall.height(position(s, i)) < 0.5) {
                check(i);
                CHECK(s.fullness[i] > fullness_of_interior);
            }
        }
        for (std::size_t g = 0; g < driver.walls->ghosts.size(); ++g)
            if (inside(driver.walls->ghosts[g].parent)) check(s.ghost_begin() + g);
        CAPTURE(error_p);
        CAPTURE(error_v);
        CHECK(tested > 600);
        CHECK(error_p < 1e-12);
        CHECK(error_v < 1e-12);
        // Water at rest over a wall at rest, or moving with it, feels nothing.
        for (std::size_t i = 0; i < s.count; ++i)
            for (int d = 0; d < 2; ++d) s.v[static_cast<std::size_t>(d)][i] = Vec2(0.7, -0.2)[d];
        driver.rates(0);
        for (std::size_t i = 0; i < s.count; ++i)
            if (inside(i) && wall.height(position(s, i)) < 0.5)
                CHECK(std::fabs(s.deviation_rate[i]) < 1e-9 * 1000 * 20);
    }
}

TEST_CASE("ghosts of a right-angled, moving corner are point reflections") {
    Random random;
    const Vec2 gravity(0.5, -9.81), v_w(0.8, -0.3);
    Particles<2> s = place<2>(lattice<2>({20, 20}, spacing, 0.3, random), spacing);
    disorder(s, spacing, random);
    GhostWalls<2> walls = make_walls(tank(20 * spacing, 2));
    for (Vec2& v : walls.panels.velocity) v = v_w;
    walls.rebuild(s, spacing, reach, gravity);
    std::size_t reflected[2] = {0, 0}, expected[2] = {0, 0};
    for (std::size_t g = 0; g < walls.ghosts.size(); ++g) {
        const Ghost& ghost = walls.ghosts[g];
        if (ghost.corner < 0) continue;
        const std::size_t j = ghost.parent, lane = s.ghost_begin() + g;
        const Vec2 corner = position(s, j).x() < 10 * spacing ? Vec2(0, 0) : Vec2(20 * spacing, 0);
        ++reflected[corner.x() > 0];
        CHECK((position(s, lane) - (2 * corner - position(s, j))).norm() < 1e-14);
        CHECK((Vec2(s.v[0][lane], s.v[1][lane]) - (2 * v_w - Vec2(s.v[0][j], s.v[1][j]))).norm() < 1e-14);
        const double rho = s.mass[j] / s.volume[j];
        CHECK(std::fabs(s.p[lane] - s.p[j] - rho * gravity.dot(position(s, lane) - position(s, j))) < 1e-9);
        CHECK(s.volume[lane] == s.volume[j]);
    }
    for (std::size_t i = 0; i < s.count; ++i)
        for (const int k : {0, 1}) expected[k] += (position(s, i) - Vec2(k * 20 * spacing, 0)).norm() < reach;
    CHECK(expected[0] > 15);
    CHECK(reflected[0] == expected[0]);
    CHECK(reflected[1] == expected[1]);
}

TEST_CASE("gradients are mirrored, but for the weight of the water") {
    Random random;
    const Vec2 gravity(0.5, -9.81);
    for (const bool no_slip : {false, true}) {
        CAPTURE(no_slip);
        Particles<2> s = place<2>(lattice<2>({20, 20}, spacing, 0.3, random), spacing);
        disorder(s, spacing, random);
        Panels<2> panels = tank(20 * spacing, 2);
        for (Panel<2>& panel : panels.panels) panel.no_slip = no_slip;
        GhostWalls<2> walls = make_walls(panels);
        walls.rebuild(s, spacing, reach, gravity);
        s.grad_p[0][5] = s.grad_p[1][5] = 0;  // too bare to have one
        for (std::size_t block = 0; block < walls.blocks(); ++block) walls.update_gradients(s, gravity, block);
        bool bare_seen = false;
        for (std::size_t g = 0; g < walls.ghosts.size(); ++g) {
            const Ghost& ghost = walls.ghosts[g];
            const std::size_t j = ghost.parent, lane = s.ghost_begin() + g;
            // A free-slip wall along y (the first and the last) turns x round, one along x turns y round, a corner
            // both.
            const bool corner = ghost.corner >= 0;
            const double S[2] = {corner || ghost.panel != 1 ? -1.0 : 1.0, corner || ghost.panel == 1 ? -1.0 : 1.0};
            const double T[2] = {no_slip ? -1 : S[0], no_slip ? -1 : S[1]};
            for (std::size_t a = 0; a < 2; ++a) {
                const double weight = s.mass[j] / s.volume[j] * gravity[static_cast<int>(a)];
                const double expected = j == 5 ? 0 : weight + S[a] * (s.grad_p[a][j] - weight);
                CHECK(std::fabs(s.grad_p[a][lane] - expected) < 1e-10);
                for (std::size_t b = 0; b < 2; ++b)
                    CHECK(std::fabs(s.grad_v[a][b][lane] - T[a] * s.grad_v[a][b][j] * S[b]) < 1e-12);
            }
            bare_seen = bare_seen || j == 5;
        }
        CHECK(bare_seen);
    }
}
