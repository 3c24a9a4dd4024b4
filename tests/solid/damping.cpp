// Rayleigh's damping: its forces against rotations, differences and what a single mode does; energy; restart.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "physics/solid/viscous_elements.hpp"
#include "tests/solid/wheels.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

Options<2> rubber() {
    Options<2> options = soft_rubber<2>();
    options.clamps = {{"left", {true, true}}};
    options.alpha = 0;
    return options;
}

// The part of critical damping that a swing in the lowest mode shows over ten periods.
double measured_damping(Options<2> options) {
    const Mode mode = lowest_mode(slender_beam(), options);
    std::vector<double> u = mode.shape;
    for (double& x : u) x *= 1e-7;
    Solver<2> solver(slender_beam(), options);
    start_with(solver, u, no_load(slender_beam()));
    constexpr int per_period = 200, periods = 10;
    const double dt =
        options.scheme == Scheme::central_difference ? solver.largest_stable_step() : 1 / (per_period * mode.frequency);
    // Energy is without the ripple of the displacement: its decay over whole periods gives 2 ψ ω.
    const double start = solver.energies().stored();
    const int steps = int(std::lround(periods / (mode.frequency * dt)));
    for (int k = 0; k < steps; ++k) solver.advance(dt, no_load(slender_beam()), serial_loop);
    return std::log(start / solver.energies().stored()) / (2 * 2 * M_PI * mode.frequency * steps * dt);
}

// Some displacements and velocities without symmetry.
std::vector<double> wild(std::size_t size, double scale, int seed) {
    std::vector<double> x(size);
    for (std::size_t k = 0; k < size; ++k) x[k] = scale * std::sin(1.7 * double(k) + seed);
    return x;
}

template <int D>
struct Viscous {
    std::unique_ptr<ElementGroup<D>> group;
    std::unique_ptr<ViscousGroup<D>> viscous;

    Viscous(const Mesh<D>& mesh, Options<D> options) {
        options.stiffness_damping = 0.01;
        std::vector<ElementIndex> members;
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) members.push_back(ElementIndex(e));
        group = make_element_group(mesh, members, options.material, options);
        viscous = make_viscous_group(mesh, *group, options.material, options);
    }
    std::vector<double> forces(const std::vector<double>& u, const std::vector<double>& v) const {
        std::vector<double> f(group->packs() * group->force_size());
        viscous->forces(u, v, 0, group->packs(), f);
        return f;
    }
    std::vector<double> matrices(const std::vector<double>& u) const {
        std::vector<double> K(group->packs() * group->matrix_size(), 0.0);
        viscous->add_tangents(u, 1, 0, group->packs(), K);
        return K;
    }
};

template <int D>
void check_viscous(const Mesh<D>& mesh) {
    Options<D> options;
    options.material = material(MaterialLaw::neo_hookean, 1000, 1e6, 0.3);
    const Viscous<D> elements(mesh, options);
    const std::size_t size = D * mesh.nodes.size(), rows = elements.group->rows();
    const std::vector<double> u = wild(size, 0.02, 1), v = wild(size, 1, 2);

    // ∂F_d/∂v against differences, exactly: forces are linear in v.
    const std::vector<double> K = elements.matrices(u);
    double worst = 0, largest = 0;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < rows; ++c) {
            std::vector<double> unit(size, 0.0);
            unit[D * std::size_t(mesh.elements[0][c / D]) + c % D] = 1;
            const double entry = K[packed_index(r, c) * lanes];
            worst = std::max(worst, std::abs(entry - elements.forces(u, unit)[r * lanes]));
            largest = std::max(largest, std::abs(entry));
        }
    CHECK(worst < 1e-12 * largest);

    // About the undeformed body it is β K.
    const std::vector<double> at_rest = elements.matrices(std::vector<double>(size, 0.0));
    std::vector<double> stiffness(K.size());
    elements.group->tangents(std::vector<double>(size, 0.0), 0, elements.group->packs(), stiffness);
    for (std::size_t k = 0; k < K.size(); ++k) CHECK(std::abs(at_rest[k] - 0.01 * stiffness[k]) <= 1e-12 * 0.01 * 1e6);

    // It takes energy out, whatever the motion …
    const std::vector<double> f = elements.forces(u, v);
    double power = 0, scale = 0;
    for (std::size_t m = 0; m < mesh.elements.size(); ++m)
        for (std::size_t r = 0; r < rows; ++r) {
            const double x = f[(m / lanes) * elements.group->force_size() + r * lanes + m % lanes];
            power += x * v[D * std::size_t(mesh.elements[m][r / D]) + r % D];
            scale = std::max(scale, std::abs(x));
        }
    CHECK(power > 0);

    // … and none of a body that is turned a long way and turns on.
    std::vector<double> turned(size), turning(size);
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const double x = mesh.nodes[n][0], y = mesh.nodes[n][1], c = std::cos(1.2), s = std::sin(1.2);
        turned[D * n] = c * x - s * y - x;
        turned[D * n + 1] = s * x + c * y - y;
        turning[D * n] = -5 * (s * x + c * y);
        turning[D * n + 1] = 5 * (c * x - s * y);
    }
    for (const double x : elements.forces(turned, turning)) CHECK(std::abs(x) < 1e-12 * scale);
}

}  // namespace

