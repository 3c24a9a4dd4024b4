// A body in water that something else drives as well: its work stands in the ledger of water and body.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

// First order in space: limiters are kinks that no integration follows.
std::string driven(const std::string& cfl, const std::string& drive) {
    std::string text = with(gate, "[[solid.clamp]]\nset = \"top\"\n", drive);
    text = with(text, "sound_speed = 30.0", "sound_speed = 30.0\nscheme.reconstruction = \"none\"\ncfl = " + cfl);
    text = with(text, "wet = [\"left\", \"bottom\", \"right\"]", "wet = [\"left\"]");
    text = with(text, "ratio = 1\n", "ratio = 1\nstep_fraction = 1.0\n");
    return with(text, "history_interval = 0.001\n", "energy_ledger = true\n");
}

const std::string paddle = R"([[solid.motion]]
name = "hand"
set = "top"
along = "x"
amplitude = -1e-3
frequency = 30.0
ramp = 0.01
[[solid.motion]]
set = "top"
along = "y"
value = 0.0
)";

// Pressed from behind, rubbed by a ground that comes and rises, with losses of its own.
const std::string everything = paddle + R"([[solid.pressure]]
surface = "right"
value = 300.0
[[solid.contact]]
name = "stop"
surface = "right"
point = [0.1052, 0.0]
normal = [-1.0, 0.0]
friction = 0.3
[[solid.ground_motion]]
contact = "stop"
along = "x"
rate = -0.05
ramp = 0.005
[[solid.ground_motion]]
contact = "stop"
along = "y"
rate = 0.1
ramp = 0.005
[solid.damping]
mass = 20.0
stiffness = 1e-5
)";

double peak(const std::vector<double>& values) {
    double largest = 0;
    for (const double v : values) largest = std::max(largest, std::fabs(v));
    return largest;
}

struct Outcome {
    double total, solid, driving;  // largest residuals and the largest work [J/m]
    io::History history;
    std::vector<double> column(const char* name) const {
        const auto values = history.column(name);
        return {values.begin(), values.end()};
    }
};

Outcome run(const std::string& text) {
    const Finished finished(text);
    INFO(finished.err.str());
    REQUIRE(finished.code == engine::success);
    Outcome outcome{0, 0, 0, finished.results.history()};
    outcome.total = peak(outcome.column("total_energy_residual"));
    outcome.solid = peak(outcome.column("solid_energy_residual"));
    outcome.driving = peak(outcome.column("solid_driving_work"));
    return outcome;
}

}  // namespace

TEST_CASE("the driving work of a paddle is that of the force that moves it") {
    const Outcome paddled = run(driven("0.1", paddle));
    const auto force = paddled.column("hand_force_x"), work = paddled.column("solid_driving_work"),
               time = paddled.column("time");
    const auto place = [](double t) {  // of the hand: r(t) A sin 2π f t
        const double s = std::min(1.0, t / 0.01);
        return s * s * s * (10 - 15 * s + 6 * s * s) * -1e-3 * std::sin(2 * M_PI * 30 * t);
    };
    double sum = 0;
    for (std::size_t k = 1; k < time.size(); ++k) {
        // Before the first step nobody knows the acceleration, hence no force.
        const double before = k == 1 ? force[1] : force[k - 1];
        sum += 0.5 * (before + force[k]) * (place(time[k]) - place(time[k - 1]));
        CHECK(work[k] == Approx(sum).scale(paddled.driving).epsilon(1e-6));
    }
    CHECK(paddled.driving > 0.1 * peak(paddled.column("solid_kinetic_energy")));
}

TEST_CASE("the balance of water and a driven body closes with the time step") {
    const Outcome coarse = run(driven("0.375", everything)), fine = run(driven("0.1", everything));
    INFO("driving work ", coarse.driving, " J/m; residual of all ", coarse.total, ", ", fine.total, ", of the body ",
         coarse.solid, ", ", fine.solid);
    for (const char* part : {"solid_contact_energy", "solid_friction_energy", "solid_damping_energy"}) {
        CAPTURE(part);
        CHECK(peak(fine.column(part)) > 100 * fine.total);  // it would show if it were missing
    }
    CHECK(fine.driving > 1000 * fine.total);
    CHECK(fine.total < 0.1 * coarse.total);
    CHECK(fine.driving == Approx(coarse.driving).epsilon(0.05));
    // Contact that opens and closes is a kink in the work of forces.
    CHECK(fine.solid < coarse.solid);
    CHECK(fine.solid < 1e-3 * fine.driving);
}

TEST_CASE("the driven body's own balance closes with the time step") {
    const std::string smooth = everything.substr(0, everything.find("[[solid.contact]]")) +
                               everything.substr(everything.find("[solid.damping]"));
    const Outcome coarse = run(driven("0.375", smooth)), fine = run(driven("0.1", smooth));
    INFO("driving work ", coarse.driving, " J/m; residual of the body ", coarse.solid, ", ", fine.solid);
    CHECK(fine.solid < 0.1 * coarse.solid);
}
