// Lists that are kept because water moves together hold every pair that a double loop finds, to the end of the step,
// and are kept longer than the largest displacement allows.
#include "physics/fluid/relative_travel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

template <int D>
double distance2(const Particles<D>& s, std::size_t i, std::size_t j) {
    double r2 = 0;
    for (std::size_t d = 0; d < D; ++d) r2 += (s.x[d][i] - s.x[d][j]) * (s.x[d][i] - s.x[d][j]);
    return r2;
}

template <int D>
bool listed(const NeighbourLists<D>& lists, std::size_t i, std::size_t j) {
    const std::size_t block = i / (clusters_per_block * W), local = i % (clusters_per_block * W);
    const NeighbourBlock& list = lists.blocks[block];
    for (auto k = list.particle[local].open_end; k < list.particle[local + 1].open_end; ++k)
        if (list.open[k] == j / W) return true;
    return false;
}

// Pairs of fluid particles closer than R that the lists lack.
template <int D>
std::size_t missing(const Fluid<D>& fluid) {
    const auto& s = fluid.particles;
    const double radius2 = fluid.lists.radius * fluid.lists.radius;
    std::size_t n = 0;
    for (std::size_t i = 0; i < s.count; ++i)
        for (std::size_t j = 0; j < s.count; ++j)
            n += i != j && distance2(s, i, j) < radius2 && !listed(fluid.lists, i, j);
    return n;
}

template <int D>
Travel most_travelled(const Fluid<D>& fluid) {
    Travel most;
    for (std::size_t block = 0; block < fluid.blocks(); ++block)
        most = largest(most, travel(fluid.particles, fluid.lanes(block)));
    return most;
}

// What ways there are to move: velocity by place and time, known beforehand, plus noise.
template <int D>
struct Motion {
    std::string name;
    std::function<void(const Point<D>& x, double time, Point<D>& v)> velocity;
    double gain;  // steps between rebuilds, at least so many times those that the largest displacement allows
};

template <int D>
void check_motion(const Motion<D>& motion, const std::vector<Point<D>>& points, double spacing) {
    CAPTURE(D);
    CAPTURE(motion.name);
    const GhostWalls<D>* no_walls = nullptr;
    Random random(5);
    Fluid<D> fluid = make_fluid<D>(spacing, water);
    fluid.particles = place<D>(points, spacing);
    const double dt = 0.04 * fluid.lists.radius;  // a way of 0.04 R at a speed of 1
    auto& s = fluid.particles;
    long by_largest = 0;
    double gone = 1e9;  // since a rebuild by the largest displacement
    std::size_t kept = 0, lacking = 0;
    rebuild_lists(fluid, static_cast<GhostWalls<D>*>(nullptr), serial_loop);
    const int steps = 60;
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < s.count; ++i) {
            Point<D> x, v{}, later{};
            for (std::size_t d = 0; d < D; ++d) x[d] = s.x[d][i];
            motion.velocity(x, step * dt, v);
            motion.velocity(x, (step + 1) * dt, later);
            for (std::size_t d = 0; d < D; ++d) {
                s.v[d][i] = v[d] + 0.02 * random();
                s.acceleration[d][i] = (later[d] - v[d]) / dt + 1e-3;
            }
        }
        const Travel most = most_travelled(fluid);
        if (gone + most.of_step(dt) >= 0.5 * fluid.lists.skin) {
            ++by_largest;
            gone = 0;
        }
        gone += dt * std::sqrt(most.speed2);
        const bool holds = lists_hold(fluid, no_walls, most, {dt, 0}, serial_loop);
        if (!holds) rebuild_lists(fluid, static_cast<GhostWalls<D>*>(nullptr), serial_loop);
        kept += holds;
        if (step % 3 == 0) lacking += missing(fluid);
        for (std::size_t i = 0; i < s.count; ++i)
            for (std::size_t d = 0; d < D; ++d) s.x[d][i] += dt * s.v[d][i] + 0.5 * dt * dt * s.acceleration[d][i];
        lacking += missing(fluid);  // at the end of the step, with the lists that it was made with
    }
    CHECK(lacking == 0);
    CHECK(kept > 0);
    CAPTURE(by_largest);
    CAPTURE(fluid.rebuilds);
    CHECK(static_cast<double>(fluid.rebuilds) * motion.gain <= static_cast<double>(by_largest));
}

