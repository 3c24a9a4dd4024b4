#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/fluid/neighbour_lists.hpp"

namespace aquagraph::fluid {

template <int D>
std::span<const std::uint32_t> SpatialOrder<D>::sort(const Vectors<D>& x, std::size_t n, double spacing) {
    // Columns of cross-section sqrt(W) Δx (2D) or (2Δx)² (3D) hold clusters that are about as long as wide.
    double width = D == 2 ? std::sqrt(double(W)) * spacing : 2 * spacing;
    double low[D], high[D];
    for (int d = 0; d < D; ++d) {
        low[d] = std::numeric_limits<double>::max();
        high[d] = std::numeric_limits<double>::lowest();
        for (std::size_t i = 0; i < n; ++i) {
            low[d] = std::min(low[d], x[d][i]);
            high[d] = std::max(high[d], x[d][i]);
        }
    }
    // They are wider only where a few far particles would need more columns than there are particles.
    const auto along = [&](int d) { return n == 0 ? 1.0 : std::floor((high[d] - low[d]) / width) + 1; };
    for (;; width *= 1.3) {
        double total = 1;
        for (int d = 0; d + 1 < D; ++d) total *= along(d);
        if (!(total > 4.0 * double(n) + 64)) break;
    }
    std::size_t columns_along[D] = {};
    std::size_t columns = 1;
    for (int d = 0; d + 1 < D; ++d) {
        columns_along[d] = std::size_t(along(d));
        columns *= columns_along[d];
    }
    column_of_.resize(n);
    column_start_.assign(columns + 1, 0);
    order_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t column = 0;
        for (int d = 0; d + 1 < D; ++d) {
            auto c = std::min(std::size_t((x[d][i] - low[d]) / width), columns_along[d] - 1);
            if (d == 1 && column % 2 == 1) c = columns_along[d] - 1 - c;  // neighbouring columns follow each other
            column = column * columns_along[d] + c;
        }
        column_of_[i] = std::uint32_t(column);
        ++column_start_[column + 1];
    }
    for (std::size_t c = 0; c < columns; ++c) column_start_[c + 1] += column_start_[c];
    for (std::size_t i = n; i-- > 0;) order_[--column_start_[column_of_[i] + 1]] = std::uint32_t(i);
    // After the loop above column_start_[c + 1] is where column c begins.
    const auto& height = x[D - 1];
    for (std::size_t c = 0; c < columns; ++c) {
        const auto begin = order_.begin() + column_start_[c + 1];
        const auto end = c + 2 <= columns ? order_.begin() + column_start_[c + 2] : order_.end();
        // Ties are broken by the index, so that the order is the same everywhere.
        if (c % 2 == 0)
            std::sort(begin, end,
                      [&](auto a, auto b) { return height[a] < height[b] || (height[a] == height[b] && a < b); });
        else
            std::sort(begin, end,
                      [&](auto a, auto b) { return height[a] > height[b] || (height[a] == height[b] && a < b); });
    }
    return order_;
}

template <int D>
void Reorder<D>::apply(Particles<D>& particles, std::span<const std::uint32_t> order) {
    const std::size_t n = order.size();
    const auto permute = [&](auto& values, auto& buffer) {
        buffer.resize(n);
        for (std::size_t k = 0; k < n; ++k) buffer[k] = values[order[k]];
        std::copy(buffer.begin(), buffer.end(), values.begin());
    };
    permute(particles.id, id_buffer_);
    permute(particles.mass, buffer_);
    permute(particles.deviation, buffer_);
    permute(particles.deviation_rate, buffer_);
    permute(particles.fullness, buffer_);
    if (particles.has_mass_exchange) permute(particles.mass_rate, buffer_);
    for (int d = 0; d < D; ++d) {
        permute(particles.x[d], buffer_);
        permute(particles.v[d], buffer_);
        permute(particles.acceleration[d], buffer_);
        if (!particles.shift[d].empty()) permute(particles.shift[d], buffer_);
    }
}

template class SpatialOrder<2>;
template class SpatialOrder<3>;
template class Reorder<2>;
template class Reorder<3>;

}  // namespace aquagraph::fluid
