#include "physics/coupling/wet_smoothing.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <numbers>

namespace aquagraph::coupling {

WetSmoothing::WetSmoothing(std::vector<Vec2> vertex, const std::vector<std::array<std::size_t, 2>>& segments,
                           double length)
    : length_(length), start_(std::move(vertex)) {
    if (length_ <= 0 || segments.empty()) return;
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    const std::size_t n = start_.size();
    weight_.assign(n, 0.0);
    std::vector<std::size_t> next(n, none);
    for (const auto& [a, b] : segments) {
        const double half = 0.5 * (start_[b] - start_[a]).norm();
        weight_[a] += half;
        weight_[b] += half;
        next[a] = b;
    }
    // G + ℓ⁴ Σ ½ (h + k) d dᵀ, d the second difference between segments of lengths h and k.
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < n; ++k) entries.emplace_back(int(k), int(k), weight_[k]);
    const double straight = std::cos(std::numbers::pi / 6), stiffness = std::pow(length_, 4);
    for (const auto& [a, b] : segments) {
        const std::size_t c = next[b];
        if (c == none) continue;
        const Vec2 before = start_[b] - start_[a], after = start_[c] - start_[b];
        const double h = before.norm(), k = after.norm(), both = h + k;
        if (before.dot(after) < straight * h * k) continue;
        const std::array<std::size_t, 3> at = {a, b, c};
        const std::array<double, 3> difference = {2 / (h * both), -2 / (h * k), 2 / (k * both)};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                entries.emplace_back(int(at[i]), int(at[j]), stiffness * 0.5 * both * difference[i] * difference[j]);
    }
    const auto size = Eigen::Index(n);
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(size);
    first_.push_back(0);
    for (Eigen::Index row = 0; row < size; ++row) {
        unit[row] = 1;
        const Eigen::VectorXd inverse = factor.solve(unit);
        unit[row] = 0;
        const double least = std::numeric_limits<double>::epsilon() * inverse.cwiseAbs().maxCoeff() / double(n);
        for (Eigen::Index k = 0; k < size; ++k) {
            if (std::fabs(inverse[k]) <= least) continue;
            column_.push_back(std::uint32_t(k));
            entry_.push_back(inverse[k]);
        }
        first_.push_back(std::uint32_t(column_.size()));
    }
}

void WetSmoothing::smooth(std::span<const Vec2> values, std::span<Vec2> smoothed) const {
    for (std::size_t row = 0; row + 1 < first_.size(); ++row) {
        Vec2 sum = Vec2::Zero();
        for (auto k = first_[row]; k < first_[row + 1]; ++k)
            sum += entry_[k] * weight_[column_[k]] * values[column_[k]];
        smoothed[row] = sum;
    }
}

void WetSmoothing::smooth_positions(std::span<const Vec2> positions, std::span<Vec2> smoothed) const {
    for (std::size_t row = 0; row + 1 < first_.size(); ++row) {
        Vec2 sum = start_[row];
        for (auto k = first_[row]; k < first_[row + 1]; ++k) {
            const std::size_t from = column_[k];
            sum += entry_[k] * weight_[from] * (positions[from] - start_[from]);
        }
        smoothed[row] = sum;
    }
}

void WetSmoothing::gather(std::span<const Vec2> forces, std::span<Vec2> nodal) const {
    for (std::size_t row = 0; row + 1 < first_.size(); ++row) {
        Vec2 sum = Vec2::Zero();
        for (auto k = first_[row]; k < first_[row + 1]; ++k) sum += entry_[k] * forces[column_[k]];
        nodal[row] = weight_[row] * sum;
    }
}

}  // namespace aquagraph::coupling
