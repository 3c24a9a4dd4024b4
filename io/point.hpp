// A place or a vector in the dimension of its scene: two coordinates, or three.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace aquagraph::io {

class Point {
  public:
    Point() = default;
    Point(double x, double y) : x_{x, y, 0} {}
    Point(double x, double y, double z) : dimension_(3), x_{x, y, z} {}

    int dimension() const { return int(dimension_); }
    std::size_t size() const { return std::size_t(dimension_); }
    double operator[](std::size_t d) const { return x_[d]; }
    double& operator[](std::size_t d) { return x_[d]; }
    const double* begin() const { return x_.data(); }
    const double* end() const { return x_.data() + dimension_; }

    bool operator==(const Point&) const = default;

    // The first D coordinates; those that the point does not have are zero.
    template <int D>
    std::array<double, D> as() const {
        std::array<double, D> x;
        for (std::size_t d = 0; d < D; ++d) x[d] = x_[d];
        return x;
    }

  private:
    std::int64_t dimension_ = 2;  // wide, so that no byte is undefined: points are written as bytes (io/archive.hpp)
    std::array<double, 3> x_{};
};

}  // namespace aquagraph::io
