// What the water sees of a wet surface, and what the body gets in return: the promises of wet_smoothing.hpp.
#include "physics/coupling/wet_smoothing.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

#include "physics/coupling/wet_surface.hpp"
#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using coupling::Vec2;
using coupling::WetSmoothing;
using coupling::WetSurface;

namespace {

std::mt19937 generator(11);

std::vector<Vec2> random_vectors(std::size_t n) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Vec2> values(n);
    for (Vec2& value : values) value = Vec2(uniform(generator), uniform(generator));
    return values;
}

// A chain of vertices, one segment behind the other.
struct Chain {
    std::vector<Vec2> x;
    std::vector<std::array<std::size_t, 2>> segments;
    std::vector<double> length;  // of surface that belongs to each vertex

    explicit Chain(std::vector<Vec2> points, bool closed = false) : x(std::move(points)), length(x.size(), 0.0) {
        for (std::size_t k = 0; k + (closed ? 0 : 1) < x.size(); ++k) segments.push_back({k, (k + 1) % x.size()});
        for (const auto& [a, b] : segments) {
            length[a] += 0.5 * (x[b] - x[a]).norm();
            length[b] += 0.5 * (x[b] - x[a]).norm();
        }
    }
};

// Unevenly spaced along a straight line that is not along an axis.
Chain straight_chain(std::size_t n) {
    std::uniform_real_distribution<double> uniform(0.5, 1.5);
    std::vector<Vec2> points = {Vec2(0.3, -0.1)};
    while (points.size() < n) points.push_back(points.back() + uniform(generator) * Vec2(0.008, 0.006));
    return Chain(points);
}

// Around a rectangle of 0.3 × 0.05.
Chain rectangle() {
    const std::vector<Vec2> corners = {Vec2(0, 0), Vec2(0.3, 0), Vec2(0.3, 0.05), Vec2(0, 0.05)};
    std::vector<Vec2> points;
    for (std::size_t side = 0; side < 4; ++side)
        for (int k = 0; k < 15; ++k)
            points.push_back(corners[side] + k / 15.0 * (corners[(side + 1) % 4] - corners[side]));
    return Chain(points, true);
}

double power(const std::vector<Vec2>& force, const std::vector<Vec2>& velocity) {
    double sum = 0;
    for (std::size_t k = 0; k < force.size(); ++k) sum += force[k].dot(velocity[k]);
    return sum;
}

}  // namespace

TEST_CASE("load and velocity stay conjugate, and force and moment stay what the water exerts") {
    for (const Chain& chain : {straight_chain(60), rectangle()}) {
        const WetSmoothing smoothing(chain.x, chain.segments, 0.02);
        REQUIRE(smoothing.changes());
        const std::size_t n = chain.x.size();
        const auto v = random_vectors(n), force = random_vectors(n);
        std::vector<Vec2> seen(n), nodal(n), x(n), place(n);
        smoothing.smooth(v, seen);
        smoothing.gather(force, nodal);
        CHECK(std::fabs(power(nodal, v) - power(force, seen)) < 1e-12 * double(n));
        double change = 0;
        for (std::size_t k = 0; k < n; ++k) change += (nodal[k] - force[k]).norm();
        CHECK(change > 0.3 * double(n));  // or nothing has been smoothed

        // A body that has turned by 0.7 and moved on, and swings besides: moments about where the water is.
        const Eigen::Rotation2Dd turn(0.7);
        for (std::size_t k = 0; k < n; ++k) x[k] = turn * chain.x[k] + Vec2(2, -1) + 0.01 * v[k];
        smoothing.smooth_positions(x, place);
        Vec2 sum = Vec2::Zero();
        double moment = 0;
        for (std::size_t k = 0; k < n; ++k) {
            sum += nodal[k] - force[k];
            moment += fluid::cross(x[k], nodal[k]) - fluid::cross(place[k], force[k]);
        }
        CHECK(sum.norm() < 1e-12 * double(n));
        CHECK(std::fabs(moment) < 1e-12 * double(n));
    }
}

TEST_CASE("rigid motions pass as they are, and no motion is made larger") {
    for (const Chain& chain : {straight_chain(60), rectangle()}) {
        const std::size_t n = chain.x.size();
        const WetSmoothing smoothing(chain.x, chain.segments, 0.02);
        std::vector<Vec2> rigid(n), seen(n);
        for (std::size_t k = 0; k < n; ++k) rigid[k] = Vec2(0.4, -2) + 3 * Vec2(-chain.x[k].y(), chain.x[k].x());
        smoothing.smooth(rigid, seen);
        for (std::size_t k = 0; k < n; ++k) CHECK((seen[k] - rigid[k]).norm() < 1e-11);
        smoothing.smooth_positions(chain.x, seen);
        for (std::size_t k = 0; k < n; ++k) CHECK((seen[k] - chain.x[k]).norm() < 1e-14);
        for (int trial = 0; trial < 20; ++trial) {
            const auto v = random_vectors(n);
            smoothing.smooth(v, seen);
            double before = 0, after = 0;
            for (std::size_t k = 0; k < n; ++k) {
                before += chain.length[k] * v[k].squaredNorm();
                after += chain.length[k] * seen[k].squaredNorm();
            }
            CHECK(after < before);
        }
    }
}

