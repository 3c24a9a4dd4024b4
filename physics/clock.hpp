// Where the simulation is in time.
#pragma once

namespace aquagraph {

struct Clock {
    double time = 0;     // of the fluid [s]
    double end = 0;      // of the run [s]
    double step = 0;     // Δt of the present fluid step [s]
    double elapsed = 0;  // since the last exchange between fluid and solid [s]
    double cycle = 0;    // length of the present coupling cycle [s]: known beforehand with CPS, summed up with CSS
    long steps = 0;      // fluid steps done
    long cycles = 0;     // coupling cycles done
    const char* limiter = "";  // what limits the step
    // Sums over steps, for the mean step over the largest stable one, and how many were longer than that.
    struct Use {
        double taken = 0, allowed = 0;  // [s]
        long overlong = 0;
    } use;

    // For a checkpoint, as everywhere below: the fields that the coming steps depend on, listed once for writing and
    // for reading (io/archive.hpp). `end` is the scene's, and the limiter is found anew.
    template <class Archive>
    void archive(Archive& fields) {
        fields(time, step, elapsed, cycle, steps, cycles, use);
    }
};

}  // namespace aquagraph
