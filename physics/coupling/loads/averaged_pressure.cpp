#include "physics/coupling/loads/averaged_pressure.hpp"

#include <algorithm>
#include <limits>

namespace aquagraph::coupling {

namespace {
double distance2_to_segment(const fluid::Panels<2>& panels, std::size_t k, const Vec2& x) {
    const double along = std::clamp((x - panels.start(k)).dot(panels.tangent[k]), 0.0, panels.measure[k]);
    return (x - panels.start(k) - along * panels.tangent[k]).squaredNorm();
}
}  // namespace

void AveragedPressureLoad::rebuild(const fluid::Particles<2>& s, const fluid::Panels<2>& panels, double reach) {
    boxes_.resize(s.blocks());
    for (std::size_t block = 0; block < s.blocks(); ++block) {
        auto& [low, high] = boxes_[block];
        low.setConstant(std::numeric_limits<double>::infinity());
        high = -low;
        const fluid::LaneRange lanes = lanes_of_block(s, block);
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            const Vec2 x(s.x[0][i], s.x[1][i]);
            low = low.cwiseMin(x);
            high = high.cwiseMax(x);
        }
    }
    wet_.clear();
    candidates_.clear();
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (!panels.panels[k].wet) continue;
        const auto begin = std::uint32_t(candidates_.size());
        const Vec2 low = panels.start(k).cwiseMin(panels.end(k)).array() - reach,
                   high = panels.start(k).cwiseMax(panels.end(k)).array() + reach;
        for (std::size_t block = 0; block < s.blocks(); ++block) {
            if ((boxes_[block][1].array() < low.array()).any() || (boxes_[block][0].array() > high.array()).any())
                continue;
            const fluid::LaneRange lanes = lanes_of_block(s, block);
            for (std::size_t i = lanes.begin; i < lanes.end; ++i)
                if (distance2_to_segment(panels, k, Vec2(s.x[0][i], s.x[1][i])) < reach * reach)
                    candidates_.push_back(std::uint32_t(i));
        }
        wet_.push_back({std::uint32_t(k), begin, std::uint32_t(candidates_.size())});
    }
    pressure_.assign(wet_.size(), 0.0);
    count_.assign(wet_.size(), 0);
}

void AveragedPressureLoad::compute(const fluid::Particles<2>& s, const fluid::Panels<2>& panels, double radius,
                                   double behind, std::size_t block) {
    const std::size_t end = std::min(wet_.size(), (block + 1) * panels_per_block);
    for (std::size_t w = block * panels_per_block; w < end; ++w) {
        const std::size_t k = wet_[w].panel;
        double sum = 0;
        std::size_t n = 0;
        for (std::uint32_t c = wet_[w].begin; c < wet_[w].end; ++c) {
            const std::size_t i = candidates_[c];
            const Vec2 x(s.x[0][i], s.x[1][i]);
            if (panels.height(k, x) < -behind || distance2_to_segment(panels, k, x) >= radius * radius) continue;
            sum += s.p[i];
            ++n;
        }
        pressure_[w] = n > 0 ? sum / double(n) : 0;
        count_[w] = n;
    }
}

void AveragedPressureLoad::spread(const fluid::Panels<2>& panels, std::vector<Vec2>& vertex_forces) const {
    vertex_forces.assign(panels.position.size(), Vec2::Zero());
    for (std::size_t w = 0; w < wet_.size(); ++w) {
        const std::size_t k = wet_[w].panel;
        const Vec2 half = -0.5 * pressure_[w] * panels.measure[k] * panels.normal[k];
        for (const int v : panels.panels[k].vertex) vertex_forces[std::size_t(v)] += half;
    }
}

}  // namespace aquagraph::coupling
