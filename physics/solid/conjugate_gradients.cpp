#include "physics/solid/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

namespace aquagraph::solid {

namespace {

constexpr std::size_t per_block = 2048;

std::size_t blocks_of(std::size_t count) {
    return (count + per_block - 1) / per_block;
}

// Calls body(first, last) for blocks of [0, count).
template <class Body>
void in_blocks(std::size_t count, BlockLoop loop, const Body& body) {
    if (count <= per_block) return body(std::size_t{0}, count);
    loop(blocks_of(count),
         [&](std::size_t block) { body(block * per_block, std::min(count, (block + 1) * per_block)); });
}

// Sums of blocks in their order, whoever computes them.
template <class Term>
double sum(std::size_t count, BlockLoop loop, std::vector<double>& partial, const Term& term) {
    in_blocks(count, loop, [&](std::size_t first, std::size_t last) {
        double s = 0;
        for (std::size_t k = first; k < last; ++k) s += term(k);
        partial[first / per_block] = s;
    });
    double total = 0;
    for (std::size_t block = 0; block < blocks_of(count); ++block) total += partial[block];
    return total;
}

}  // namespace

ConjugateGradients::ConjugateGradients(const std::vector<int>& column_starts, const std::vector<int>& rows)
    : column_starts_(column_starts), rows_(rows) {}

void ConjugateGradients::build_transpose() {
    const std::size_t n = column_starts_.size() - 1;
    row_starts_.assign(n + 1, 0);
    const auto for_below = [&](const auto& body) {
        for (std::size_t c = 0; c < n; ++c)
            for (int k = column_starts_[c] + 1; k < column_starts_[c + 1]; ++k)
                body(static_cast<std::size_t>(rows_[static_cast<std::size_t>(k)]), static_cast<std::uint32_t>(k),
                     static_cast<std::uint32_t>(c));
    };
    for_below([&](std::size_t row, std::uint32_t, std::uint32_t) { ++row_starts_[row + 1]; });
    for (std::size_t r = 0; r < n; ++r) row_starts_[r + 1] += row_starts_[r];
    nonzero_.resize(row_starts_[n]);
    column_.resize(row_starts_[n]);
    std::vector<std::uint32_t> next(row_starts_.begin(), row_starts_.end() - 1);
    for_below([&](std::size_t row, std::uint32_t k, std::uint32_t c) {
        nonzero_[next[row]] = k;
        column_[next[row]++] = c;
    });
    for (auto* field : {&residual_, &direction_, &product_}) field->assign(n, 0.0);
    partial_sums_.assign(blocks_of(n), 0.0);
}

void ConjugateGradients::multiply(std::span<const double> values, std::span<const double> x, std::span<double> y,
                                  BlockLoop loop) const {
    in_blocks(x.size(), loop, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r) {
            double s = 0;
            for (std::uint32_t k = row_starts_[r]; k < row_starts_[r + 1]; ++k)
                s += values[nonzero_[k]] * x[column_[k]];
            const auto end = static_cast<std::size_t>(column_starts_[r + 1]);
            for (auto k = static_cast<std::size_t>(column_starts_[r]); k < end; ++k)
                s += values[k] * x[static_cast<std::size_t>(rows_[k])];
            y[r] = s;
        }
    });
}

int ConjugateGradients::solve(std::span<const double> values, std::span<const double> b, std::span<double> x,
                              double tolerance, int most, BlockLoop loop) {
    const std::size_t n = b.size();
    if (row_starts_.empty()) build_transpose();
    const auto inverse_diagonal = [&](std::size_t k) {
        return 1 / values[static_cast<std::size_t>(column_starts_[k])];
    };
    std::copy(b.begin(), b.end(), residual_.begin());
    std::fill(x.begin(), x.end(), 0.0);
    const double target =
        tolerance * tolerance * sum(n, loop, partial_sums_, [&](std::size_t k) { return b[k] * b[k]; });
    if (target == 0) return 0;
    double rho = 0;
    for (int iteration = 0; iteration < most; ++iteration) {
        const double rho_new = sum(n, loop, partial_sums_,
                                   [&](std::size_t k) { return residual_[k] * residual_[k] * inverse_diagonal(k); });
        const double beta = iteration == 0 ? 0 : rho_new / rho;
        rho = rho_new;
        in_blocks(n, loop, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k)
                direction_[k] = residual_[k] * inverse_diagonal(k) + (iteration == 0 ? 0 : beta * direction_[k]);
        });
        multiply(values, direction_, product_, loop);
        const double curvature =
            sum(n, loop, partial_sums_, [&](std::size_t k) { return direction_[k] * product_[k]; });
        if (!(curvature > 0)) return -1;
        const double alpha = rho / curvature;
        const double square = sum(n, loop, partial_sums_, [&](std::size_t k) {
            x[k] += alpha * direction_[k];
            residual_[k] -= alpha * product_[k];
            return residual_[k] * residual_[k];
        });
        if (!std::isfinite(square)) return -1;
        if (square <= target) return iteration + 1;
    }
    return -1;
}

}  // namespace aquagraph::solid
