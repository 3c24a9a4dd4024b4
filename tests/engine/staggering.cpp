// The p that a staggered coupling is said to bear, beside what runs then do.
#include "engine/staggering.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/engine/model_run.hpp"

using namespace aquagraph;
using namespace aquagraph::test;
using doctest::Approx;

namespace {

std::optional<engine::Staggering> forecast(const std::string& text) {
    const Built built(text);
    return engine::forecast_staggering(built.scene, *built.model);
}

std::string of_density(const std::string& text, const char* density) {
    return with(text, "density = 8000.0", std::string("density = ") + density);
}

}  // namespace

TEST_CASE("the forecast of p: water within R against the mass of the wall, whatever the sound speed") {
    const std::string css = with_coupling(gate, "css", 1);
    const auto heavy = forecast(css), louder = forecast(with(css, "sound_speed = 30.0", "sound_speed = 60.0")),
               light = forecast(of_density(css, "2000.0")), beside = forecast(of_density(gate, "2000.0"));
    REQUIRE((heavy && louder && light && beside));
    // z = K ρ0 R/m'' with K 0.375 and R 0.02 m; both sides count.
    CHECK(heavy->mass_ratio == Approx(2 * 0.375 * 1000 * 0.02 / (8000 * 0.005)).epsilon(0.1));
    CHECK(louder->mass_ratio == Approx(heavy->mass_ratio).epsilon(0.1));
    CHECK(light->mass_ratio == Approx(4 * heavy->mass_ratio).epsilon(1e-6));
    CHECK(beside->mass_ratio == Approx(0.8 * light->mass_ratio).epsilon(1e-6));
    // A free mass bears z = 10/3 one after the other, and the side that no water touches does not count.
    CHECK(std::abs(light->largest_ratio - 10.0 / 3 / (0.5 * light->mass_ratio)) <= 1);
    CHECK(light->largest_ratio_under < light->largest_ratio);
    CHECK(beside->largest_ratio < light->largest_ratio);
    const auto one_side = forecast(with(of_density(css, "2000.0"), "\"left\", \"bottom\", \"right\"", "\"left\""));
    REQUIRE(one_side);
    CHECK(one_side->largest_ratio == light->largest_ratio);
    CHECK(one_side->largest_ratio_under <= one_side->largest_ratio);
    CHECK_FALSE(forecast(with_coupling(gate, "iterated", 1)));
    CHECK_FALSE(forecast(explicit_gate()));
}

TEST_CASE("a run beyond its forecast is warned of, and is lost; one within it is neither") {
    const std::string text = with(of_density(gate, "2000.0"), "end = 0.02", "end = 0.03");
    for (const char* algorithm : {"css", "cps"}) {
        CAPTURE(algorithm);
        const auto made = forecast(with_coupling(text, algorithm, 1));
        REQUIRE(made);
        REQUIRE(made->largest_ratio >= 1);
        CAPTURE(made->largest_ratio);
        const Finished within(with_coupling(text, algorithm, made->largest_ratio)),
            beyond(with_coupling(text, algorithm, 4 * made->largest_ratio));
        CHECK(within.code == engine::success);
        CHECK(within.err.str().find("warning") == std::string::npos);
        CHECK(beyond.err.str().find("may well be unstable") != std::string::npos);
        const double opening = Finished(with_coupling(text, algorithm, 1)).results.column("tip_x").back();
        CHECK(within.results.column("tip_x").back() == Approx(opening).epsilon(0.2));
        const bool lost = beyond.code != engine::success || beyond.results.column("tip_x").back() > 2 * opening;
        CHECK(lost);
    }
}
