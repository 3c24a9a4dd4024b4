// The wet surface as walls of the fluid: which side the water is on, motion between exchanges, forces back to nodes.
#include "physics/coupling/wet_surface.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using namespace aquagraph;
using coupling::Vec2;
using coupling::WetSurface;

namespace {

// A body beside a rigid wall whose vertices come first: nothing of the wall may move or be loaded.
struct BesideWall {
    solid::Mesh<2> mesh = solid::box_mesh({1.0, 0.0}, {1.2, 0.9}, 2, 3);
    fluid::Panels<2> panels;
    WetSurface surface;

    explicit BesideWall(const std::vector<std::string>& wet = {"left", "bottom", "right", "top"}) {
        panels.add_wall("floor", {Vec2(0, -1), Vec2(3, -1)}, false, false);
        surface = WetSurface(mesh, wet, "body", panels);
        panels.update_geometry();
    }
};

bool in_body(const Vec2& x) {
    return x.x() > 1.0 && x.x() < 1.2 && x.y() > 0.0 && x.y() < 0.9;
}

std::vector<double> random_values(std::size_t n, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<double> values(n);
    for (double& value : values) value = uniform(generator);
    return values;
}

}  // namespace

TEST_CASE("the wet surface has the water outside of the body") {
    const BesideWall scene;
    // Two panels per edge: 2 (2 + 3) edges.
    REQUIRE(scene.panels.panels.size() == 1 + 20);
    CHECK(scene.surface.vertices() == 20);  // closed: as many vertices as panels, corners shared
    CHECK(scene.surface.wall() == 1);
    double perimeter = 0;
    for (std::size_t k = 1; k < scene.panels.panels.size(); ++k) {
        CAPTURE(k);
        CHECK(scene.panels.panels[k].wet);
        CHECK(scene.panels.name(k) == "body");
        const Vec2 middle = 0.5 * (scene.panels.start(k) + scene.panels.end(k));
        CHECK_FALSE(in_body(middle + 1e-3 * scene.panels.normal[k]));
        CHECK(in_body(middle - 1e-3 * scene.panels.normal[k]));
        perimeter += scene.panels.measure[k];
    }
    CHECK(perimeter == doctest::Approx(2 * (0.2 + 0.9)).epsilon(1e-12));
    CHECK_FALSE(scene.panels.panels[0].wet);
}

TEST_CASE("neighbouring panels of one surface share their vertex") {
    const BesideWall scene({"left"});
    REQUIRE(scene.panels.panels.size() == 1 + 6);
    CHECK(scene.surface.vertices() == 7);
    int joints = 0;
    for (const auto& a : scene.panels.panels)
        for (const auto& b : scene.panels.panels) joints += a.vertex[1] == b.vertex[0];
    CHECK(joints == 5);
}

TEST_CASE("an unknown surface is refused with the names that exist") {
    fluid::Panels<2> panels;
    const solid::Mesh<2> mesh = solid::box_mesh({0, 0}, {1, 1}, 1, 1);
    CHECK_THROWS_WITH_AS(WetSurface(mesh, {"front"}, "body", panels), doctest::Contains("left"), std::invalid_argument);
}

TEST_CASE("between exchanges wet nodes move with x + l Δt v, never frozen") {
    BesideWall scene;
    const std::size_t n = scene.mesh.nodes.size();
    std::vector<double> x = random_values(2 * n, 1), v = random_values(2 * n, 2);
    scene.surface.take(x, v);
    const std::vector<Vec2> before = scene.panels.position;
    // Which node a vertex stands for: found from the reference positions.
    std::vector<std::size_t> node(before.size());
    for (std::size_t k = 2; k < before.size(); ++k)
        for (std::size_t m = 0; m < n; ++m)
            if (before[k] == Vec2(scene.mesh.nodes[m][0], scene.mesh.nodes[m][1])) node[k] = m;

    for (const double ahead : {0.0, 0.5e-3, 1e-3, 7e-3}) {
        CAPTURE(ahead);
        scene.surface.place(scene.panels, ahead);
        for (std::size_t k = 2; k < before.size(); ++k) {
            const Vec2 at(x[2 * node[k]], x[2 * node[k] + 1]), speed(v[2 * node[k]], v[2 * node[k] + 1]);
            // To the bit: the extrapolation starts anew from the exchange each time and gathers no rounding.
            CHECK(scene.panels.position[k] == Vec2(at + ahead * speed));
            CHECK(scene.panels.velocity[k] == speed);
        }
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK(scene.panels.position[k] == before[k]);
            CHECK(scene.panels.velocity[k] == Vec2(Vec2::Zero()));
        }
    }
    // How far the nodes will be from where they stand, found from the places themselves.
    scene.surface.place(scene.panels, 7e-3);
    double furthest = 0;
    for (std::size_t k = 2; k < before.size(); ++k)
        furthest = std::max(furthest, (scene.panels.position[k] - before[k]).norm());
    CHECK(scene.surface.largest_distance(before, 7e-3) == doctest::Approx(furthest).epsilon(1e-15));
}

