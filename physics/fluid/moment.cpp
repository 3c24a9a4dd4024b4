#include "physics/fluid/moment.hpp"

#include <numbers>

namespace aquagraph::fluid {

CosineOfTwoThirds::CosineOfTwoThirds() {
    constexpr double pi = std::numbers::pi;
    for (int k = 0; k < terms; ++k) {
        for (int j = 0; j < terms; ++j) {
            const double angle = pi * (j + 0.5) / terms;
            chebyshev_[k] +=
                2.0 / terms * std::cos(2.0 / 3 * std::acos(0.5 + 0.5 * std::cos(angle))) * std::cos(k * angle);
        }
    }
    chebyshev_[0] *= 0.5;
}
const CosineOfTwoThirds cosine_of_two_thirds;

}  // namespace aquagraph::fluid
