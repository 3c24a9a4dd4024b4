// What lies behind convex edges of ghost walls is filled from both sides, by shares that vary smoothly.
#include "physics/fluid/walls/edge_shares.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/fluid/walls/gamma.hpp"
#include "tests/fluid/supports.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

constexpr double spacing = 0.05, R = support_ratio * spacing, reach = 1.25 * R;
constexpr double degree = std::numbers::pi / 180;

// A body that fills `angle` [°] below an edge at the origin, symmetric about the y axis, water above. Its first side
// comes from the left.
Panels<2> wedge(double angle) {
    const double half = 0.5 * angle * degree;
    const Vec2 right(std::sin(half), -std::cos(half)), left(-right.x(), right.y());
    Panels<2> panels;
    panels.add_wall("wedge", {5 * left, Vec2::Zero(), 5 * right}, false, false);
    panels.update_geometry();
    panels.find_joints();
    return panels;
}

EdgeShares<2> edges_of(const Panels<2>& panels) {
    EdgeShares<2> shares;
    shares.find_edges(panels, smooth_patches(panels), spacing, reach);
    return shares;
}

// A tank with a step, and lattice water that is thrown about.
struct Step {
    std::vector<Point<2>> points;
    Panels<2> panels;

    explicit Step(double jitter) {
        Random random;
        points = cells_where(24, 24, spacing, [](const Point<2>& x) { return x[0] < 0.6 || x[1] > 0.6; });
        for (Point<2>& x : points)
            for (double& along : x) along += jitter * spacing * random();
        panels.add_wall("tank", {{0, 2}, {0, 0}, {0.6, 0}, {0.6, 0.6}, {1.2, 0.6}, {1.2, 2}}, false, false);
    }
};
const Vec2 edge(0.6, 0.6);

}  // namespace

TEST_CASE("the shares of an edge's two sides sum to one, and are all or nothing beside the sides") {
    for (const double angle : {60.0, 80.0, 90.0, 120.0, 145.0}) {
        CAPTURE(angle);
        const EdgeShares<2> shares = edges_of(wedge(angle));
        REQUIRE(shares.edges().size() == 1);
        const SharedEdge<2>& edge = shares.edges()[0];
        if (angle != 90) CHECK(edge.acute == (angle < 90));  // there both ways of saying a and b are the same
        for (const double r : {0.1 * spacing, spacing, 4 * spacing}) {
            double before = 1, steepest = 0;
            constexpr int n = 500;
            for (int k = 0; k <= n; ++k) {
                // From the first side's surface to the other's.
                const double theta = (double(k) / n - 0.5) * angle * degree;
                const Vec2 x = r * Vec2(std::sin(theta), -std::cos(theta));
                const double a = edge.share(0, x), b = edge.share(1, x);
                CHECK(a + b == doctest::Approx(1).epsilon(1e-14));
                CHECK(a <= before + 1e-14);
                steepest = std::max(steepest, k == 0 ? 0.0 : before - a);
                before = a;
            }
            CHECK(edge.share(0, Vec2(0, -r)) == doctest::Approx(0.5));
            CHECK(steepest < 0.02);
        }
        // Far away all beside one side and nothing beside the other; about a half close to the edge.
        const auto beside = [&](double r) {
            return Vec2(-r * std::sin(0.5 * angle * degree), -r * std::cos(0.5 * angle * degree));
        };
        CHECK(edge.share(0, beside(1000 * spacing)) == doctest::Approx(1).epsilon(1e-5));
        CHECK(edge.share(1, beside(1000 * spacing)) < 1e-5);
        CHECK(edge.share(0, beside(0.02 * spacing)) == doctest::Approx(0.5).epsilon(0.05));
    }
}

TEST_CASE("flat walls, concave corners, sharp and thin bodies share nothing") {
    Panels<2> flat = tank(2, 2);
    flat.update_geometry();
    flat.find_joints();
    CHECK(edges_of(flat).edges().empty());
    CHECK(edges_of(wedge(50)).edges().empty());
    CHECK(edges_of(wedge(155)).edges().empty());           // a smooth surface
    for (const double thickness : {0.1, 1.0, 5.0, 7.0}) {  // spacings
        Panels<2> panels;
        add_body(panels, {0, 0}, {thickness * spacing, 2});
        panels.update_geometry();
        panels.find_joints();
        CHECK(edges_of(panels).edges().empty());
    }
    Panels<2> thick;
    add_body(thick, {0, 0}, {8 * spacing, 2});
    thick.update_geometry();
    thick.find_joints();
    CHECK(edges_of(thick).edges().size() == 4);
}

