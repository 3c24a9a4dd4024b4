// Regulation of p, the number of fluid steps per solid step, by how much the force on the body changes in a cycle
// (thesis (6.2)):
//     r = |ΣF^(n+p) - ΣF^n| / |ΣF^n|:   r <= 0.075: p + 1, up to the bound;   r <= 0.15: p - 1, at least 1;   else 1.
// Where ΣF^n is small, before the water has arrived or where the force changes sign, r says nothing. It is therefore
// divided by at least a hundredth of the largest |ΣF| so far.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace aquagraph::coupling {

struct RatioControl {
    bool regulated = false;  // else p stays
    int most = 1;            // the bound
    int p = 1;
    std::array<double, 2> force{};  // ΣF^n [N/m]
    double largest = 0;             // |ΣF| so far

    static constexpr double steady = 0.075, unsteady = 0.15, guard = 0.01;

    void begin(const std::array<double, 2>& now) {
        force = now;
        largest = std::hypot(now[0], now[1]);
    }
    // After a cycle that has ended with this force.
    void update(const std::array<double, 2>& now) {
        const double before = std::hypot(force[0], force[1]), change = std::hypot(now[0] - force[0], now[1] - force[1]);
        largest = std::max(largest, std::hypot(now[0], now[1]));
        const double scale = std::max(before, guard * largest);
        if (change <= steady * scale)
            p = std::min(p + 1, most);
        else if (change <= unsteady * scale)
            p = std::max(p - 1, 1);
        else
            p = 1;
        force = now;
    }
};

}  // namespace aquagraph::coupling
