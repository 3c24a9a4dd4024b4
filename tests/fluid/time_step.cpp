// The largest stable step: the fastest sound, the strongest acceleration, whichever is stricter.
#include "physics/fluid/time_step.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/fluid/fixtures.hpp"

using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

TEST_CASE("the step is limited by the fastest sound and the strongest acceleration") {
    Random random;
    Particles<2> s = place<2>(lattice<2>({20, 10}, 0.05, 0, random), 0.05);
    const double R = 0.2, cfl = 0.375;
    const auto limits = [&] {
        StepLimits all;
        for (std::size_t block = 0; block < s.blocks(); ++block)
            all = combine(all, step_limits(s, cfl, R, lanes_of_block(s, block)));
        return all;
    };
    StepLimits rest = limits();
    CHECK(rest.sound == doctest::Approx(cfl * R / 20).epsilon(1e-14));
    CHECK(std::isinf(rest.acceleration));
    CHECK(rest.step() == rest.sound);
    CHECK(std::string(rest.name()) == "sound speed");

    s.deviation[150] = 50;  // compressed water is faster
    for (std::size_t block = 0; block < s.blocks(); ++block)
        aquagraph::fluid::update_state(s, water, lanes_of_block(s, block));
    CHECK(limits().sound == doctest::Approx(cfl * R / water.sound_speed_at(50)).epsilon(1e-13));

    s.acceleration[0][7] = 3e4;
    s.acceleration[1][7] = -4e4;
    const StepLimits hit = limits();
    CHECK(hit.acceleration == doctest::Approx(0.25 * std::sqrt(R / 5e4)).epsilon(1e-14));
    CHECK(hit.step() == hit.acceleration);
    CHECK(std::string(hit.name()) == "acceleration");
}
