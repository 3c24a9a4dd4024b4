// Whole runs: the same bits on any number of threads and every time; algorithms that agree where they must.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/results_of_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;

namespace {

// history.csv as text and the numbers of the last frames.
struct Bits {
    std::string history, fluid, solid;
    bool operator==(const Bits&) const = default;
};

Bits bits_of(const std::string& text, int threads) {
    const Finished run(text, threads);
    REQUIRE(run.code == engine::success);
    const auto fluid = run.results.frames("fluid");
    Bits bits;
    bits.history = contents(run.results.path / "history.csv");
    bits.fluid = numbers_of(
        run.results.open(fluid.back()),
        {"VTKHDF/Points", "VTKHDF/PointData/pressure", "VTKHDF/PointData/velocity", "VTKHDF/PointData/density",
         "VTKHDF/PointData/volume", "VTKHDF/PointData/fullness", "VTKHDF/PointData/id"});
    if (std::filesystem::exists(run.results.path / "solid.hdf.series"))
        bits.solid = numbers_of(run.results.open(run.results.frames("solid").back()),
                                {"VTKHDF/Points", "VTKHDF/PointData/displacement", "VTKHDF/PointData/velocity",
                                 "VTKHDF/CellData/von_mises_stress"});
    return bits;
}

void check_same_on_all_threads(const std::string& text) {
    const Bits reference = bits_of(text, 1);
    REQUIRE(count(reference.history, "\n") > 10);
    REQUIRE(reference.fluid.size() > 1000);
    for (const int threads : {1, 2, 4}) {  // 1 once more: two runs are equal
        CAPTURE(threads);
        const Bits other = bits_of(text, threads);
        CHECK(other.history == reference.history);
        CHECK(other.fluid == reference.fluid);
        CHECK(other.solid == reference.solid);
    }
}

}  // namespace

TEST_CASE("the gate has the same bits on 1, 2 and 4 threads") {
    // Every cycle's row: a difference shows where it begins.
    const std::string every_cycle = with(gate, "history_interval = 0.001\n", "");
    for (const char* algorithm : {"cps", "css"})
        for (const int p : {1, 3}) {
            CAPTURE(algorithm);
            CAPTURE(p);
            check_same_on_all_threads(with_coupling(every_cycle, algorithm, p));
        }
}

TEST_CASE("every load, regulation and iteration has the same bits on 1, 2 and 4 threads") {
    const std::string every_cycle = with(gate, "history_interval = 0.001\n", "energy_ledger = true\n");
    for (const char* keys :
         {"algorithm = \"cps\"\nload = \"averaged_pressure\"\nratio_control = true\nratio = 4\n",
          "algorithm = \"css\"\nload = \"energy_conservative\"\nextrapolation = \"quadratic\"\nratio = 3\n",
          "algorithm = \"cps\"\nload = \"energy_conservative\"\nstep_rule = \"predicted\"\nratio = 2\n",
          "algorithm = \"iterated\"\nratio = 2\n"}) {
        CAPTURE(keys);
        check_same_on_all_threads(with(every_cycle, "algorithm = \"cps\"\nratio = 1\n", keys));
    }
}

TEST_CASE("the plate has the same bits on 1, 2 and 4 threads") {
    check_same_on_all_threads(plate);
    check_same_on_all_threads(plate + "[coupling]\nalgorithm = \"css\"\nratio = 3\n");
}

TEST_CASE("central differences in water have the same bits on 1, 2 and 4 threads") {
    check_same_on_all_threads(with(explicit_gate(), "end = 0.02", "end = 0.01"));
}

TEST_CASE("water alone has the same bits on 1, 2 and 4 threads") {
    check_same_on_all_threads(column);
}

TEST_CASE("CPS and CSS agree") {
    // The two differ by when a load reaches the solid: one cycle of 0.2 to 0.25 ms, in 20 ms.
    const Finished cps(with_coupling(gate, "cps", 1)), css(with_coupling(gate, "css", 1));
    const io::History a = cps.results.history(), b = css.results.history();
    for (const char* column : {"tip_x", "tip_y"}) {
        CAPTURE(column);
        double peak = 0, difference = 0;
        // Rows of the two lie at times of their own: compared by interpolation.
        const auto at = [&](const io::History& history, double t) {
            const auto time = history.time();
            const auto value = history.column(column);
            for (std::size_t k = 1; k < time.size(); ++k)
                if (t <= time[k])
                    return value[k - 1] + (value[k] - value[k - 1]) * (t - time[k - 1]) / (time[k] - time[k - 1]);
            return value.back();
        };
        for (double t = 0; t <= 0.02; t += 1e-4) {
            peak = std::max(peak, std::fabs(at(a, t)));
            difference = std::max(difference, std::fabs(at(a, t) - at(b, t)));
        }
        INFO("peak ", peak, " m, largest difference ", difference, " m, ", 100 * difference / peak, " %");
        CHECK(peak > 0);
        CHECK(difference < 0.03 * peak);
    }
}

TEST_CASE("the lag of CPS is its cycle, however many fluid steps that has") {
    // The solid moves under the load of the cycle's start, so what an error there is belongs to the cycle's length:
    // three fluid steps of a third of the size give the same cycle and nearly the same gate, three of the full size do
    // not.
    const auto tip = [](const std::string& text) { return Finished(text).results.column("tip_x").back(); };
    const double one = tip(with_coupling(gate, "cps", 1)), three_long = tip(with_coupling(gate, "cps", 3)),
                 three_short =
                     tip(with(with_coupling(gate, "cps", 3), "ratio = 3", "ratio = 3\nstep_fraction = 0.2667"));
    INFO("tip_x ", one, " m with p = 1, ", three_short, " m with p = 3 and the same cycle, ", three_long,
         " m with p = 3");
    CHECK(one > 0);
    CHECK(std::fabs(three_short - one) < 0.03 * one);
    CHECK(std::fabs(three_short - one) < 0.5 * std::fabs(three_long - one));
}
