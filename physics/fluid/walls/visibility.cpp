#include "physics/fluid/walls/visibility.hpp"

#include <cmath>
#include <limits>

namespace aquagraph::fluid {

void PanelGrid::Cell::clear() {
    panel.clear();
    patch.clear();
    for (Scalars* values : {&x, &y, &tx, &ty, &length}) values->clear();
    convex_room = wet = false;
}

void PanelGrid::Cell::add(const Panels<2>& panels, std::size_t k, int patch_of_k) {
    panel.push_back(int(k));
    patch.push_back(patch_of_k);
    x.push_back(panels.start(k).x());
    y.push_back(panels.start(k).y());
    tx.push_back(panels.tangent[k].x());
    ty.push_back(panels.tangent[k].y());
    length.push_back(panels.measure[k]);
    wet = wet || panels.panels[k].wet;
}

void PanelGrid::build(const Panels<2>& panels, const std::vector<int>& patch, double reach) {
    const std::size_t n = panels.panels.size();
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
    for (std::size_t k = 0; k < n; ++k) {
        low = low.cwiseMin(panels.start(k)).cwiseMin(panels.end(k));
        high = high.cwiseMax(panels.start(k)).cwiseMax(panels.end(k));
    }
    used_ = 0;
    index_.clear();
    nx_ = ny_ = 0;
    if (n == 0) return;
    // Ghosts lie within reach of their panel, and who might see one within reach of it.
    origin_ = low - Vec2::Constant(2.001 * reach);
    high += Vec2::Constant(2.001 * reach);
    inverse_width_ = 1 / reach;
    nx_ = int((high.x() - origin_.x()) * inverse_width_) + 1;
    ny_ = int((high.y() - origin_.y()) * inverse_width_) + 1;
    index_.assign(std::size_t(nx_) * std::size_t(ny_), -1);

    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 a = panels.start(k), b = panels.end(k);
        const Vec2 from = a.cwiseMin(b) - Vec2::Constant(reach), to = a.cwiseMax(b) + Vec2::Constant(reach);
        const int x0 = std::max(0, int((from.x() - origin_.x()) * inverse_width_)),
                  x1 = std::min(nx_ - 1, int((to.x() - origin_.x()) * inverse_width_)),
                  y0 = std::max(0, int((from.y() - origin_.y()) * inverse_width_)),
                  y1 = std::min(ny_ - 1, int((to.y() - origin_.y()) * inverse_width_));
        for (int iy = y0; iy <= y1; ++iy) {
            for (int ix = x0; ix <= x1; ++ix) {
                // A long slanted panel passes far from most cells of its bounding box.
                const Vec2 centre = origin_ + Vec2(ix + 0.5, iy + 0.5) * reach;
                const double s = std::clamp((centre - a).dot(panels.tangent[k]), 0.0, panels.measure[k]);
                if ((centre - a - s * panels.tangent[k]).norm() > reach * (1 + 0.7072)) continue;
                int& cell = index_[std::size_t(iy) * std::size_t(nx_) + std::size_t(ix)];
                if (cell < 0) cell = new_cell();
                cells_[std::size_t(cell)].add(panels, k, patch[k]);
            }
        }
    }
    for (std::size_t used = 0; used < used_; ++used) {
        Cell& c = cells_[used];
        // Nothing is hidden where every panel has all the others in front of it or in its own plane.
        c.convex_room = true;
        for (std::size_t k = 0; k < c.panel.size() && c.convex_room; ++k) {
            const auto panel = std::size_t(c.panel[k]);
            for (const int other : c.panel)
                for (const Vec2& x : {panels.start(std::size_t(other)), panels.end(std::size_t(other))})
                    if ((x - panels.start(panel)).dot(panels.normal[panel]) < -1e-9 * panels.measure[panel])
                        c.convex_room = false;
        }
    }
}

const PanelGrid::Cell* PanelGrid::at(double x, double y) const {
    const double fx = (x - origin_.x()) * inverse_width_, fy = (y - origin_.y()) * inverse_width_;
    if (!(fx >= 0 && fy >= 0 && fx < nx_ && fy < ny_)) return nullptr;
    const int cell = index_[std::size_t(fy) * std::size_t(nx_) + std::size_t(fx)];
    return cell < 0 ? nullptr : &cells_[std::size_t(cell)];
}

void PanelGrid::look_closely_around(const Vec2& x) {
    const int cx = int((x.x() - origin_.x()) * inverse_width_), cy = int((x.y() - origin_.y()) * inverse_width_);
    for (int iy = std::max(0, cy - 1); iy <= std::min(ny_ - 1, cy + 1); ++iy) {
        for (int ix = std::max(0, cx - 1); ix <= std::min(nx_ - 1, cx + 1); ++ix) {
            int& cell = index_[std::size_t(iy) * std::size_t(nx_) + std::size_t(ix)];
            if (cell < 0) cell = new_cell();
            cells_[std::size_t(cell)].convex_room = false;
        }
    }
}

int PanelGrid::new_cell() {
    if (used_ == cells_.size()) cells_.emplace_back();
    cells_[used_].clear();
    return int(used_++);
}

