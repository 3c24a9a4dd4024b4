// A body by central differences in water: as many of its steps in a coupling cycle as are stable.
#include <doctest/doctest.h>

#include <cmath>

#include "physics/solid/stable_steps.hpp"
#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

// Largest difference of a column between two runs over its peak, rows of the second interpolated at times of the first.
double apart(const io::History& a, const io::History& b, const char* column) {
    const auto t = a.time(), s = b.time();
    const auto x = a.column(column), y = b.column(column);
    double peak = 0, difference = 0;
    for (std::size_t i = 0, k = 1; i < t.size(); ++i) {
        while (k + 1 < s.size() && s[k] < t[i]) ++k;
        const double at = y[k - 1] + (y[k] - y[k - 1]) * (t[i] - s[k - 1]) / (s[k] - s[k - 1]);
        peak = std::max(peak, std::fabs(x[i]));
        difference = std::max(difference, std::fabs(at - x[i]));
    }
    return difference / peak;
}

}  // namespace

TEST_CASE("a gate by central differences opens like the implicit one") {
    // Newmark damps the gate's swing by -α ω Δt/2, a thousandth; without any damping CPS swings up.
    for (const char* algorithm : {"cps", "css"})
        for (const int p : {1, 2}) {
            CAPTURE(algorithm);
            CAPTURE(p);
            const auto finely = [&](const std::string& text) {
                return with(
                    with(with_coupling(text, algorithm, p), "sound_speed = 30.0", "sound_speed = 30.0\ncfl = 0.15"),
                    "history_interval = 0.001\n", "");
            };
            const Finished by_steps(finely(explicit_gate())), at_once(finely(gate));
            INFO(by_steps.err.str(), at_once.err.str());
            REQUIRE(by_steps.code == engine::success);
            REQUIRE(at_once.code == engine::success);
            const double tip = apart(at_once.results.history(), by_steps.results.history(), "tip_x");
            INFO("apart by ", 100 * tip, " % of the largest opening");
            CHECK(tip < 0.01);
            const nlohmann::json summary = by_steps.results.summary();
            CHECK(summary.at("solid").at("steps").get<long>() > 4 * summary.at("coupling_cycles").get<long>());
            CHECK(summary.at("solid").at("factorisations") == 0);
        }
}

TEST_CASE("the steps of a cycle are stable, and their loads go from one exchange to the next") {
    CHECK(solid::stable_steps(1.0, std::numeric_limits<double>::infinity()) == 1);
    CHECK(solid::stable_steps(1.0, 1.0) == 1);
    CHECK(solid::stable_steps(1.0, 0.99) == 2);
    CHECK(solid::stable_steps(1.0, 0.1) == 10);

    const Built built(explicit_gate());
    solid::Solver<2>& body = *built.model->solid;
    const double cycle = 7.5 * body.largest_stable_step();
    std::vector<double> loads(body.displacements().size()), borne, between;
    const std::size_t tip = loads.size() - 2;
    loads[tip] = 1;
    advance_stably(body, cycle, loads, borne, between, serial_loop);
    CHECK(body.statistics().steps == 8);
    CHECK(borne == loads);
    // The first step takes its loads as constant; from then on they rise on a line, and their work is trapezoidal.
    const double before = body.work_of_loads(), start = body.displacements()[tip];
    CHECK(before == Approx(start).epsilon(1e-12));
    loads[tip] = 3;
    solid::State state;
    body.save(state);
    advance_stably(body, cycle, loads, borne, between, serial_loop);
    const double work = body.work_of_loads() - before;
    body.restore(state);
    double sum = 0, from = start;
    for (int k = 1; k <= 8; ++k) {
        loads[tip] = 1 + 2 * k / 8.0;
        body.advance(cycle / 8, loads, serial_loop);
        sum += (loads[tip] - 0.125) * (body.displacements()[tip] - from);
        from = body.displacements()[tip];
    }
    CHECK(work == Approx(sum).epsilon(1e-12));
}

TEST_CASE("the balance of water and a body by central differences closes with the time step") {
    const auto residual = [](const char* cfl) {
        const std::string text = with(with(explicit_gate(), "ratio = 1\n", "ratio = 1\nstep_fraction = 1.0\n"),
                                      "[output]\n", "[output]\nenergy_ledger = true\n");
        const Finished run(with(text, "sound_speed = 30.0",
                                std::string("sound_speed = 30.0\nscheme.reconstruction = \"none\"\ncfl = ") + cfl));
        REQUIRE(run.code == engine::success);
        const io::History history = run.results.history();
        double largest = 0;
        for (const double r : history.column("total_energy_residual")) largest = std::max(largest, std::fabs(r));
        return std::pair{largest, history.column("fluid_dissipated_energy").back()};
    };
    const auto [coarse, much] = residual("0.375");
    const auto [fine, dissipated] = residual("0.1");
    INFO("residual ", coarse, " and ", fine, " J/m of ", dissipated, " J/m dissipated");
    CHECK(fine < 0.1 * coarse);
    CHECK(fine < 1e-3 * dissipated);
}
