// Contact with rigid ground: tangents against differences, Hertz, bouncing, sliding, rolling; the explicit scheme.
#include "physics/solid/contact.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/solid/facet_tangents.hpp"
#include "tests/solid/wheels.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

Ground<2> floor_at(double y) {
    return {.point = {0, y}, .direction = {0, 1}};
}

// Largest difference between the tangent of a contact and the differences of its forces, over the penalty stiffness.
template <int D>
double tangent_error(const Mesh<D>& mesh, const std::string& surface, const Ground<D>& ground, double friction) {
    Options<D> options;
    options.material.youngs_modulus = 1;
    Contact<D> contact{surface, ground, friction, 50.0};
    GroundContact<D> made(mesh, options, contact);
    const std::size_t size = D * mesh.nodes.size();
    std::vector<double> u(size), matrices(made.matrix_size());
    for (std::size_t f = 0; f < size; ++f) u[f] = 0.02 * std::sin(3.0 * double(f) + 1);
    made.tangents({}, u, made.history(), matrices, serial_loop);
    const TangentError error = facet_tangent_error<D>(
        mesh.surface(surface), matrices, u,
        [&](const auto& moved, auto& forces) { made.add_forces(1, moved, forces, serial_loop); });
    CHECK(error.largest > 0.1);
    return error.worst / error.largest;
}

double total_momentum(const Solver<2>& solver, std::size_t direction) {
    Assembly<2> all(solver.mesh(), soft_rubber<2>());
    std::vector<double> momentum(2 * solver.mesh().nodes.size());
    all.multiply_mass(solver.velocities(), momentum, serial_loop);
    double sum = 0;
    for (std::size_t f = direction; f < momentum.size(); f += 2) sum += momentum[f];
    return sum;
}

void give_velocity(Solver<2>& solver, double vx, double vy) {
    State state;
    solver.save(state);
    for (std::size_t f = 0; f < state.velocities.size(); ++f) state.velocities[f] = f % 2 == 0 ? vx : vy;
    solver.restore(state);
}

// A wheel of three layers: a bonded one, one of spokes with cavities between them, a tread. Surface cavities.
Mesh<2> wheel(int spokes) {
    const int around = 4 * spokes;
    Mesh<2> full = ring(0.15, 0.3, around, 3), mesh;
    std::vector<bool> used(full.nodes.size(), false);
    std::vector<Element> kept;
    for (const Element& element : full.elements) {
        double x = 0, y = 0;
        for (std::size_t a = 0; a < 4; ++a) {
            x += full.nodes[std::size_t(element[a])][0] / 4;
            y += full.nodes[std::size_t(element[a])][1] / 4;
        }
        const double r = std::hypot(x, y), sector = (std::atan2(y, x) + M_PI) / (2 * M_PI) * around;
        if (r > 0.2 && r < 0.25 && int(sector) % 4 != 0) continue;
        kept.push_back(element);
        for (const NodeIndex node : element) used[std::size_t(node)] = true;
    }
    std::vector<NodeIndex> index(full.nodes.size(), -1);
    for (std::size_t n = 0; n < full.nodes.size(); ++n)
        if (used[n]) {
            index[n] = NodeIndex(mesh.nodes.size());
            mesh.nodes.push_back(full.nodes[n]);
        }
    for (Element element : kept) {
        for (NodeIndex& node : element) node = index[std::size_t(node)];
        mesh.elements.push_back(element);
    }
    for (const auto& [name, set] : full.node_sets)
        for (const NodeIndex node : set) mesh.node_sets[name].push_back(index[std::size_t(node)]);
    for (const Facet& facet : boundary_facets(mesh)) {
        const auto& X = mesh.nodes[std::size_t(facet[0])];
        const double r = std::hypot(X[0], X[1]);
        mesh.surfaces[r > 0.299 ? "outer" : r < 0.151 ? "inner" : "cavities"].push_back(facet);
    }
    return mesh;
}

}  // namespace

