// A long step of a body whose scheme bears only short ones: as many equal steps as it takes, under loads on the
// straight line from those at its start to those at its end. What bears any step makes one.
#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "physics/solid/structure.hpp"

namespace aquagraph::solid {

// Steps that a step of size dt [s] takes.
inline long stable_steps(double dt, double largest_stable_step) {
    return std::max(1L, static_cast<long>(std::ceil(dt / largest_stable_step * (1 - 1e-9))));
}

// loads_before: at the start of the step, D × nodes [N]; empty before the first, which takes its loads as constant.
// They become `loads`. between: scratch. Throws SolverError, leaving the body where the last step has ended that it
// could make.
template <int D>
void advance_stably(Structure<D>& body, double dt, std::span<const double> loads, std::vector<double>& loads_before,
                    std::vector<double>& between, BlockLoop loop) {
    const long steps = stable_steps(dt, body.largest_stable_step());
    if (steps == 1) {
        body.advance(dt, loads, loop);
    } else {
        if (loads_before.empty()) loads_before.assign(loads.begin(), loads.end());
        between.resize(loads.size());
        for (long k = 1; k <= steps; ++k) {
            const double part = double(k) / double(steps);
            for (std::size_t f = 0; f < loads.size(); ++f)
                between[f] = loads_before[f] + part * (loads[f] - loads_before[f]);
            body.advance(dt / double(steps), between, loop);
        }
    }
    loads_before.assign(loads.begin(), loads.end());
}

}  // namespace aquagraph::solid
