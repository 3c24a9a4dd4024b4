#include "physics/geometry/inside.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace aquagraph::geometry {

template <int D>
InsideTest<D>::InsideTest(const Surface<D>& surface) : surface_(surface) {
    const std::size_t n = surface_.facets.size();
    if (n == 0) {
        low_ = Vec<D>::Ones();
        high_ = Vec<D>::Zero();
        return;
    }
    std::tie(low_, high_) = bounds(surface_);
    const int along = std::clamp(int(std::pow(double(n), 1.0 / (D - 1))), 1, D == 2 ? 4096 : 512);
    std::size_t cells = 1;
    for (std::size_t d = 0; d + 1 < D; ++d) {
        const double width = high_[Eigen::Index(d)] - low_[Eigen::Index(d)];
        cells_[d] = along;
        inverse_width_[d] = width > 0 ? along / width : 0;
        cells *= std::size_t(along);
    }
    const auto cell = [&](std::size_t d, double x) {
        return std::clamp(int((x - low_[Eigen::Index(d)]) * inverse_width_[d]), 0, cells_[d] - 1);
    };
    // Twice over the facets: count, then put.
    cell_start_.assign(cells + 1, 0);
    for (const bool put : {false, true}) {
        std::vector<int> next(cell_start_.begin(), cell_start_.end());
        for (std::size_t f = 0; f < n; ++f) {
            std::array<int, 2> from{0, 0}, to{0, 0};
            for (std::size_t d = 0; d + 1 < D; ++d) {
                double least = surface_.vertex(f, 0)[Eigen::Index(d)], most = least;
                for (std::size_t k = 1; k < D; ++k) {
                    least = std::min(least, surface_.vertex(f, k)[Eigen::Index(d)]);
                    most = std::max(most, surface_.vertex(f, k)[Eigen::Index(d)]);
                }
                from[d] = cell(d, least);
                to[d] = cell(d, most);
            }
            for (int j = from[1]; j <= to[1]; ++j)
                for (int i = from[0]; i <= to[0]; ++i) {
                    const auto c = std::size_t(j) * std::size_t(cells_[0]) + std::size_t(i);
                    if (put)
                        cell_facets_[std::size_t(next[c]++)] = int(f);
                    else
                        ++cell_start_[c + 1];
                }
        }
        if (put) break;
        for (std::size_t c = 0; c < cells; ++c) cell_start_[c + 1] += cell_start_[c];
        cell_facets_.resize(std::size_t(cell_start_[cells]));
    }
}

template <int D>
bool InsideTest<D>::passes(std::size_t facet, const Vec<D>& x) const {
    if constexpr (D == 2) {
        return (surface_.vertex(facet, 0).x() > x.x()) != (surface_.vertex(facet, 1).x() > x.x());
    } else {
        // Seen along z: an odd number of the three edges lies on one side of the place along y.
        bool odd = false;
        for (std::size_t k = 0; k < 3; ++k) {
            int i = surface_.facets[facet][k], j = surface_.facets[facet][(k + 1) % 3];
            if (i > j) std::swap(i, j);
            const Vec<3>&a = surface_.vertices[std::size_t(i)], &b = surface_.vertices[std::size_t(j)];
            if ((a.x() > x.x()) == (b.x() > x.x())) continue;
            if (a.y() + (x.x() - a.x()) / (b.x() - a.x()) * (b.y() - a.y()) > x.y()) odd = !odd;
        }
        return odd;
    }
}

template <int D>
double InsideTest<D>::height(std::size_t facet, const Vec<D>& x) const {
    const Vec<D> n = surface_.front(facet);
    double least = surface_.vertex(facet, 0)[D - 1], most = least;
    for (std::size_t k = 1; k < D; ++k) {
        least = std::min(least, surface_.vertex(facet, k)[D - 1]);
        most = std::max(most, surface_.vertex(facet, k)[D - 1]);
    }
    const Vec<D> from = x - surface_.vertex(facet, 0);
    double across = 0;
    for (int d = 0; d + 1 < D; ++d) across += from[d] * n[d];
    const double at = surface_.vertex(facet, 0)[D - 1] - across / n[D - 1];
    // A facet that stands upright but for rounding: anywhere within it will do, another one makes up for it.
    return std::isfinite(at) ? std::clamp(at, least, most) : least;
}

template <int D>
bool InsideTest<D>::operator()(const Vec<D>& x) const {
    if (!((x.array() >= low_.array()).all() && (x.array() <= high_.array()).all())) return false;
    std::size_t c = 0;
    for (std::size_t d = D - 1; d-- > 0;)
        c = c * std::size_t(cells_[d]) +
            std::size_t(
                std::clamp(int((x[Eigen::Index(d)] - low_[Eigen::Index(d)]) * inverse_width_[d]), 0, cells_[d] - 1));
    bool odd = false;
    for (int k = cell_start_[c]; k < cell_start_[c + 1]; ++k) {
        const auto f = std::size_t(cell_facets_[std::size_t(k)]);
        if (passes(f, x) && height(f, x) > x[D - 1]) odd = !odd;
    }
    return odd;
}

template class InsideTest<2>;
template class InsideTest<3>;

}  // namespace aquagraph::geometry