template <int D>
void check_motions() {
    Random random;
    const double spacing = 0.05;
    std::array<int, D> cells;
    cells.fill(D == 2 ? 30 : 10);
    const auto block = lattice<D>(cells, spacing, 0.2, random);
    const double size = cells[0] * spacing;
    check_motion<D>({"a stream",
                     [](const auto&, double, auto& v) {
                         v = {1, 0.5};
                     },
                     D == 2 ? 4.0 : 1.6},
                    block, spacing);
    check_motion<D>({"a shear",
                     [&](const auto& x, double, auto& v) {
                         v = {0.5 + x[D - 1] / size, 0.2};
                     },
                     D == 2 ? 2.5 : 1.2},
                    block, spacing);
    // Two blocks that meet, and pass through each other, for nothing pushes them.
    auto two = block;
    for (auto x : block) {
        x[0] += 1.3 * size;
        two.push_back(x);
    }
    check_motion<D>({"two blocks that meet",
                     [&](const auto& x, double time, auto& v) {
                         v = {0.0};
                         v[0] = x[0] - 0.5 * time < 1.15 * size ? 0.8 : -0.6;
                     },
                     1.0},
                    two, spacing);
    // Spray: particles far from each other, each on its own way.
    std::vector<Point<D>> spray;
    for (int k = 0; k < 300; ++k) {
        Point<D> x;
        for (double& component : x) component = 12 * size * random();
        spray.push_back(x);
    }
    check_motion<D>({"spray",
                     [](const auto& x, double, auto& v) {
                         for (std::size_t d = 0; d < D; ++d) v[d] = std::sin(37 * x[(d + 1) % D]);
                     },
                     1.0},
                    spray, spacing);
}

}  // namespace

TEST_CASE("lists of water that moves together are kept, and lack no pair") {
    check_motions<2>();
    check_motions<3>();
}

// A drop falls onto a floor that it was far from when its lists were made, and a tank sloshes: with lists as they are
// kept the water does what it does with lists made anew in every step, but for the order of sums.
TEST_CASE("water near walls does the same with kept lists as with new ones") {
    for (const double height : {0.1, 0.5}) {
        CAPTURE(height);
        std::vector<std::vector<double>> states;
        std::vector<long> rebuilds;
        for (const bool always : {false, true}) {
            Random random(7);
            const double spacing = 0.05;
            Fluid<2> fluid = make_fluid<2>(spacing, water, {.gravity = {0, -9.81, 0}});
            auto points = lattice<2>({12, 10}, spacing, 0.05, random);
            for (auto& x : points) x[1] += height;
            fluid.particles = place<2>(points, spacing);
            for (std::size_t i = 0; i < fluid.particles.count; ++i) {
                fluid.particles.v[0][i] = 0.7;
                fluid.particles.v[1][i] = -2;
            }
            Driver<2> driver(std::move(fluid));
            driver.walls.emplace();
            driver.walls->panels.add_wall("floor", {Vec2(-1, 0), Vec2(4, 0)}, false, false);
            driver.walls->panels.find_joints();
            driver.rebuild();
            driver.rates(0);
            for (int step = 0; step < 110; ++step) {
                if (always) driver.rebuild();
                driver.step(0.0015);
            }
            states.push_back(state_by_id(driver.fluid.particles));
            rebuilds.push_back(driver.fluid.rebuilds);
        }
        double difference = 0;
        for (std::size_t k = 0; k < states[0].size(); ++k)
            difference = std::max(difference, std::fabs(states[0][k] - states[1][k]));
        CAPTURE(rebuilds[0]);
        CHECK(2 * rebuilds[0] < rebuilds[1]);
        CHECK(difference < 1e-7);
    }
}

// A stream that nothing but a wall could disturb: particles near it keep the rule of half the skin, those further away
// must not have come within reach of it.
TEST_CASE("a wall nearby ends what lists of a stream allow") {
    Random random;
    const double spacing = 0.05;
    Fluid<2> fluid = make_fluid<2>(spacing, water);
    fluid.particles = place<2>(lattice<2>({20, 20}, spacing, 0.1, random), spacing);
    rebuild_lists(fluid, static_cast<GhostWalls<2>*>(nullptr), serial_loop);
    auto& s = fluid.particles;
    const double skin = fluid.lists.skin;
    for (std::size_t i = 0; i < s.count; ++i) s.acceleration[0][i] = 1e-6;
    const auto holds = [&](double moved, double walls_moved, std::size_t near, std::size_t arriving) {
        for (std::size_t i = 0; i < s.count; ++i) s.x[0][i] = s.x_built[0][i] + moved;
        fluid.relative_travel.lists_are_new();
        const auto was_near = [&](std::size_t i) { return i == near; };
        const auto may_be_near = [&](std::size_t i) { return i == arriving; };
        const NearWalls walls{was_near, may_be_near};
        return fluid.relative_travel.holds(s, fluid.search.grid(), fluid.lists, most_travelled(fluid),
                                           {1e-3, walls_moved}, &walls, serial_loop);
    };
    const std::size_t nobody = s.count;
    CHECK(holds(2 * skin, 0, nobody, nobody));
    CHECK(holds(0.45 * skin, 0, 7, nobody));
    CHECK_FALSE(holds(0.55 * skin, 0, 7, nobody));
    CHECK_FALSE(holds(0.45 * skin, 0.1 * skin, 7, nobody));
    CHECK(holds(0.95 * skin, 0, nobody, 7));
    CHECK_FALSE(holds(1.05 * skin, 0, nobody, 7));
    CHECK_FALSE(holds(0.95 * skin, 0.1 * skin, nobody, 7));
    CHECK_FALSE(holds(2 * skin, 1.1 * skin, nobody, nobody));  // the wall may have come to them
    CHECK_FALSE(holds(2.6 * skin, 0, nobody, nobody));         // and others from outside
}
