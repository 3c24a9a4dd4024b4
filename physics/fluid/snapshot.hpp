// The state of the fluid at the start of a step, to come back to: exactly, as long as the lists have not been renewed
// since. A renewal changes the order of the particles; coming back then needs another one, and sums that run in the
// order of the particles differ by rounding from there on.
#pragma once
#include "physics/clock.hpp"
#include "physics/fluid/fluid.hpp"

namespace aquagraph::fluid {

template <int D>
struct Snapshot {
    Particles<D> particles;
    EnergyRates sum, last;  // of the ledger
    double lost = 0;
    SearchRecord<D> record;
    Clock clock;
    long rebuilds = 0, outrun = 0;
    std::size_t removed = 0, held_back = 0;

    void take(const Fluid<D>& fluid, const Clock& now) {
        particles = fluid.particles;
        sum = fluid.ledger.sum;
        last = fluid.ledger.last;
        lost = fluid.ledger.lost;
        record = fluid.record;
        clock = now;
        rebuilds = fluid.rebuilds;
        outrun = fluid.outrun;
        removed = fluid.removed;
        held_back = fluid.held_back;
    }

    // Returns whether the lists have been renewed since, so that they must be once more before anything else.
    [[nodiscard]] bool give_back(Fluid<D>& fluid, Clock& now) const {
        fluid.particles = particles;
        fluid.ledger.sum = sum;
        fluid.ledger.last = last;
        fluid.ledger.lost = lost;
        fluid.record = record;
        now = clock;
        fluid.outrun = outrun;
        fluid.removed = removed;
        fluid.held_back = held_back;
        return fluid.rebuilds != rebuilds;
    }
};

}  // namespace aquagraph::fluid
