#include "physics/fluid/walls/sight.hpp"

#include <cmath>
#include <limits>

namespace aquagraph::fluid {

template <int D>
void Bins<D>::lay(const Vec<D>& low, const Vec<D>& high, double width) {
    origin_ = low;
    inverse_width_ = 1 / width;
    for (int d = 0; d < D; ++d)
        n_[std::size_t(d)] = std::max(1, int(std::floor((high[d] - low[d]) * inverse_width_)) + 1);
}

template <int D>
typename Bins<D>::Index Bins<D>::index(const Vec<D>& x) const {
    Index cell;
    for (int d = 0; d < D; ++d)
        cell[std::size_t(d)] =
            int(std::clamp(std::floor((x[d] - origin_[d]) * inverse_width_), 0.0, double(n_[std::size_t(d)] - 1)));
    return cell;
}

template <int D>
int Bins<D>::number(const Index& cell) const {
    int at = 0;
    for (std::size_t d = D; d-- > 0;) at = at * n_[d] + cell[d];
    return at;
}

template <int D>
int Bins<D>::at(const Vec<D>& x) const {
    for (int d = 0; d < D; ++d) {
        const double along = (x[d] - origin_[d]) * inverse_width_;
        if (!(along >= 0 && along < n_[std::size_t(d)])) return -1;
    }
    return number(index(x));
}

template <int D>
Vec<D> Bins<D>::centre(const Index& cell) const {
    Vec<D> x = origin_;
    for (int d = 0; d < D; ++d) x[d] += (cell[std::size_t(d)] + 0.5) / inverse_width_;
    return x;
}

template <int D>
std::size_t Bins<D>::size() const {
    std::size_t cells = 1;
    for (const int n : n_) cells *= std::size_t(n);
    return cells;
}

namespace {

// Distance from x to a panel, at most: exact in 2D, to the panel's enclosing ball in 3D.
template <int D>
double distance_to(const Panels<D>& panels, std::size_t k, const Vec<D>& x) {
    if constexpr (D == 2) {
        const double s = std::clamp((x - panels.start(k)).dot(panels.tangent[k]), 0.0, panels.measure[k]);
        return (x - panels.start(k) - s * panels.tangent[k]).norm();
    } else {
        return std::fabs(panels.height(k, x));
    }
}

// The segment from a to b passes through panel k. Panels overlap by a hair, or sight would slip between two of them.
template <int D>
bool crosses(const Panels<D>& panels, std::size_t k, const Vec<D>& a, const Vec<D>& b) {
    const double at_a = panels.height(k, a), at_b = panels.height(k, b);
    if (!(at_a * at_b < 0)) return false;
    const Vec<D> through = a + at_a / (at_a - at_b) * (b - a);
    for (const double shape : panels.shape_functions(k, through))
        if (shape < -1e-9) return false;
    return true;
}

}  // namespace

template <int D>
void Sight<D>::prepare(const Particles<D>& particles, const Panels<D>& panels, double reach, double tolerance) {
    panels_ = &panels;
    used_ = 0;
    Vec<D> low = Vec<D>::Constant(std::numeric_limits<double>::max()), high = -low;
    for (std::size_t k = 0; k < panels.size(); ++k)
        for (std::size_t a = 0; a < D; ++a) {
            low = low.cwiseMin(panels.vertex(k, a));
            high = high.cwiseMax(panels.vertex(k, a));
        }
    if (panels.size() > 0) {
        bins_.lay(low - Vec<D>::Constant(reach), high + Vec<D>::Constant(reach), reach);
        of_bin_.assign(bins_.size(), -1);
        const double half_diagonal = 0.5 * std::sqrt(double(D)) * bins_.width();
        for (std::size_t k = 0; k < panels.size(); ++k) {
            Vec<D> from = panels.start(k), to = from;
            for (std::size_t a = 1; a < D; ++a) {
                from = from.cwiseMin(panels.vertex(k, a));
                to = to.cwiseMax(panels.vertex(k, a));
            }
            bins_.each(bins_.index(from - Vec<D>::Constant(reach)), bins_.index(to + Vec<D>::Constant(reach)),
                       [&](const typename Bins<D>::Index& cell) {
                           // A long slanted panel passes far from most cells of its bounding box.
                           if (distance_to(panels, k, bins_.centre(cell)) > reach + half_diagonal * 1.0001) return;
                           int& number = of_bin_[std::size_t(bins_.number(cell))];
                           if (number < 0) {
                               if (used_ == cells_.size()) cells_.emplace_back();
                               cells_[used_].panel.clear();
                               number = int(used_++);
                           }
                           cells_[std::size_t(number)].panel.push_back(int(k));
                       });
        }
        for (std::size_t c = 0; c < used_; ++c) {
            Cell& cell = cells_[c];
            cell.open = true;
            for (std::size_t k = 0; k < cell.panel.size() && cell.open; ++k) {
                const auto panel = std::size_t(cell.panel[k]);
                const double hair = -1e-9 * (panels.vertex(panel, 1) - panels.start(panel)).norm();
                for (const int other : cell.panel)
                    for (std::size_t a = 0; a < D; ++a)
                        if (panels.height(panel, panels.vertex(std::size_t(other), a)) < hair) cell.open = false;
            }
        }
    }

    place_.resize(particles.size());
    cell_.assign(particles.size(), nullptr);
    const double in_front = 1e-3 * tolerance;
    const auto settle = [&](std::size_t i) {
        Vec<D>& x = place_[i];
        for (int d = 0; d < D; ++d) x[d] = particles.x[std::size_t(d)][i];
        const int bin = used_ > 0 ? bins_.at(x) : -1;
        const int cell = bin < 0 ? -1 : of_bin_[std::size_t(bin)];
        if (cell < 0) return;
        cell_[i] = &cells_[std::size_t(cell)];
        for (const int k : cell_[i]->panel) {
            const auto panel = std::size_t(k);
            const double h = panels.height(panel, x);
            if (!(h < in_front && h > -tolerance)) continue;
            const auto shape = panels.shape_functions(panel, x);
            if (*std::min_element(shape.begin(), shape.end()) >= 0) x += (in_front - h) * panels.normal[panel];
        }
    };
    for (std::size_t i = 0; i < particles.count; ++i) settle(i);
    for (std::size_t g = 0; g < particles.ghost_count; ++g) settle(particles.ghost_begin() + g);
}

template <int D>
bool Sight<D>::sees(std::size_t i, const Vec<D>& x) const {
    for (const int k : cell_[i]->panel)
        if (crosses(*panels_, std::size_t(k), place_[i], x)) return false;
    return true;
}

template <int D>
std::uint8_t Sight<D>::lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const {
    unsigned seen = 0;
    for (unsigned l = 0; l < W; ++l)
        if ((in_reach >> l) & 1u) seen |= unsigned(sees(i, place_[cluster * W + l])) << l;
    return std::uint8_t(seen);
}

template class Bins<2>;
template class Bins<3>;
template class Sight<2>;
template class Sight<3>;

}  // namespace aquagraph::fluid
