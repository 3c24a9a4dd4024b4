// Which particles see which parts of the walls.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "physics/fluid/walls/normal_flux.hpp"

namespace aquagraph::fluid {

namespace {

// True if two panels lie in one plane, face the same way and cover an area both.
template <int D>
bool overlap(const Panels<D>& panels, std::size_t k, std::size_t l) {
    constexpr double hair = 1e-6;
    if (panels.normal[k].dot(panels.normal[l]) < 1 - hair) return false;
    const double size = (panels.vertex(k, 1) - panels.start(k)).norm();
    for (std::size_t a = 0; a < D; ++a)
        if (std::fabs(panels.height(k, panels.vertex(l, a))) > hair * size) return false;
    // Apart if one has the other beyond one of its sides.
    for (const auto& [one, other] : {std::pair(k, l), std::pair(l, k)})
        for (std::size_t side = 0; side < D; ++side) {
            bool beyond = true;
            for (std::size_t a = 0; a < D; ++a)
                beyond = beyond && panels.shape_functions(one, panels.vertex(other, a))[side] < hair;
            if (beyond) return false;
        }
    return true;
}

}  // namespace

template <int D>
void NormalFluxWalls<D>::repeat(const Periodic<D>& periodic) {
    images.periodic = periodic;
    panels.update_geometry();
    const std::size_t n = panels.size();
    const int vertices = int(panels.position.size());
    for (int copy = 1, first = vertices; copy < Periodic<D>::copies; ++copy) {
        if (!periodic.exists(copy)) continue;
        for (int v = 0; v < vertices; ++v) {
            copied_.push_back({v, copy});
            panels.position.push_back(panels.position[std::size_t(v)] + periodic.shift(copy));
            panels.velocity.push_back(panels.velocity[std::size_t(v)]);
        }
        for (std::size_t k = 0; k < n; ++k) {
            Panel<D> panel = panels.panels[k];
            for (int& v : panel.vertex) v += first;
            panel.wet = false;
            panels.panels.push_back(panel);
        }
        first += vertices;
    }
    panels.copies = panels.size() - n;
    panels.update_geometry();
    for (std::size_t l = n; l < panels.size(); ++l)
        for (std::size_t k = 0; k < n; ++k)
            if (overlap(panels, k, l))
                throw std::invalid_argument("wall '" + panels.name(k) +
                                            "' is longer than the period and lies on its own copy, which walls of "
                                            "normal fluxes would count twice: let it end at the edge of the domain");
}

template <int D>
void NormalFluxWalls<D>::place_copies() {
    const std::size_t originals = panels.position.size() - copied_.size();
    for (std::size_t v = 0; v < copied_.size(); ++v) {
        const auto from = std::size_t(copied_[v].from);
        panels.position[originals + v] = panels.position[from] + images.periodic.shift(copied_[v].copy);
        panels.velocity[originals + v] = panels.velocity[from];
    }
}

template <int D>
void NormalFluxWalls<D>::update_geometry() {
    place_copies();
    panels.update_geometry();
    points.update(panels);
}

template <int D>
void NormalFluxWalls<D>::rebuild(Particles<D>& particles, double spacing, double reach, BlockLoop loop) {
    spacing_ = spacing;
    place_copies();
    panels.update_geometry();
    points.cut(panels, spacing);
    if (is_periodic())
        images.rebuild(particles, spacing, reach, Vec<D>::Zero(), loop);
    else
        particles.resize(particles.count, 0);
    sight.prepare(particles, panels, reach, 0.5 * spacing);
    bin_points(reach);
    // Joints of each panel, by a counting sort.
    side_end_.assign(panels.size() + 1, 0);
    side_.resize(2 * panels.joints.size());
    for (const Joint<D>& joint : panels.joints)
        for (const int k : joint.panel) ++side_end_[std::size_t(k) + 1];
    for (std::size_t k = 0; k < panels.size(); ++k) side_end_[k + 1] += side_end_[k];
    for (std::size_t j = 0; j < panels.joints.size(); ++j)
        for (const int k : panels.joints[j].panel) side_[side_end_[std::size_t(k)]++] = std::uint32_t(j);
    gamma_.assign(particles.clusters() * W, 1.0);
    near_.resize(particles.blocks());
    loop(near_.size(), [&](std::size_t block) { collect(particles, reach, block); });
}

template <int D>
void NormalFluxWalls<D>::bin_points(double reach) {
    Vec<D> low = Vec<D>::Constant(std::numeric_limits<double>::max()), high = -low;
    for (std::size_t s = 0; s < points.size(); ++s) {
        low = low.cwiseMin(points.place(s));
        high = high.cwiseMax(points.place(s));
    }
    if (points.size() == 0) low = high = Vec<D>::Zero();
    bins_.lay(low - Vec<D>::Constant(reach), high + Vec<D>::Constant(reach), reach);
    // Counting sort: points of a bin in ascending order.
    bin_end_.assign(bins_.size() + 1, 0);
    bin_point_.resize(points.size());
    const auto bin = [&](std::size_t s) { return std::size_t(bins_.number(bins_.index(points.place(s)))); };
    for (std::size_t s = 0; s < points.size(); ++s) ++bin_end_[bin(s) + 1];
    for (std::size_t b = 0; b + 1 < bin_end_.size(); ++b) bin_end_[b + 1] += bin_end_[b];
    for (std::size_t s = 0; s < points.size(); ++s) bin_point_[bin_end_[bin(s)]++] = std::uint32_t(s);
    // bin_end_[b] is now where bin b ends.
}

template <int D>
void NormalFluxWalls<D>::collect(const Particles<D>& particles, double reach, std::size_t block) {
    NearBlock& out = near_[block];
    out.near.clear();
    out.point.clear();
    out.piece.clear();
    out.pairs = 0;
    const LaneRange lanes = lanes_of_block(particles, block);
    const double in_front = 1e-4 * spacing_;
    thread_local std::vector<std::uint32_t> candidates;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        if (!sight.near_wall(i)) continue;
        const Vec<D>& x = sight.place(i);
        candidates.clear();
        typename Bins<D>::Index low = bins_.index(x - Vec<D>::Constant(reach)),
                                high = bins_.index(x + Vec<D>::Constant(reach));
        bins_.each(low, high, [&](const typename Bins<D>::Index& cell) {
            const auto b = std::size_t(bins_.number(cell));
            for (std::uint32_t k = b == 0 ? 0 : bin_end_[b - 1]; k < bin_end_[b]; ++k)
                if ((points.place(bin_point_[k]) - x).squaredNorm() < reach * reach)
                    candidates.push_back(bin_point_[k]);
        });
        if (candidates.empty()) continue;
        std::sort(candidates.begin(), candidates.end());  // panel by panel
        const bool open = sight.sees_everything(i);
        const std::size_t first_point = out.point.size(), first_piece = out.piece.size();
        for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
            const std::int32_t panel = points.cell[candidates[begin]].panel;
            while (end < candidates.size() && points.cell[candidates[end]].panel == panel) ++end;
            if (panels.height(std::size_t(panel), x) <= 0) continue;
            const std::size_t before = out.point.size();
            for (std::size_t k = begin; k < end; ++k) {
                const std::uint32_t s = candidates[k];
                if (open || sight.sees(i, points.place(s) + in_front * panels.normal[std::size_t(panel)]))
                    out.point.push_back(s);
            }
            const std::size_t seen = out.point.size() - before;
            if (seen == end - begin) {
                out.piece.push_back(panel);
            } else {
                for (std::size_t k = before; k < out.point.size(); ++k)
                    out.piece.push_back(~std::int32_t(out.point[k]));
            }
        }
        if (out.point.size() == first_point) {
            out.piece.resize(first_piece);
            continue;
        }
        out.pairs += out.point.size() - first_point;
        while ((out.point.size() - first_point) % W != 0) out.point.push_back(std::uint32_t(points.size()));
        out.near.push_back({std::uint32_t(i), std::uint32_t(out.point.size()), std::uint32_t(out.piece.size()),
                            !open && sees_an_end(x, reach, out.piece, first_piece)});
    }
    const std::size_t n = out.near.size();
    for (Scalars* values : {&out.C0, &out.C1, &out.normals, &out.friction, &out.reaction}) values->clear();
    out.C0.resize(n * D);
    out.normals.resize(n * D);
    out.C1.resize(n * D * D);
    out.friction.resize(n * D);
    out.reaction.resize(n * D);
}

