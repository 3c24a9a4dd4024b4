// MUSCL reconstruction at the midpoint of a pair (thesis (2.56)-(2.60)) with the minmod limiter:
//     φ_L = φ_i + ½ minmod(∇φ_i·(x_j - x_i), φ_j - φ_i),   φ_R = φ_j - ½ minmod(∇φ_j·(x_j - x_i), φ_j - φ_i)
#pragma once
#include <algorithm>
#include <cmath>

namespace aquagraph::fluid {

// The one of smaller magnitude if both have the same sign, else 0. Written so that the vectoriser sees plain selects.
[[gnu::always_inline]] inline double minmod(double a, double b) {
    const double smaller = std::min(std::fabs(a), std::fabs(b));
    return a * b > 0 ? std::copysign(smaller, b) : 0.0;
}

}  // namespace aquagraph::fluid