TEST_CASE("nodal loads of uniform and of linear pressure on one side come out as they went in") {
    const Chain chain = straight_chain(60);
    const WetSmoothing smoothing(chain.x, chain.segments, 0.02);
    const Vec2 normal(-0.6, 0.8);
    for (const double slope : {0.0, 7.0}) {
        std::vector<Vec2> force, nodal(chain.x.size());
        for (std::size_t k = 0; k < chain.x.size(); ++k)
            force.push_back(chain.length[k] * (1 + slope * (chain.x[k] - chain.x[0]).norm()) * normal);
        smoothing.gather(force, nodal);
        for (std::size_t k = 0; k < chain.x.size(); ++k) CHECK((nodal[k] - force[k]).norm() < 1e-12 * force[k].norm());
    }
}

TEST_CASE("a wave along the surface passes with 1/(1 + (κ ℓ)⁴), κ being that of the second difference") {
    const double h = 0.01, length = 0.02;
    std::vector<Vec2> points;
    for (int k = 0; k < 400; ++k) points.emplace_back(h * k, 0.0);
    const Chain chain(points);
    const WetSmoothing smoothing(chain.x, chain.segments, length);
    for (const double waves : {0.02, 0.05, 0.1, 0.25, 0.5}) {  // per node
        std::vector<Vec2> v(points.size()), seen(points.size());
        const double kh = 2 * std::numbers::pi * waves;
        for (std::size_t k = 0; k < v.size(); ++k) v[k] = Vec2(0, std::cos(kh * double(k)));
        smoothing.smooth(v, seen);
        const double kappa = 2 * std::sin(0.5 * kh) / h, expected = 1 / (1 + std::pow(kappa * length, 4));
        for (std::size_t k = 180; k < 220; ++k) CHECK(std::fabs(seen[k].y() - expected * v[k].y()) < 1e-10);
    }
    // The surface's ends do not see that it goes on: without ℓ nothing changes.
    CHECK_FALSE(WetSmoothing(chain.x, chain.segments, 0).changes());
}

TEST_CASE("a wet surface hands out the smoothed motion, and takes loads back by the same weights") {
    const solid::Mesh<2> mesh = solid::box_mesh({1.0, 0.0}, {1.2, 0.9}, 4, 18);
    fluid::Panels<2> panels, plain_panels;
    WetSurface surface(mesh, {"left", "bottom", "right"}, "body", panels, 0.05);
    WetSurface plain(mesh, {"left", "bottom", "right"}, "body", plain_panels);
    const std::size_t n = mesh.nodes.size();
    std::vector<double> x, v;
    const auto random = random_vectors(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
        x.insert(x.end(), {mesh.nodes[k][0] + 0.01 * random[k].x(), mesh.nodes[k][1] + 0.01 * random[k].y()});
        v.insert(v.end(), {random[n + k].x(), random[n + k].y()});
    }
    surface.take(x, v);
    surface.place(panels, 1e-3);
    plain.take(x, v);
    plain.place(plain_panels, 1e-3);
    const auto force = random_vectors(panels.position.size());
    std::vector<double> nodal(2 * n, 5.0);
    surface.to_nodes(force, nodal);
    double given = 0, moment = 0, rough = 0, plain_rough = 0;
    for (std::size_t k = 0; k < n; ++k) {
        given += nodal[2 * k] * v[2 * k] + nodal[2 * k + 1] * v[2 * k + 1];
        const Vec2 at(x[2 * k] + 1e-3 * v[2 * k], x[2 * k + 1] + 1e-3 * v[2 * k + 1]);
        moment += fluid::cross(at, Vec2(nodal[2 * k], nodal[2 * k + 1]));
    }
    for (std::size_t k = 0; k < force.size(); ++k) moment -= fluid::cross(panels.position[k], force[k]);
    for (const auto& panel : panels.panels) {
        const auto a = std::size_t(panel.vertex[0]), b = std::size_t(panel.vertex[1]);
        rough += (panels.velocity[b] - panels.velocity[a]).norm();
        plain_rough += (plain_panels.velocity[b] - plain_panels.velocity[a]).norm();
    }
    CHECK(std::fabs(given - power(force, panels.velocity)) < 1e-11);
    CHECK(std::fabs(moment) < 1e-11);
    CHECK(rough < 0.5 * plain_rough);
}

TEST_CASE("short steps and elements finer than particles do not break the gate") {
    // They failed after 0.8 ms while single nodes met the water; since corners move as their place does, after 1.8 and
    // 8 ms.
    struct Case {
        std::vector<std::string> set;
        double end;
    };
    for (const Case& c : {Case{{"fluid.sound_speed=50", "coupling.algorithm=css"}, 0.0015},
                          Case{{"solid.box.elements=[4,160]", "fluid.cfl=0.1"}, 0.002}}) {
        CAPTURE(c.set.front());
        const auto roughness = [&](const char* smoothing) {
            std::vector<std::string> set = {"fluid.spacing=0.0025", "time.end=" + std::to_string(c.end),
                                            "output.frame_interval=1", "output.history_interval=1e-4", smoothing};
            set.insert(set.end(), c.set.begin(), c.set.end());
            const io::Scene scene =
                io::read_scene(std::filesystem::path(AQUAGRAPH_SOURCE_DIR) / "benchmarks/gate_2d/scene.toml", set);
            const ScratchFolder scratch;
            const ResultsFolder results{scratch / "results"};
            std::ostringstream out, err;
            REQUIRE(engine::run(scene, {.folder = results.path, .trace = {}, .threads = 1, .quiet = true}, out, err) ==
                    engine::success);
            double sum = 0;
            const auto force = results.column("gate_force_x");
            for (std::size_t k = 1; k < force.size(); ++k) sum += std::fabs(force[k] - force[k - 1]);
            return sum;
        };
        CHECK(roughness("coupling.smoothing=0.5") < 0.5 * roughness("coupling.smoothing=0"));
    }
}
