#include "physics/solid/border.hpp"

#include <algorithm>
#include <cmath>

namespace aquagraph::solid {

namespace {

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

}  // namespace

Border::Border(std::size_t rows, std::size_t columns)
    : rows_(rows),
      count_(columns),
      columns_(rows * columns),
      condensed_(rows * columns),
      corner_(columns * columns),
      small_(columns) {}

bool Border::condense(SolveB solve) {
    for (std::size_t k = 0; k < count_; ++k) {
        const auto W = std::span(condensed_).subspan(k * rows_, rows_);
        if (!solve(column(k), W)) return false;
        for (std::size_t j = k; j < count_; ++j) corner(j, k) -= dot(column(j), W);
    }
    return factorise_corner();
}

bool Border::factorise_corner() {
    constexpr double singular_to_rounding = 1e-13;  // of the pivot before elimination
    for (std::size_t k = 0; k < count_; ++k) {
        const double before = corner(k, k);
        for (std::size_t j = 0; j < k; ++j) corner(k, k) -= corner(k, j) * corner(k, j);
        if (!(corner(k, k) > singular_to_rounding * before)) return false;
        corner(k, k) = std::sqrt(corner(k, k));
        for (std::size_t i = k + 1; i < count_; ++i) {
            for (std::size_t j = 0; j < k; ++j) corner(i, k) -= corner(i, j) * corner(k, j);
            corner(i, k) /= corner(k, k);
        }
    }
    return true;
}

bool Border::solve(std::span<const double> b, std::span<double> x, SolveB solve) {
    for (std::size_t k = 0; k < count_; ++k)
        small_[k] = b[rows_ + k] - dot(std::span<const double>(condensed_).subspan(k * rows_, rows_), b.first(rows_));
    if (!solve(b.first(rows_), x.first(rows_))) return false;
    for (std::size_t k = 0; k < count_; ++k) {
        for (std::size_t j = 0; j < k; ++j) small_[k] -= corner(k, j) * small_[j];
        small_[k] /= corner(k, k);
    }
    for (std::size_t k = count_; k-- > 0;) {
        for (std::size_t j = k + 1; j < count_; ++j) small_[k] -= corner(j, k) * small_[j];
        small_[k] /= corner(k, k);
    }
    for (std::size_t k = 0; k < count_; ++k) {
        x[rows_ + k] = small_[k];
        for (std::size_t r = 0; r < rows_; ++r) x[r] -= condensed_[k * rows_ + r] * small_[k];
    }
    return true;
}

}  // namespace aquagraph::solid