TEST_CASE("extrapolations are exact for the motion they assume, and none stands still") {
    // x = x0 + v t + ½ a t², taken at t = 0 and at t = 0.1, looked at 0.05 later.
    BesideWall scene;
    const std::size_t n = scene.mesh.nodes.size();
    const std::vector<double> x0 = random_values(2 * n, 1), v0 = random_values(2 * n, 2), a = random_values(2 * n, 3);
    const auto at = [&](double t, double t_a) {
        std::vector<double> x(2 * n), v(2 * n);
        for (std::size_t k = 0; k < 2 * n; ++k) {
            x[k] = x0[k] + v0[k] * t + 0.5 * a[k] * t_a * t;
            v[k] = v0[k] + a[k] * t_a;
        }
        return std::pair{x, v};
    };
    struct Case {
        coupling::Extrapolation extrapolation;
        double position_error, velocity_error;  // per unit of a
    };
    const double cycle = 0.1, ahead = 0.05;
    for (const Case& c : {Case{coupling::Extrapolation::linear, 0.5 * ahead * ahead, ahead},
                          Case{coupling::Extrapolation::quadratic, 0, 0}}) {
        scene.surface.extrapolation = c.extrapolation;
        scene.surface.motion.known = false;
        const auto [x_0, v_0] = at(0, 0);
        const auto [x_1, v_1] = at(cycle, cycle);
        scene.surface.take(x_0, v_0);
        scene.surface.take(x_1, v_1, cycle);
        scene.surface.place(scene.panels, ahead);
        const auto [x, v] = at(cycle + ahead, cycle + ahead);
        std::vector<double> taken(2 * n, 0.0);
        for (std::size_t k = 2; k < scene.panels.position.size(); ++k)
            for (std::size_t m = 0; m < n; ++m) {
                const Vec2 now(x_1[2 * m], x_1[2 * m + 1]), acceleration(a[2 * m], a[2 * m + 1]);
                scene.surface.place(scene.panels, 0);
                if (scene.panels.position[k] != now) continue;
                scene.surface.place(scene.panels, ahead);
                const Vec2 position = scene.panels.position[k] - Vec2(x[2 * m], x[2 * m + 1]),
                           velocity = scene.panels.velocity[k] - Vec2(v[2 * m], v[2 * m + 1]);
                CHECK((position + c.position_error * acceleration).norm() < 1e-14);
                CHECK((velocity + c.velocity_error * acceleration).norm() < 1e-14);
                taken[m] = 1;
            }
        CHECK(std::count(taken.begin(), taken.end(), 1.0) == 20);
    }
    scene.surface.extrapolation = coupling::Extrapolation::none;
    scene.surface.place(scene.panels, 0);
    const std::vector<Vec2> still = scene.panels.position;
    scene.surface.place(scene.panels, 1.0);
    CHECK(scene.panels.position == still);
}

TEST_CASE("an iterated cycle moves from the last exchange to the guess, places and velocities at both ends") {
    BesideWall scene;
    const std::size_t n = scene.mesh.nodes.size();
    const double cycle = 0.02;
    const std::vector<double> x = random_values(2 * n, 1), v = random_values(2 * n, 2), x1 = random_values(2 * n, 3),
                              v1 = random_values(2 * n, 4);
    scene.surface.take(x, v);
    scene.surface.place(scene.panels, 0);
    const std::vector<Vec2> start = scene.panels.position, start_velocity = scene.panels.velocity;
    std::vector<double> y, back;
    scene.surface.state_of(x1, v1, y, cycle);
    scene.surface.head_for(y, cycle);
    scene.surface.place(scene.panels, 0);
    CHECK(scene.panels.position == start);
    for (std::size_t k = 2; k < start.size(); ++k) CHECK((scene.panels.velocity[k] - start_velocity[k]).norm() < 1e-12);
    scene.surface.place(scene.panels, cycle);
    scene.surface.extrapolated(back, cycle);
    REQUIRE(back.size() == y.size());
    for (std::size_t k = 0; k < y.size(); ++k) CHECK(back[k] == doctest::Approx(y[k]).epsilon(1e-12));
    // In between the velocity is that of the places.
    const double t = 0.3 * cycle, h = 1e-6 * cycle;
    scene.surface.place(scene.panels, t + h);
    const std::vector<Vec2> later = scene.panels.position;
    scene.surface.place(scene.panels, t - h);
    const std::vector<Vec2> earlier = scene.panels.position;
    scene.surface.place(scene.panels, t);
    for (std::size_t k = 2; k < start.size(); ++k)
        CHECK(((later[k] - earlier[k]) / (2 * h) - scene.panels.velocity[k]).norm() <
              1e-6 * (1 + scene.panels.velocity[k].norm()));
    scene.surface.take(x1, v1, cycle);  // the cycle is over
    scene.surface.place(scene.panels, 0.5 * cycle);
    for (std::size_t k = 2; k < start.size(); ++k) CHECK((scene.panels.position[k] - later[k]).norm() > 0);
}

TEST_CASE("forces handed to nodes keep their sum and their moment") {
    BesideWall scene;
    const std::vector<double> f = random_values(2 * scene.panels.position.size(), 3);
    std::vector<Vec2> forces;
    for (std::size_t k = 0; k < f.size(); k += 2) forces.emplace_back(f[k], f[k + 1]);
    std::vector<double> nodal(2 * scene.mesh.nodes.size(), 17.0);  // what was there is cleared
    scene.surface.to_nodes(forces, nodal);

    for (const Vec2& about : {Vec2(0, 0), Vec2(1.1, 0.4), Vec2(-30, 8)}) {
        Vec2 sum = Vec2::Zero(), nodal_sum = Vec2::Zero();
        double moment = 0, nodal_moment = 0;
        for (std::size_t k = 2; k < forces.size(); ++k) {  // 0 and 1 belong to the rigid floor
            sum += forces[k];
            moment += fluid::cross(scene.panels.position[k] - about, forces[k]);
        }
        for (std::size_t m = 0; m < scene.mesh.nodes.size(); ++m) {
            const Vec2 force(nodal[2 * m], nodal[2 * m + 1]);
            nodal_sum += force;
            nodal_moment += fluid::cross(Vec2(scene.mesh.nodes[m][0], scene.mesh.nodes[m][1]) - about, force);
        }
        CHECK((sum - nodal_sum).norm() < 1e-13);
        CHECK(std::fabs(moment - nodal_moment) < 1e-12 * (1 + about.norm()));
    }
}
