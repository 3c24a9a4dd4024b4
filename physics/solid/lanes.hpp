// One element per lane: numbers of eight elements side by side, for which every operation is one instruction (or two).
// Laws and elements are written once for T = Lane or T = double; only what C++ does not offer for both is here.
#pragma once
#include <cmath>
#include <cstddef>

namespace aquagraph::solid {

inline constexpr std::size_t lanes = 8;
using Lane = double __attribute__((vector_size(lanes * sizeof(double))));

inline double square_root(double x) {
    return std::sqrt(x);
}
inline Lane square_root(const Lane& x) {
    Lane y;
    for (std::size_t l = 0; l < lanes; ++l) y[l] = std::sqrt(x[l]);
    return y;
}

inline double smaller(double a, double b) {
    return a < b ? a : b;
}
inline Lane smaller(const Lane& a, const Lane& b) {
    return a < b ? a : b;
}
inline double positive_part(double x) {
    return x > 0 ? x : 0;
}
inline Lane positive_part(const Lane& x) {
    return x > 0 ? x : Lane{};
}

inline double smallest_lane(const Lane& x) {
    double least = x[0];
    for (std::size_t l = 1; l < lanes; ++l) least = smaller(x[l], least);
    return least;
}
inline double sum_of_lanes(const Lane& x) {
    double sum = 0;
    for (std::size_t l = 0; l < lanes; ++l) sum += x[l];
    return sum;
}

// J^(-1/3) by Halley's iteration from 1, a fixed number of times: no branch and no call. To rounding for
// 0.05 < J < 20.
template <class T>
T inverse_cube_root(const T& J) {
    T y = T{} + 1.0;
    for (int k = 0; k < 5; ++k) {
        const T Jy3 = J * y * y * y;
        y *= (Jy3 + 2.0) / (2.0 * Jy3 + 1.0);
    }
    return y;
}

}  // namespace aquagraph::solid