TEST_CASE("tangents of contact against differences: plane, cylinder, sphere, inside and outside, sticking") {
    const Mesh<2> plane = box_mesh({0, 0}, {1, 0.5}, 2, 1);
    const Ground<2> hill{.shape = GroundShape::cylinder, .point = {0.4, -0.9}, .radius = 1},
        bowl{.shape = GroundShape::cylinder, .point = {0.4, 0.85}, .radius = 0.8, .hollow = true};
    CHECK(tangent_error<2>(plane, "bottom", floor_at(0.1), 0) < 1e-6);
    CHECK(tangent_error<2>(plane, "bottom", floor_at(0.1), 1e6) < 1e-6);
    CHECK(tangent_error<2>(plane, "bottom", hill, 0) < 1e-6);
    CHECK(tangent_error<2>(without_mid_side_nodes(plane), "bottom", bowl, 0) < 1e-6);
    const Mesh<3> solid = box_mesh({0, 0, 0}, {1, 1, 0.5}, {2, 1, 1});
    const Ground<3> ball{.shape = GroundShape::sphere, .point = {0.4, 0.4, -0.9}, .radius = 1.0},
        roll{.shape = GroundShape::cylinder, .point = {0.4, 0, -0.9}, .direction = {0.1, 2, 0}, .radius = 1},
        slope{.point = {0, 0, 0.2}, .direction = {0.1, 0.2, 3}};
    for (const Mesh<3>& mesh : {solid, without_mid_side_nodes(solid)}) {
        CHECK(tangent_error<3>(mesh, "bottom", ball, 0) < 1e-6);
        CHECK(tangent_error<3>(mesh, "bottom", roll, 0) < 1e-6);
        CHECK(tangent_error<3>(mesh, "bottom", slope, 1e6) < 1e-6);
    }
}

TEST_CASE("Hertz: a cylinder on a plane, half-width and pressures") {
    // A quarter ring lying on its right: x is up to the ground at x = R. Its inside is pushed by δ.
    const double R = 0.1, E = 1e6, nu = 0.3, E_star = E / (1 - nu * nu);
    const Mesh<2> mesh = quarter_ring(0.4 * R, R, 14, 40, 2, 2.5);
    Options<2> options = soft_rubber<2>();
    options.material.law = MaterialLaw::linear;
    options.clamps = {{"bottom", {false, true}}};
    options.motions = {{"left", {TimeFunction::constant(3e-4), {}}}};
    options.contacts = {{.surface = "right", .ground = {.point = {R, 0}, .direction = {-1, 0}}}};
    Solver<2> solver(mesh, options);
    solver.solve_static(no_load(mesh), serial_loop);
    const auto contact = solver.contact(0);
    const double P = 2 * solver.reaction("left")[0];  // per thickness, of both halves
    CHECK(contact.force[0] == doctest::Approx(-P / 2).epsilon(1e-5));
    const double a = std::sqrt(4 * P * R / (M_PI * E_star)), p0 = std::sqrt(P * E_star / (M_PI * R));
    MESSAGE("Hertz: a/R ", a / R, ", half-width ", contact.area / a, ", largest pressure ",
            contact.largest_pressure / p0, " of theory, points ", contact.points.size());
    CHECK(a / R > 0.03);
    CHECK(contact.area == doctest::Approx(a).epsilon(0.03));
    CHECK(contact.largest_pressure == doctest::Approx(p0).epsilon(0.02));
    for (const auto& point : contact.points)
        if (point.position[1] < 0.8 * a)
            CHECK(point.pressure ==
                  doctest::Approx(p0 * std::sqrt(1 - std::pow(point.position[1] / a, 2))).epsilon(0.04));
}

TEST_CASE("a ball dropped on the ground: impulse and energy, implicit and explicit alike") {
    const Mesh<2> ball = ring(0.02, 0.1, 32, 4);
    double rebound[2];
    for (const Scheme scheme : {Scheme::hht, Scheme::central_difference}) {
        Options<2> options = soft_rubber<2>();
        options.scheme = scheme;
        options.alpha = -0.05;
        options.contacts = {{.surface = "outer", .ground = floor_at(-0.101)}};
        Solver<2> solver(ball, options);
        give_velocity(solver, 0.3, -1);
        const bool is_explicit = scheme == Scheme::central_difference;
        double dt = 2e-4;
        if (is_explicit) {
            dt = solver.largest_stable_step();
            CHECK(dt > 1e-6);
            CHECK(dt < 2e-4);
        }
        const int steps = int(0.035 / dt);
        const double before = total_momentum(solver, 1), along = total_momentum(solver, 0);
        double impulse = 0, force = 0;
        const double error = imbalance<2>(solver, steps, [&](int) {
            solver.advance(dt, no_load(ball), serial_loop);
            const double now = solver.contact(0).force[1];
            impulse += 0.5 * dt * (force + now);
            force = now;
        });
        const Energies e = solver.energies();
        MESSAGE("ball: energy error ", error, ", rebound ", total_momentum(solver, 1) / before, ", lost ", e.numerical,
                " of ", e.kinetic + e.strain, ", steps ", steps);
        CHECK(force == 0);
        CHECK(total_momentum(solver, 1) - before == doctest::Approx(impulse).epsilon(0.01));
        CHECK(total_momentum(solver, 0) == doctest::Approx(along).epsilon(1e-6));
        CHECK(error < 0.01);
        rebound[is_explicit] = total_momentum(solver, 1) / before;
        CHECK(rebound[is_explicit] < -0.7);
    }
    CHECK(rebound[0] == doctest::Approx(rebound[1]).epsilon(0.01));
}

