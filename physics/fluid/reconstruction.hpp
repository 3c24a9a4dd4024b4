// MUSCL reconstruction at the midpoint of a pair (thesis (2.56)-(2.60)) with the minmod limiter:
//     φ_L = φ_i + ½ minmod(∇φ_i·(x_j - x_i), φ_j - φ_i),   φ_R = φ_j - ½ minmod(∇φ_j·(x_j - x_i), φ_j - φ_i)
#pragma once
#include <algorithm>
#include <cmath>

namespace aquagraph::fluid {

// The one of smaller magnitude if both have the same sign, else 0: the middle one of 0, a and b. Where two slopes are
// limited by the same difference b, half of the work is shared.
[[gnu::always_inline]] inline double minmod(double a, double b) {
    return std::max(std::min(b, 0.0), std::min(std::max(b, 0.0), a));
}

}  // namespace aquagraph::fluid
