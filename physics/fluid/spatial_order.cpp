#include "physics/fluid/spatial_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aquagraph::fluid {

namespace {
constexpr std::size_t particles_per_part = 4096;
constexpr std::size_t columns_per_part = 16;
}  // namespace

template <int D>
std::span<const std::uint32_t> SpatialOrder<D>::sort(const Vectors<D>& x, std::size_t n, double spacing,
                                                     BlockLoop loop) {
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
    places_.resize(n);
    column_start_.assign(columns + 1, 0);
    order_.resize(n);
    loop((n + particles_per_part - 1) / particles_per_part, [&](std::size_t part) {
        const std::size_t end = std::min(n, (part + 1) * particles_per_part);
        for (std::size_t i = part * particles_per_part; i < end; ++i) {
            std::size_t column = 0;
            for (int d = 0; d + 1 < D; ++d) {
                auto c = std::min(std::size_t((x[d][i] - low[d]) / width), columns_along[d] - 1);
                if (d == 1 && column % 2 == 1) c = columns_along[d] - 1 - c;  // neighbouring columns follow each other
                column = column * columns_along[d] + c;
            }
            column_of_[i] = std::uint32_t(column);
        }
    });
    for (std::size_t i = 0; i < n; ++i) ++column_start_[column_of_[i] + 1];
    for (std::size_t c = 0; c < columns; ++c) column_start_[c + 1] += column_start_[c];
    // Every second column runs backwards: its heights are taken negative.
    const double* const height = x[D - 1].data();
    for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t column = column_of_[i];
        places_[column_start_[column]++] = {column % 2 == 0 ? height[i] : -height[i], std::uint32_t(i)};
    }
    for (std::size_t c = columns; c > 0; --c) column_start_[c] = column_start_[c - 1];
    column_start_[0] = 0;
    loop((columns + columns_per_part - 1) / columns_per_part, [&](std::size_t part) {
        const std::size_t end = std::min(columns, (part + 1) * columns_per_part);
        for (std::size_t c = part * columns_per_part; c < end; ++c) {
            // Ties are broken by the index, so that the order is the same everywhere.
            std::sort(places_.begin() + column_start_[c], places_.begin() + column_start_[c + 1],
                      [](const Place& a, const Place& b) {
                          return a.height < b.height || (a.height == b.height && a.particle < b.particle);
                      });
            for (std::uint32_t k = column_start_[c]; k < column_start_[c + 1]; ++k) order_[k] = places_[k].particle;
        }
    });
    return order_;
}

template <int D>
void Reorder<D>::apply(Particles<D>& particles, std::span<const std::uint32_t> order, BlockLoop loop) {
    const std::size_t n = order.size();
    fields_.clear();
    const auto carry = [&](Scalars& field) { fields_.push_back(&field); };
    carry(particles.mass);
    carry(particles.deviation);
    carry(particles.deviation_rate);
    carry(particles.fullness);
    if (particles.has_mass_exchange) carry(particles.mass_rate);
    for (int d = 0; d < D; ++d) {
        carry(particles.x[d]);
        carry(particles.v[d]);
        carry(particles.acceleration[d]);
        if (!particles.shift[d].empty()) carry(particles.shift[d]);
    }
    buffers_.resize(fields_.size());
    const auto fit = [n](auto& buffer) {
        if (n > buffer.capacity()) buffer.reserve(n + n / 4 + 16 * W);
        buffer.resize(n);
    };
    for (auto& buffer : buffers_) fit(buffer);
    fit(id_buffer_);
    // Out of place, then back: a block reads what others will have written over.
    const std::size_t parts = (n + particles_per_part - 1) / particles_per_part;
    const auto range = [n](std::size_t part) {
        return LaneRange{part * particles_per_part, std::min(n, (part + 1) * particles_per_part)};
    };
    loop(parts, [&](std::size_t part) {
        const LaneRange r = range(part);
        for (std::size_t f = 0; f < fields_.size(); ++f)
            for (std::size_t k = r.begin; k < r.end; ++k) buffers_[f][k] = (*fields_[f])[order[k]];
        for (std::size_t k = r.begin; k < r.end; ++k) id_buffer_[k] = particles.id[order[k]];
    });
    loop(parts, [&](std::size_t part) {
        const LaneRange r = range(part);
        const auto back = [&](const auto& from, auto& to) {
            std::copy(from.begin() + std::ptrdiff_t(r.begin), from.begin() + std::ptrdiff_t(r.end),
                      to.begin() + std::ptrdiff_t(r.begin));
        };
        for (std::size_t f = 0; f < fields_.size(); ++f) back(buffers_[f], *fields_[f]);
        back(id_buffer_, particles.id);
    });
}

template class SpatialOrder<2>;
template class SpatialOrder<3>;
template class Reorder<2>;
template class Reorder<3>;

}  // namespace aquagraph::fluid
