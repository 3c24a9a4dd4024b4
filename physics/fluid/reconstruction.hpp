// MUSCL reconstruction at the midpoint of a pair (thesis (2.56)-(2.60)) with the minmod limiter:
//     φ_L = φ_i + ½ minmod(∇φ_i·(x_j - x_i), φ_j - φ_i),   φ_R = φ_j - ½ minmod(∇φ_j·(x_j - x_i), φ_j - φ_i)
#pragma once
#include <algorithm>
#include <cmath>

namespace aquagraph::fluid {

// 2 minmod(a, b), of 2a and b. minmod is the one of smaller magnitude if both have the same sign, else 0: the middle
// one of 0, a and b, that is max(min(b, 0), min(max(b, 0), a)). b ± |b| are 2 max(b, 0) and 2 min(b, 0), exactly, by
// additions; a comparison with zero would take the place of a multiplication, of which a flux is full.
[[gnu::always_inline]] inline double twice_minmod(double twice_a, double b) {
    const double size = std::fabs(b);
    return std::max(b - size, std::min(b + size, twice_a));
}

}  // namespace aquagraph::fluid
