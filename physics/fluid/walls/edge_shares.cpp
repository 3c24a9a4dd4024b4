#include "physics/fluid/walls/edge_shares.hpp"

#include <algorithm>
#include <cmath>

#include "physics/fluid/kernel.hpp"

namespace aquagraph::fluid {

namespace {
double smooth_step(double u) {
    u = std::clamp(u, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

// Panels that turn by less than 16° against a side belong to it.
bool goes_on(const auto& normal, const auto& side) {
    return normal.dot(side) > 0.96;
}
}  // namespace

template <int D>
void SharedEdge<D>::update(const Panels<D>& panels) {
    if constexpr (D == 2) {
        const auto a = std::size_t(panel[0]), b = std::size_t(panel[1]);
        point = panels.position[std::size_t(vertex[0])];
        along = {Vec2(-panels.tangent[a]), panels.tangent[b]};
        normal = {panels.normal[a], panels.normal[b]};
        acute = along[0].dot(along[1]) > 0;
    }
}

template <int D>
double SharedEdge<D>::share(std::size_t side, const Vec<D>& x) const {
    const Vec<D> from = x - point;
    const std::size_t other = 1 - side;
    const double own = acute ? -from.dot(normal[other]) : from.dot(along[side]),
                 others = acute ? -from.dot(normal[side]) : from.dot(along[other]);
    const double a = std::max(0.0, own + softness), b = std::max(0.0, others + softness);
    return a + b == 0 ? 0.5 : smooth_step(a / (a + b));
}

template <int D>
void EdgeShares<D>::find_edges(const Panels<D>& panels, const std::vector<int>& patch, double spacing, double reach) {
    reach_ = reach;
    edges_.clear();
    if constexpr (D == 2) {
        for (const Joint<2>& joint : panels.joints) {
            const auto a = std::size_t(joint.panel[0]), b = std::size_t(joint.panel[1]);
            if (panels.panels[a].wet || panels.panels[b].wet || patch[a] == patch[b] ||
                panels.height(a, panels.centroid[b]) >= 0 || panels.normal[a].dot(panels.normal[b]) < -0.5 - 1e-9)
                continue;
            SharedEdge<2> edge{
                .panel = joint.panel, .patch = {patch[a], patch[b]}, .vertex = joint.vertex, .softness = spacing};
            edge.update(panels);
            // A place behind the edge that somebody sees is within R of both sides or nearly, and beyond a concave
            // corner of the fluid, in front of the edge, less far. R is 0.8 of the reach.
            const auto is_apart = [&](std::size_t k) {
                bool in_front = false;
                for (const std::size_t side : {0u, 1u}) {
                    if (patch[k] == edge.patch[side] && goes_on(panels.normal[k], edge.normal[side])) return true;
                    in_front = in_front || ((panels.start(k) - edge.point).dot(edge.normal[side]) > -1e-9 * reach &&
                                            (panels.end(k) - edge.point).dot(edge.normal[side]) > -1e-9 * reach);
                }
                const double s =
                    std::clamp((edge.point - panels.start(k)).dot(panels.tangent[k]), 0.0, panels.measure[k]);
                return (edge.point - panels.start(k) - s * panels.tangent[k]).norm() > (in_front ? 0.75 : 1.5) * reach;
            };
            bool alone = true;
            for (std::size_t k = 0; k < panels.size() && alone; ++k) alone = is_apart(k);
            if (alone) edges_.push_back(edge);
        }
    } else {
        static_cast<void>(panels);
        static_cast<void>(patch);
        static_cast<void>(spacing);
    }
}

template <int D>
void EdgeShares<D>::update(const Panels<D>& panels) {
    for (SharedEdge<D>& edge : edges_) edge.update(panels);
}

template <int D>
void EdgeShares<D>::clear() {
    shares_.clear();
    images_.clear();
}

template <int D>
void EdgeShares<D>::add(std::uint32_t ghost, int patch, const Vec<D>& normal, const Vec<D>& image) {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const SharedEdge<D>& edge = edges_[e];
        for (const std::size_t side : {0u, 1u}) {
            if (patch != edge.patch[side] || !goes_on(normal, edge.normal[side])) continue;
            if ((image - edge.point).squaredNorm() > 4 * reach_ * reach_) continue;
            shares_.push_back({ghost, std::uint32_t(e), std::uint32_t(side)});
            images_.push_back(image);
        }
    }
}

template <int D>
void EdgeShares<D>::weigh() {
    const WendlandC2<D> kernel(0.5 * reach_);
    for (std::size_t k = 0; k < shares_.size(); ++k) {
        double present[2] = {0, 0};
        for (std::size_t l = 0; l < shares_.size(); ++l)
            if (shares_[l].edge == shares_[k].edge)
                present[shares_[l].side == shares_[k].side ? 0 : 1] += kernel.value((images_[k] - images_[l]).norm());
        shares_[k].others = smooth_step(2 * present[1] / present[0]);
    }
}

template <int D>
std::span<const typename EdgeShares<D>::Share> EdgeShares<D>::of(std::size_t begin, std::size_t end) const {
    const auto before = [](const Share& share, std::size_t ghost) { return share.ghost < ghost; };
    const auto from = std::lower_bound(shares_.begin(), shares_.end(), begin, before);
    return {from, std::lower_bound(from, shares_.end(), end, before)};
}

template <int D>
double EdgeShares<D>::weight(const Share& share, const Vec<D>& x) const {
    return 1 - edges_[share.edge].share(1 - share.side, x) * share.others;
}

template <int D>
bool EdgeShares<D>::seen_through(std::size_t ghost, int patch) const {
    for (const Share& share : of(ghost, ghost + 1))
        if (edges_[share.edge].patch[1 - share.side] == patch) return true;
    return false;
}

template struct SharedEdge<2>;
template struct SharedEdge<3>;
template class EdgeShares<2>;
template class EdgeShares<3>;

}  // namespace aquagraph::fluid
