// What a fluid without walls keeps: momentum to rounding, every particle's mass exactly, and the same bits on any
// number of threads.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;
using aquagraph::solid::test::ThreadedLoop;

namespace {

// A free drop in violent motion: two halves run into each other while they turn.
template <int D>
Fluid<D> clash(const std::array<int, D>& cells) {
    Fluid<D> fluid = make_fluid<D>(0.05, Tait{1000, 20});
    Random random(11);
    fluid.particles = place<D>(lattice<D>(cells, fluid.spacing, 0.15, random), fluid.spacing);
    auto& s = fluid.particles;
    const double middle = 0.5 * cells[0] * fluid.spacing;
    for (std::size_t i = 0; i < s.count; ++i) {
        s.v[0][i] = s.x[0][i] < middle ? 2 : -1;
        s.v[1][i] = 1.5 * (s.x[0][i] - middle) + 0.3 * random();
        s.deviation[i] = 2 * random();
        s.mass[i] *= 1 + 0.1 * random();
    }
    return fluid;
}

template <int D>
struct Momentum {
    double total[D] = {}, magnitude = 0;
    explicit Momentum(const Particles<D>& s) {
        for (std::size_t i = 0; i < s.count; ++i)
            for (std::size_t d = 0; d < D; ++d) {
                total[d] += s.mass[i] * s.v[d][i];
                magnitude += s.mass[i] * std::fabs(s.v[d][i]);
            }
    }
};

template <int D>
void check_momentum(const std::array<int, D>& cells, int steps) {
    CAPTURE(D);
    Driver<D> driver(clash<D>(cells));
    auto& s = driver.fluid.particles;
    const auto masses = [&] {
        std::vector<double> of(s.count);
        for (std::size_t i = 0; i < s.count; ++i) of[static_cast<std::size_t>(s.id[i])] = s.mass[i];
        return of;
    };
    const Momentum<D> before(s);
    const auto mass_before = masses();
    for (int step = 0; step < steps; ++step) driver.step(driver.largest_step());
    const Momentum<D> after(s);
    CHECK(driver.fluid.rebuilds > 3);
    CHECK(after.magnitude < 0.95 * before.magnitude);  // something has happened
    for (std::size_t d = 0; d < D; ++d) {
        const double change = std::fabs(after.total[d] - before.total[d]) / before.magnitude;
        CAPTURE(change);
        CHECK(change < 1e-13);
    }
    CHECK(masses() == mass_before);
}

template <int D>
void check_threads(const std::array<int, D>& cells) {
    CAPTURE(D);
    std::vector<double> serial;
    for (const unsigned threads : {0u, 2u, 4u}) {
        CAPTURE(threads);
        const ThreadedLoop threaded{threads};
        const BlockLoop loop = threads == 0 ? BlockLoop(serial_loop) : BlockLoop(threaded);
        Driver<D> driver(clash<D>(cells));
        for (int step = 0; step < 25; ++step) driver.step(driver.largest_step(), loop);
        CHECK(driver.fluid.rebuilds > 1);
        CHECK(driver.fluid.particles.blocks() > 8);
        const auto state = state_by_id(driver.fluid.particles);
        if (threads == 0) serial = state;
        CHECK(state == serial);
    }
}

}  // namespace

TEST_CASE("momentum is conserved to rounding, mass exactly") {
    check_momentum<2>({30, 24}, 300);
    check_momentum<3>({12, 10, 9}, 120);
}

TEST_CASE("steps are the same bits on 1, 2 and 4 threads") {
    check_threads<2>({44, 30});
    check_threads<3>({13, 11, 10});
}