TEST_CASE("a block slides to a stop as Coulomb says") {
    const Mesh<2> block = box_mesh({0, 0}, {0.1, 0.04}, 6, 3);
    Options<2> options = soft_rubber<2>();
    options.alpha = -0.1;
    options.gravity = {0, -9.81};
    // It begins at rest on the ground, which touches it at first: nothing else carries it.
    options.contacts = {{.surface = "bottom", .ground = floor_at(1e-7), .friction = 0.3}};
    options.clamps = {{"left", {true, false}}};
    Solver<2> resting(block, options);
    resting.solve_static(no_load(block), serial_loop);
    State state;
    resting.save(state);
    options.clamps.clear();
    Solver<2> solver(block, options);
    solver.restore(state);
    give_velocity(solver, 0.5, 0);
    const double m = solver.mass(), distance = 0.5 * 0.5 / (2 * 0.3 * 9.81);
    const double error = imbalance<2>(solver, 500, [&](int) { solver.advance(5e-4, no_load(block), serial_loop); });
    const double travel = solver.displacements()[2 * nearest_node(block, 0.05, 0.04)];
    const Energies e = solver.energies();
    MESSAGE("slide: travel ", travel / distance, " of theory, dissipated ", e.friction / (0.125 * m), ", energy error ",
            error);
    CHECK(travel == doctest::Approx(distance).epsilon(0.03));
    CHECK(e.friction == doctest::Approx(0.5 * m * 0.25).epsilon(0.05));
    CHECK(std::abs(total_momentum(solver, 0)) < 0.02 * m * 0.5);
    CHECK(error < 0.02);
    CHECK(solver.contact(0).force[1] == doctest::Approx(m * 9.81).epsilon(0.05));
}

TEST_CASE("an inflated wheel is pressed on the ground and rolls one turn; a restart in between changes no bit") {
    const Mesh<2> mesh = wheel(16);
    check(mesh);
    Options<2> options = soft_rubber<2>();
    options.alpha = -0.1;
    const double depth = 0.02, V = 1, R = 0.31;  // the ground is 1 cm away: the wheel grows when it is inflated
    // Times before 0 are static: inflated at -2, pressed at -1.
    options.pressures = {{"cavities", TimeFunction::constant(2e4)}};
    options.contacts = {{.surface = "outer", .ground = floor_at(-R), .friction = 0.8}};
    options.rigid_bodies = {{.set = "inner",
                             .motion = {{law(ConstantRate{V, {0.2}}),
                                         TimeFunction::table({-2, -1, 0, 1}, {0, -depth, -depth, -depth}),
                                         {}}},
                             .mass = 1,
                             .inertia = {0.01}}};
    options.rigid_bodies[0].motion[2] = TimeFunction{};  // held while it is pressed
    Solver<2> pressed(mesh, options);
    pressed.set_time(-2);
    pressed.solve_static(no_load(mesh), serial_loop);
    CHECK(pressed.contact(0).force[1] == doctest::Approx(0));
    pressed.set_time(0);
    pressed.solve_static(no_load(mesh), serial_loop);
    const double load = pressed.contact(0).force[1];
    CHECK(load > 10);
    CHECK(pressed.rigid_body(0).reaction[1] == doctest::Approx(-load).epsilon(1e-4));
    State state;
    pressed.save(state);
    options.rigid_bodies[0].motion[2].reset();  // then free to roll
    Solver<2> solver(mesh, options), twin(mesh, options);
    solver.restore(state);
    const double dt = 2.5e-3, turn = 2 * M_PI * R / V + 0.2;
    const int steps = int(turn / dt);
    double least = 1e300, most = 0, mean = 0;
    int counted = 0;
    const double error = imbalance<2>(solver, steps, [&](int k) {
        if (k == 100) {
            solver.save(state);
            twin.restore(state);
        }
        solver.advance(dt, no_load(mesh), serial_loop);
        if (k >= 100 && k < 120) {
            twin.advance(dt, no_load(mesh), BlockLoop(ThreadedLoop{3}));
            CHECK(copy(twin.displacements()) == copy(solver.displacements()));
            CHECK(twin.energies().friction == solver.energies().friction);
        }
        if (k < steps / 2) return;
        const double now = solver.contact(0).force[1];
        least = std::min(least, now);
        most = std::max(most, now);
        mean += now;
        ++counted;
    });
    mean /= counted;
    const auto rim = solver.rigid_body(0);
    const double rolling_radius = -(rim.displacement[0]) / rim.displacement[2];
    const Energies e = solver.energies();
    MESSAGE("wheel: load ", load, " N pressed, ", least, " … ", most, " mean ", mean, " rolling; radius ",
            rolling_radius, "; energy error ", error, "; friction ", e.friction, " numerical ", e.numerical, " work ",
            e.external_work, " iterations ", solver.statistics().newton_iterations, " factorisations ",
            solver.statistics().factorisations);
    CHECK(rim.displacement[0] == doctest::Approx(V * (steps * dt - 0.1)).epsilon(1e-9));
    CHECK(rolling_radius > R - depth);
    CHECK(rolling_radius < R);
    CHECK(most - least < 0.1 * mean);
    CHECK(error < 0.02);
}

