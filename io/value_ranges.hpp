// Ranges of numbers that many keys share.
#pragma once
#include <limits>

#include "io/scene_keys.hpp"

namespace aquagraph::io::ranges {

inline constexpr double inf = std::numeric_limits<double>::infinity();
constexpr ValueRange closed(double low, double high) {
    return {low, high, false, false};
}
constexpr ValueRange open(double low, double high) {
    return {low, high, true, true};
}
// ]low, high]
constexpr ValueRange open_below(double low, double high) {
    return {low, high, true, false};
}

inline constexpr ValueRange any{};
inline constexpr ValueRange positive{0, inf, true, true};
inline constexpr ValueRange not_negative{0, inf, false, true};
inline constexpr ValueRange at_least_one{1, inf, false, true};

}  // namespace aquagraph::io::ranges
