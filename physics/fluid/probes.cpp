#include "physics/fluid/probes.hpp"

#include <algorithm>
#include <cmath>

#include "physics/fluid/gradients.hpp"

namespace aquagraph::fluid {

template <int D>
void PlaceInFluid<D>::look(const Fluid<D>& fluid, const Vector& x, const std::optional<Vector>& side,
                           Interpolation interpolation) {
    const Particles<D>& s = fluid.particles;
    const double radius = fluid.kernel.radius();
    lane_.clear();
    weight_.clear();
    double sum = 0;
    const auto away = [&](std::size_t j) {
        Vector dx;
        for (int d = 0; d < D; ++d) dx[d] = s.x[std::size_t(d)][j] - x[d];
        return dx;
    };
    for (std::size_t j = 0; j < s.count; ++j) {
        double r2 = 0;
        for (std::size_t d = 0; d < D; ++d) r2 += (s.x[d][j] - x[int(d)]) * (s.x[d][j] - x[int(d)]);
        if (!(r2 < radius * radius)) continue;
        if (side && away(j).dot(*side) < -0.5 * fluid.spacing) continue;
        const double weight = fluid.kernel.value(std::sqrt(r2)) * s.volume[j];
        if (!(weight > 0)) continue;
        lane_.push_back(std::uint32_t(j));
        weight_.push_back(weight);
        sum += weight;
    }
    for (double& weight : weight_) weight /= sum;
    if (interpolation == Interpolation::shepard) return;

    // With the weights w of Shepard, c = Σ w dx and M = Σ w (dx - c) ⊗ (dx - c), the line fitted to φ has at dx = 0 the
    // value Σ w (1 - (dx - c)·M⁻¹c) φ.
    Vector centre = Vector::Zero();
    for (std::size_t k = 0; k < lane_.size(); ++k) centre += weight_[k] * away(lane_[k]);
    double moment[D * (D + 1) / 2] = {};
    for (std::size_t k = 0; k < lane_.size(); ++k) {
        const Vector dx = away(lane_[k]) - centre;
        for (int a = 0, entry = 0; a < D; ++a)
            for (int b = a; b < D; ++b) moment[entry++] += weight_[k] * dx[a] * dx[b];
    }
    const double least = 0.05 * fluid.spacing * fluid.spacing;
    if (!(invert_moment<D>(moment, least) > least)) return;
    Vector slope = Vector::Zero();
    for (int a = 0, entry = 0; a < D; ++a)
        for (int b = a; b < D; ++b, ++entry) {
            slope[a] += moment[entry] * centre[b];
            if (a != b) slope[b] += moment[entry] * centre[a];
        }
    for (std::size_t k = 0; k < lane_.size(); ++k) weight_[k] *= 1 - (away(lane_[k]) - centre).dot(slope);
}

template <int D>
double PlaceInFluid<D>::of(const Scalars& field) const {
    double sum = 0;
    for (std::size_t k = 0; k < lane_.size(); ++k) sum += weight_[k] * field[lane_[k]];
    return sum;
}

template <int D>
double SurfaceOver<D>::fullness(const Fluid<D>& fluid, double height) const {
    const double radius = fluid.kernel.radius();
    auto near = std::lower_bound(near_.begin(), near_.end(), height - radius,
                                 [](const Near& n, double lowest) { return n.height < lowest; });
    double sum = 0;
    for (; near != near_.end() && near->height < height + radius; ++near) {
        const double up = near->height - height;
        sum += fluid.kernel.value(std::sqrt(near->across2 + up * up)) * near->volume;
    }
    return sum;
}

template <int D>
double SurfaceOver<D>::height(const Fluid<D>& fluid, const std::array<double, D>& foot) {
    const Particles<D>& s = fluid.particles;
    const double radius = fluid.kernel.radius(), bottom = foot[D - 1];
    near_.clear();
    for (std::size_t j = 0; j < s.count; ++j) {
        double across2 = 0;
        for (std::size_t d = 0; d + 1 < D; ++d) across2 += (s.x[d][j] - foot[d]) * (s.x[d][j] - foot[d]);
        if (across2 < radius * radius && s.x[D - 1][j] > bottom - radius)
            near_.push_back({s.x[D - 1][j], across2, s.volume[j]});
    }
    if (near_.empty()) return bottom;
    std::sort(near_.begin(), near_.end(), [](const Near& a, const Near& b) { return a.height < b.height; });

    const double step = 0.5 * fluid.spacing, top = near_.back().height + radius;
    double fullest = 0;
    for (double height = bottom; height < top; height += step) fullest = std::max(fullest, fullness(fluid, height));
    const double threshold = 0.5 * std::clamp(fullest, 0.5, 1.0);
    double above = top, below = top;
    while (fullness(fluid, below) < threshold) {
        if (below <= bottom) return bottom;
        above = below;
        below = std::max(bottom, below - step);
    }
    while (above - below > 1e-9 * fluid.spacing) {
        const double middle = 0.5 * (above + below);
        (fullness(fluid, middle) < threshold ? above : below) = middle;
    }
    return 0.5 * (above + below);
}

template class PlaceInFluid<2>;
template class PlaceInFluid<3>;
template class SurfaceOver<2>;
template class SurfaceOver<3>;

}  // namespace aquagraph::fluid