TEST_CASE("the explicit scheme agrees with the implicit one, and its largest step is close to where it breaks") {
    const Mesh<2> mesh = box_mesh({0, 0}, {0.1, 0.02}, 10, 2);
    Options<2> options = soft_rubber<2>();
    options.clamps = {{"left", {true, true}}};
    options.alpha = 0;
    Solver<2> implicit(mesh, options);
    options.scheme = Scheme::central_difference;
    Solver<2> explicit_one(mesh, options), beyond(mesh, options);
    const double dt = explicit_one.largest_stable_step(), end = 0.03;
    const auto load = traction(mesh, "top", {0, -300});
    const int steps = int(end / dt) + 1;
    const double error =
        imbalance<2>(explicit_one, steps, [&](int) { explicit_one.advance(end / steps, load, serial_loop); });
    for (int k = 0; k < 300; ++k) implicit.advance(end / 300, load, serial_loop);
    const std::size_t tip = 2 * nearest_node(mesh, 0.1, 0.01) + 1;
    CHECK(std::abs(implicit.displacements()[tip]) > 0.002);
    CHECK(explicit_one.displacements()[tip] == doctest::Approx(implicit.displacements()[tip]).epsilon(0.01));
    CHECK(error < 5e-3);
    CHECK(explicit_one.statistics().factorisations == 0);
    // Beyond the limit by a tenth, rounding grows until it fails.
    bool failed = false;
    for (int k = 0; k < 5000 && !failed; ++k) try {
            beyond.advance(dt / 0.9 * 1.1, load, serial_loop);
        } catch (const ConvergenceError&) {
            failed = true;
        }
    CHECK(failed);
    CHECK(implicit.largest_stable_step() == std::numeric_limits<double>::infinity());
}

TEST_CASE("lumped masses are positive and sum up to the mass") {
    const Mesh<3> mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    Options<3> options;
    options.material.youngs_modulus = 1;
    options.material.density = 5;
    const Assembly<3> assembly(mesh, options);
    double sum = 0;
    for (const double m : assembly.lumped_masses()) {
        CHECK(m > 0);
        sum += m;
    }
    CHECK(sum == doctest::Approx(5));
}

TEST_CASE("bad ground and bad contacts are refused") {
    const Mesh<2> mesh = box_mesh({0, 0}, {0.1, 0.02}, 2, 1);
    const auto refused = [&](const char* part, const Contact<2>& contact) {
        Options<2> options = soft_rubber<2>();
        options.contacts = {contact};
        CHECK_THROWS_WITH_AS(Solver<2>(mesh, options), doctest::Contains(part), std::invalid_argument);
    };
    refused("it has: bottom", {.surface = "roof", .ground = floor_at(0)});
    refused("direction", {.surface = "bottom", .ground = {}});
    refused("radius", {.surface = "bottom", .ground = {.shape = GroundShape::cylinder}});
    refused("friction", {.surface = "bottom", .ground = floor_at(0), .friction = -1});
    refused("penalty", {.surface = "bottom", .ground = floor_at(0), .penalty = 0.0});
}