TEST_CASE("viscous forces: tangent, undeformed limit, dissipation, none in a rotation") {
    check_viscous(box_mesh({0, 0}, {0.3, 0.2}, 3, 3));
    check_viscous(box_mesh({0, 0, 0}, {0.3, 0.2, 0.1}, {2, 2, 2}));
}

TEST_CASE("a swing in one mode decays as α/(2ω) + βω/2 says") {
    Options<2> options = rubber();
    const double omega = 2 * M_PI * lowest_mode(slender_beam(), options).frequency;
    for (const auto& [alpha, beta] :
         {std::pair{0.02 * omega, 0.0}, std::pair{0.0, 0.02 / omega}, std::pair{0.01 * omega, 0.01 / omega}}) {
        options.mass_damping = alpha;
        options.stiffness_damping = beta;
        const double psi = 0.5 * (alpha / omega + beta * omega);
        CHECK(measured_damping(options) == doctest::Approx(psi).epsilon(0.01));
    }
    // HHT without numerical damping, and central differences, at their largest stable step.
    options.scheme = Scheme::newmark;
    CHECK(measured_damping(options) == doctest::Approx(0.01).epsilon(0.01));
    options.scheme = Scheme::central_difference;
    CHECK(measured_damping(options) == doctest::Approx(0.01).epsilon(0.02));
}

TEST_CASE("energy balances with damping, which takes its part, at large rotations too") {
    double errors[2];
    for (const int refinement : {1, 2}) {
        Options<2> options = rubber();
        options.residual_tolerance = 1e-11;
        options.mass_damping = 2;
        options.stiffness_damping = 1e-3;
        Solver<2> solver(slender_beam(), options);
        const std::vector<double> full = traction(slender_beam(), "top", {0, -120});
        std::vector<double> load(full.size());
        const int steps = 200 * refinement;
        errors[refinement - 1] = imbalance(solver, steps, [&](int k) {
            const double part = std::pow(std::sin(M_PI * (k + 1) / steps), 2);
            for (std::size_t f = 0; f < load.size(); ++f) load[f] = part * full[f];
            solver.advance(0.2 / steps, load, serial_loop);
        });
        CHECK(solver.energies().damping > 0.1 * solver.energies().external_work);
    }
    MESSAGE("balance of energies ", errors[0], " ", errors[1]);
    CHECK(errors[1] < 1e-3);
    CHECK(errors[1] < 0.35 * errors[0]);  // second order at least
}

TEST_CASE("the explicit scheme with damping is stable at its step, and not at one and a half of it") {
    Options<2> options = rubber();
    options.scheme = Scheme::central_difference;
    options.stiffness_damping = 1e-5;
    options.mass_damping = 5;
    Solver<2> undamped(slender_beam(), [&] {
        Options<2> none = options;
        none.stiffness_damping = 0;
        return none;
    }());
    const auto largest_speed = [&](double part) {
        Solver<2> solver(slender_beam(), options);
        start_with(solver, no_load(slender_beam()), wild(2 * slender_beam().nodes.size(), 1e-3, 3));
        double fastest = 0;
        try {
            for (int k = 0; k < 2000; ++k)
                solver.advance(part * solver.largest_stable_step(), no_load(slender_beam()), serial_loop);
            for (const double v : solver.velocities()) fastest = std::max(fastest, std::abs(v));
        } catch (const ConvergenceError&) {
            fastest = 1e9;
        }
        return fastest;
    };
    CHECK(Solver<2>(slender_beam(), options).largest_stable_step() < 0.9 * undamped.largest_stable_step());
    CHECK(largest_speed(1) < 1e-2);
    CHECK(largest_speed(1.5) > 1);
}

TEST_CASE("a damped body continues with the same bits after a restart and on four threads") {
    const Mesh<2> mesh = box_mesh({0, 0}, {0.4, 0.1}, 60, 15);
    Options<2> options = rubber();
    options.alpha = -0.1;
    options.gravity = {0, -9.81};
    options.mass_damping = 3;
    options.stiffness_damping = 1e-4;
    const SixSteps run(mesh, options);
    const Solver<2>& straight = run.straight;
    for (const Solver<2>* other : {&run.threaded, &run.restarted}) {
        CHECK(copy(other->positions()) == copy(straight.positions()));
        CHECK(copy(other->velocities()) == copy(straight.velocities()));
        CHECK(other->energies().damping == straight.energies().damping);
        CHECK(other->energies().numerical == straight.energies().numerical);
    }
}

TEST_CASE("damping out of range is refused") {
    Options<2> options = rubber();
    options.mass_damping = -1;
    CHECK_THROWS_AS(Solver<2>(slender_beam(), options), std::invalid_argument);
    options = rubber();
    options.stiffness_damping = 1e-3;
    CHECK_THROWS_WITH_AS(Solver<2>(without_mid_side_nodes(slender_beam()), options),
                         doctest::Contains("quadratic elements"), std::invalid_argument);
}
