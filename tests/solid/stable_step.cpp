// The stable step of central differences follows a body that stiffens as it deforms.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;
using doctest::Approx;

namespace {

constexpr double squeeze_time = 0.2, depth = 0.05;

// A rubber block whose upper side is pressed down to half of its height, slowly for its waves.
Options<2> squeezed_rubber() {
    Options<2> options = soft_rubber<2>();
    options.scheme = Scheme::central_difference;
    options.mass_damping = 50;
    options.clamps = {{"bottom", {true, true}}};
    const TimeFunction down = TimeFunction::table({0, squeeze_time, 2 * squeeze_time}, {0, -depth, -depth});
    options.motions = {{"top", {TimeFunction::constant(0), down}}};
    return options;
}

double largest_speed(const Solver<2>& body) {
    double largest = 0;
    for (const double v : body.velocities()) largest = std::max(largest, std::abs(v));
    return largest;
}

}  // namespace

TEST_CASE("central differences take shorter steps where a rubber block has been pressed together") {
    const Mesh<2> mesh = box_mesh({0, 0}, {0.1, 0.1}, 3, 3);
    Solver<2> body(mesh, squeezed_rubber());
    const double at_first = body.largest_stable_step();
    long steps = 0;
    while (body.time() < 1.2 * squeeze_time) {
        body.advance(body.largest_stable_step(), no_load(mesh), serial_loop);
        ++steps;
    }
    const double pressed = body.largest_stable_step();
    INFO("stable step ", at_first, " s at first, ", pressed, " s pressed together, ", steps, " steps");
    CHECK(pressed < 0.8 * at_first);
    // The mean speed of the piston is 0.25 m/s.
    CHECK(largest_speed(body) < 0.1);

    // As good as computed anew.
    State state;
    body.save(state);
    CHECK(state.stable_step_age < 100);
    state.stable_step = 0;
    Solver<2> anew(mesh, squeezed_rubber());
    anew.restore(state);
    CHECK(pressed == Approx(anew.largest_stable_step()).epsilon(0.04));

    // With the first step all the way it does not stay calm.
    Solver<2> stubborn(mesh, squeezed_rubber());
    bool lost = false;
    try {
        while (stubborn.time() < 1.2 * squeeze_time) stubborn.advance(at_first, no_load(mesh), serial_loop);
        lost = !(largest_speed(stubborn) < 1);
    } catch (const SolverError&) {
        lost = true;
    }
    CHECK(lost);
}

TEST_CASE("a body that stays as stiff as it was keeps the bits of its step, and a restored one goes on with them") {
    const Mesh<2> mesh = box_mesh({0, 0}, {0.1, 0.1}, 3, 3);
    Options<2> options = squeezed_rubber();
    options.motions.clear();
    Solver<2> body(mesh, options);
    body.set_velocity({0.01, 0});
    const double at_first = body.largest_stable_step();
    for (int k = 0; k < 250; ++k) body.advance(body.largest_stable_step(), no_load(mesh), serial_loop);
    CHECK(body.largest_stable_step() == at_first);

    Solver<2> squeezed(mesh, squeezed_rubber());
    for (int k = 0; k < 130; ++k) squeezed.advance(squeezed.largest_stable_step(), no_load(mesh), serial_loop);
    State state;
    squeezed.save(state);
    Solver<2> restored(mesh, squeezed_rubber());
    restored.restore(state);
    for (int k = 0; k < 200; ++k) {
        squeezed.advance(squeezed.largest_stable_step(), no_load(mesh), serial_loop);
        restored.advance(restored.largest_stable_step(), no_load(mesh), serial_loop);
    }
    CHECK(copy(squeezed.positions()) == copy(restored.positions()));
}