TEST_CASE("as a particle passes a convex edge nobody's support jumps") {
    const Step step(0.15);
    auto points = step.points;
    const auto nearest = std::min_element(points.begin(), points.end(), [](const Point<2>& a, const Point<2>& b) {
        return std::hypot(a[0] - 0.64, a[1] - 0.64) < std::hypot(b[0] - 0.64, b[1] - 0.64);
    });
    // At 0.8 spacings from the edge: over the upper floor, in front of neither side, beside the step. In between its
    // feet leave the two sides, and its image, which has a share of a third there, goes with them.
    for (const double from : {5.0, 95.0, 190.0}) {
        CAPTURE(from);
        std::vector<double> before;
        double largest = 0;
        constexpr int n = 80;
        for (int k = 0; k <= n; ++k) {
            const double theta = (from + 75.0 * k / n) * degree;
            *nearest = {edge.x() + 0.8 * spacing * std::cos(theta), edge.y() + 0.8 * spacing * std::sin(theta)};
            const Driver<2> driver = settle(points, spacing, step.panels);
            const auto& s = driver.fluid.particles;
            std::vector<double> now(s.count, 0);
            for (std::size_t i = 0; i < s.count; ++i)
                if ((position(s, i) - edge).norm() < 3 * spacing)
                    now[std::size_t(s.id[i])] = partition_of_unity(driver.fluid, i);
            for (std::size_t i = 0; i < now.size() && !before.empty(); ++i)
                if (now[i] != 0 && before[i] != 0) largest = std::max(largest, std::fabs(now[i] - before[i]));
            before = now;
        }
        // A step of the particle is 0.013 spacings. By sight alone jumps of 0.046, 0.055 and 0.046.
        CHECK(largest < 0.006);
    }
}

TEST_CASE("what ghosts add behind a convex edge is what the kernel has there in closed form") {
    // Σ W ω over ghosts against 1 - γ = ∫ W behind the walls, of all particles near the edge.
    for (const double jitter : {0.0, 0.1}) {
        CAPTURE(jitter);
        const Step step(jitter);
        const Driver<2> driver = settle(step.points, spacing, step.panels);
        const auto& s = driver.fluid.particles;
        const auto& panels = driver.walls->panels;
        const KernelMass<2> mass(driver.fluid.kernel);
        double largest = 0;
        std::size_t compared = 0;
        for (std::size_t i = 0; i < s.count; ++i) {
            const Vec2 x = position(s, i);
            if ((x - edge).norm() > R) continue;
            double behind = 0, ghosts = 0;
            // Panels of which a particle is behind are seen through: the edge's two sides are one surface.
            for (std::size_t k = 0; k < panels.size(); ++k) {
                if (panels.height(k, x) <= 0) continue;
                behind += missing_mass(mass, {panels.start(k) - x, panels.end(k) - x}, panels.normal[k]);
            }
            // What lies beyond the body, seen past the edge, is water again.
            for (std::size_t k = 0; k < panels.size(); ++k) {
                if (panels.height(k, x) >= 0) continue;
                behind -= missing_mass(mass, {panels.end(k) - x, panels.start(k) - x}, -panels.normal[k]);
            }
            for (const std::size_t j : neighbours_of(driver.fluid, i))
                if (j >= s.ghost_begin()) ghosts += driver.fluid.kernel.value(distance(s, i, j)) * s.volume[j];
            largest = std::max(largest, std::fabs(ghosts - behind));
            ++compared;
        }
        CAPTURE(largest);
        CHECK(compared > 30);
        CHECK(largest < (jitter == 0 ? 0.01 : 0.03));
    }
}

TEST_CASE("a dry side leaves its part to the other") {
    Step step(0.1);
    std::erase_if(step.points, [](const Point<2>& x) { return x[0] < 0.6; });
    const Driver<2> driver = settle(step.points, spacing, step.panels);
    const auto& s = driver.fluid.particles;
    REQUIRE(driver.walls->shares.edges().size() == 1);
    CHECK(driver.walls->shares.of(0, s.ghost_count).size() > 30);
    for (std::size_t g = 0; g < s.ghost_count; ++g)
        CHECK(s.volume[s.ghost_begin() + g] == s.volume[driver.walls->ghosts[g].parent]);
}

TEST_CASE("lists that are made again give the same shares, whatever volume particles have taken in between") {
    Step step(0.1);
    std::size_t k = 0;
    std::erase_if(step.points, [&](const Point<2>& x) { return x[0] < 0.6 && ++k % 5 != 0; });
    Driver<2> driver = settle(step.points, spacing, step.panels);
    auto& s = driver.fluid.particles;
    const auto others = [&] {
        std::vector<double> all;
        for (const auto& share : driver.walls->shares.of(0, s.ghost_count)) all.push_back(share.others);
        return all;
    };
    const std::vector<double> before = others();
    CHECK(std::count_if(before.begin(), before.end(), [](double w) { return w > 0.01 && w < 0.99; }) > 5);
    for (std::size_t i = 0; i < s.count; ++i) s.mass[i] *= s.x[0][i] < 0.6 ? 1.3 : 0.8;
    driver.rebuild();
    CHECK(others() == before);
}