// True if a panel that is seen from x ends, within reach, at one that is seen from behind: there a shadow begins.
template <int D>
bool NormalFluxWalls<D>::sees_an_end(const Vec<D>& x, double reach, const std::vector<std::int32_t>& piece,
                                     std::size_t first) const {
    std::size_t last = panels.size();
    for (std::size_t p = first; p < piece.size(); ++p) {
        const std::size_t k = panel_of(piece[p]);
        if (k == last) continue;
        last = k;
        for (std::uint32_t at = k == 0 ? 0 : side_end_[k - 1]; at < side_end_[k]; ++at) {
            const Joint<D>& joint = panels.joints[side_[at]];
            const std::size_t other = std::size_t(joint.panel[std::size_t(joint.panel[0]) == k ? 1 : 0]);
            if (panels.height(other, x) > 0) continue;
            const auto vertex = [&](std::size_t v) -> const Vec<D>& {
                return panels.position[std::size_t(joint.vertex[v])];
            };
            Vec<D> nearest = vertex(0);
            if constexpr (D == 3) {
                const Vec3 along = vertex(1) - vertex(0);
                nearest += std::clamp((x - vertex(0)).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
            }
            if ((x - nearest).squaredNorm() < reach * reach) return true;
        }
    }
    return false;
}

template <int D>
std::size_t NormalFluxWalls<D>::near_wall_count() const {
    std::size_t n = 0;
    for (const NearBlock& block : near_) n += block.near.size();
    return n;
}

template <int D>
std::size_t NormalFluxWalls<D>::floored() const {
    std::size_t n = 0;
    for (const NearBlock& block : near_) n += block.floored;
    return n;
}

template <int D>
template <class F>
void NormalFluxWalls<D>::each_foot(const Particles<D>& particles, F&& f) const {
    for (const NearBlock& block : near_)
        for (std::size_t k = 0; k < block.near.size(); ++k) {
            const std::size_t i = block.near[k].particle;
            const Range pieces = pieces_of(block, k);
            std::size_t last = panels.size();
            for (std::size_t p = pieces.begin; p < pieces.end; ++p) {
                const std::size_t panel = panel_of(block.piece[p]);
                if (panel == last) continue;  // cells of one panel
                last = panel;
                Vec<D> x;
                for (int d = 0; d < D; ++d) x[d] = particles.x[std::size_t(d)][i];
                const double h = panels.height(panel, x);
                if (h >= 0) continue;
                const auto shape = panels.shape_functions(panel, x);
                if (*std::min_element(shape.begin(), shape.end()) >= 0) f(i, panel, h, shape);
            }
        }
}

template <int D>
std::size_t NormalFluxWalls<D>::hold_back(Particles<D>& particles, double spacing) const {
    std::size_t held = 0;
    each_foot(particles, [&](std::size_t i, std::size_t panel, double h, const std::array<double, D>& shape) {
        if (h < -0.5 * spacing) return;
        Vec<D> v;
        for (int d = 0; d < D; ++d) v[d] = particles.v[std::size_t(d)][i];
        for (std::size_t a = 0; a < D; ++a)
            v -= shape[a] * panels.velocity[std::size_t(panels.panels[panel].vertex[a])];
        const double towards = std::max(0.0, -v.dot(panels.normal[panel]));
        for (int d = 0; d < D; ++d) {
            particles.x[std::size_t(d)][i] += (1e-3 * spacing - h) * panels.normal[panel][d];
            particles.v[std::size_t(d)][i] += towards * panels.normal[panel][d];
        }
        ++held;
    });
    return held;
}

template <int D>
Escape NormalFluxWalls<D>::deepest(const Particles<D>& particles) const {
    Escape escape;
    each_foot(particles, [&](std::size_t i, std::size_t panel, double h, const std::array<double, D>&) {
        if (-h > escape.depth) escape = {i, -h, int(panel)};
    });
    return escape;
}

template class NormalFluxWalls<2>;
template class NormalFluxWalls<3>;

}  // namespace aquagraph::fluid