PanelGrid::Crossing PanelGrid::first_crossing(const Cell& cell, const Vec2& a, const Vec2& b, int patch_left_out) {
    const std::size_t n = cell.panel.size();
    const double ax = a.x(), ay = a.y(), bx = b.x(), by = b.y();
    constexpr double slack = 1e-9;  // panels overlap by a hair, or sight would slip between two of them
    constexpr std::size_t chunk = 16;
    Crossing first;
    for (std::size_t begin = 0; begin < n; begin += chunk) {
        double along[chunk];
        const std::size_t m = std::min(chunk, n - begin);
        const double *x = &cell.x[begin], *y = &cell.y[begin], *tx = &cell.tx[begin], *ty = &cell.ty[begin],
                     *length = &cell.length[begin];
#pragma omp simd
        for (std::size_t k = 0; k < m; ++k) {
            // distance along the normal (-ty, tx) and along the tangent, of both ends
            const double da = -(ax - x[k]) * ty[k] + (ay - y[k]) * tx[k],
                         db = -(bx - x[k]) * ty[k] + (by - y[k]) * tx[k];
            const double sa = (ax - x[k]) * tx[k] + (ay - y[k]) * ty[k], sb = (bx - x[k]) * tx[k] + (by - y[k]) * ty[k];
            const double t = da / (da - db), s = sa + t * (sb - sa);
            const bool crosses = (da * db < 0) & (s >= -slack * length[k]) & (s <= (1 + slack) * length[k]);
            along[k] = crosses ? t : 2.0;
        }
        for (std::size_t k = 0; k < m; ++k)
            if (along[k] < first.along && cell.patch[begin + k] != patch_left_out) first = {int(begin + k), along[k]};
    }
    return first;
}

void Visibility::prepare(const Particles<2>& particles, const Panels<2>& panels, const PanelGrid& grid,
                         const std::vector<Ghost>& ghosts, const std::vector<Corner>& corners,
                         const std::vector<int>& patch, double tolerance) {
    particles_ = &particles;
    panels_ = &panels;
    grid_ = &grid;
    ghosts_ = &ghosts;
    corners_ = &corners;
    patch_ = &patch;
    place_.resize(particles.count);
    cell_.resize(particles.count);
    const double in_front = 1e-3 * tolerance;
    for (std::size_t i = 0; i < particles.count; ++i) {
        Vec2& x = place_[i];
        x = Vec2(particles.x[0][i], particles.x[1][i]);
        cell_[i] = grid.at(x.x(), x.y());
        if (!cell_[i]) continue;
        for (const int k : cell_[i]->panel) {
            const auto panel = std::size_t(k);
            const Vec2 from = x - panels.start(panel);
            const double d = from.dot(panels.normal[panel]), s = from.dot(panels.tangent[panel]);
            if (d < in_front && d > -tolerance && s >= 0 && s <= panels.measure[panel])
                x += (in_front - d) * panels.normal[panel];
        }
    }
}

bool Visibility::sees_everything(std::size_t i) const {
    return !cell_[i] || cell_[i]->convex_room;
}

bool Visibility::sees(std::size_t i, const PanelGrid::Cell& cell, std::size_t lane, int* entry) const {
    const std::size_t ghost_begin = particles_->ghost_begin();
    const bool is_fluid = lane < ghost_begin;
    const Vec2 target = is_fluid ? place_[lane] : Vec2(particles_->x[0][lane], particles_->x[1][lane]);
    const auto crossing = PanelGrid::first_crossing(cell, place_[i], target);
    *entry = crossing.entry < 0 ? -1 : cell.panel[std::size_t(crossing.entry)];
    if (is_fluid) return crossing.entry < 0;
    const Ghost& ghost = (*ghosts_)[lane - ghost_begin];
    const auto of = [&](int panel) { return (*patch_)[std::size_t(panel)]; };
    const auto in_front_of = [&](int k) {
        const auto panel = std::size_t(k);
        return (place_[i] - panels_->start(panel)).dot(panels_->normal[panel]) > 0;
    };
    if (ghost.corner >= 0) {
        const Corner& corner = (*corners_)[std::size_t(ghost.corner)];
        if (!in_front_of(corner.panel[0]) || !in_front_of(corner.panel[1])) return false;
        return crossing.entry < 0 || of(*entry) == of(corner.panel[0]) || of(*entry) == of(corner.panel[1]);
    }
    // Past the end of a wall that just stops, a ghost is seen from the wall's front.
    if (crossing.entry < 0) return in_front_of(ghost.panel);
    if (of(*entry) != of(ghost.panel)) return false;
    // The reflected line of sight, from where it enters the wall to the parent.
    const PanelGrid::Cell* parents = cell_[ghost.parent];
    const Vec2 foot = place_[i] + crossing.along * (target - place_[i]);
    return !parents || PanelGrid::first_crossing(*parents, foot, place_[ghost.parent], of(ghost.panel)).entry < 0;
}

std::uint8_t Visibility::lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const {
    unsigned seen = 0;
    int entry = -1;
    for (unsigned l = 0; l < W; ++l)
        if ((in_reach >> l) & 1u) seen |= unsigned(sees(i, *cell_[i], cluster * W + l, &entry)) << l;
    return std::uint8_t(seen);
}

int Visibility::entry_panel(std::size_t i, std::size_t ghost) const {
    int entry = -1;
    if (!cell_[i] || !sees(i, *cell_[i], particles_->ghost_begin() + ghost, &entry)) return -1;
    return entry;
}

}  // namespace aquagraph::fluid
