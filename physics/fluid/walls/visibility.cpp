#include "physics/fluid/walls/visibility.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace aquagraph::fluid {

template <int D>
void Visibility<D>::prepare(const Particles<D>& particles, const Panels<D>& panels, const PanelGrid<D>& grid,
                            const Periodic<D>& periodic, const std::vector<Ghost>& ghosts,
                            const std::vector<Corner<D>>& corners, const EdgeShares<D>& shares,
                            const std::vector<int>& patch, double tolerance, BlockLoop loop) {
    particles_ = &particles;
    panels_ = &panels;
    grid_ = &grid;
    periodic_ = &periodic;
    ghosts_ = &ghosts;
    corners_ = &corners;
    shares_ = &shares;
    patch_ = &patch;
    find_blunt_edges();
    tolerance_ = tolerance;
    static std::atomic<std::uint64_t> prepared{0};
    prepared_ = ++prepared;
    place_.resize(particles.count);
    cell_.resize(particles.count);
    clear_.resize(particles.count);
    constexpr std::size_t per_part = 256;
    loop((particles.count + per_part - 1) / per_part, [&](std::size_t part) {
        const std::size_t end = std::min(particles.count, (part + 1) * per_part);
        for (std::size_t i = part * per_part; i < end; ++i) find_place(i);
    });
}

template <int D>
void Visibility<D>::find_place(std::size_t i) {
    const double in_front = 1e-3 * tolerance_;
    Vec<D>& x = place_[i];
    for (int d = 0; d < D; ++d) x[d] = particles_->x[std::size_t(d)][i];
    cell_[i] = grid_->at(x);
    if (!cell_[i]) return;
    for (std::size_t entry = 0; entry < cell_[i]->panel.size(); ++entry) {
        const auto panel = std::size_t(cell_[i]->panel[entry]);
        const Vec<D> there = x - periodic_->shift(cell_[i]->copy[entry]);
        const double d = panels_->height(panel, there);
        if (d < in_front && d > -tolerance_ && panels_->is_over(panel, there))
            x += (in_front - d) * panels_->normal[panel];
    }
    clear_[i] = cell_[i]->convex_room ? 0 : grid_->clearance(*cell_[i], *panels_, x);
}

template <int D>
bool Visibility<D>::is_clear(std::size_t i, std::size_t j, const Vec<D>& target) const {
    if (!cell_[j]) return true;
    const double clear = std::max(clear_[i], clear_[j]);
    return (target - place_[i]).squaredNorm() < clear * clear;
}

template <int D>
const typename PanelGrid<D>::Cell& Visibility<D>::panels_near(std::size_t i) const {
    thread_local Cell nearby;
    thread_local std::uint64_t prepared = 0;
    thread_local std::size_t particle = 0;
    if (prepared != prepared_ || particle != i) {
        grid_->gather(*cell_[i], *panels_, place_[i], nearby);
        prepared = prepared_;
        particle = i;
    }
    return nearby;
}

template <int D>
bool Visibility<D>::sees_everything(std::size_t i) const {
    if (!cell_[i] || cell_[i]->convex_room) return true;
    if (D == 2) return false;
    // As for a whole cell (PanelGrid): one smooth surface that turns little within reach hides nothing.
    return cell_[i]->one_patch && PanelGrid<D>::turns_little(panels_near(i), *panels_);
}

// Mirrored by the panel through which it enters, the line of sight must reach the edge's other panel first: at the foot
// of a column two edges share the floor, and one of them is round the corner.
template <int D>
bool Visibility<D>::reaches_other_side(std::size_t i, const Cell& cell, const Ghost& ghost, const Corner<D>& corner,
                                       int other_panel, int entry_patch,
                                       const typename PanelGrid<D>::Crossing& crossing) const {
    const auto other = std::size_t(other_panel);
    const Vec<D> copy = periodic_->shift(ghost.copy), shift = periodic_->shift(ghost.wall_copy) + copy;
    Vec<D> parent = place_[ghost.parent] + copy, target;
    const std::size_t lane = particles_->ghost_begin() + std::size_t(&ghost - ghosts_->data());
    for (int d = 0; d < D; ++d) target[d] = particles_->x[std::size_t(d)][lane];
    Vec<D> from = place_[i] + crossing.along * (target - place_[i]),
           to = parent - 2 * panels_->height(other, parent - shift) * panels_->normal[other];
    if (std::fabs(panels_->height(other, from - shift)) < 1e-6 * tolerance_) return true;  // through the very edge
    // Under a body that does not quite touch its floor sight would slip through: look just above the gap.
    for (const int floor : corner.floor) {
        if (floor < 0 || (*patch_)[std::size_t(floor)] != entry_patch) continue;
        const Vec<D> lift = 1.05 * tolerance_ * panels_->normal[std::size_t(floor)];
        from += lift;
        to += lift;
    }
    const auto next = PanelGrid<D>::first_crossing(cell, from, to, entry_patch);
    return next.entry < 0 || cell.patch[std::size_t(next.entry)] == (*patch_)[other];
}

template <int D>
bool Visibility<D>::sees(std::size_t i, const Cell& cell, std::size_t lane, int* entry) const {
    const std::size_t ghost_begin = particles_->ghost_begin();
    const Ghost* ghost = lane < ghost_begin ? nullptr : &(*ghosts_)[lane - ghost_begin];
    Vec<D> target;
    if (!ghost || ghost->is_image()) {
        const std::size_t j = ghost ? ghost->parent : lane;
        target = place_[j];
        if (ghost) target += periodic_->shift(ghost->copy);
        *entry = -1;
        if (is_clear(i, j, target)) return true;
    } else
        for (int d = 0; d < D; ++d) target[d] = particles_->x[std::size_t(d)][lane];
    const auto crossing = PanelGrid<D>::first_crossing(cell, place_[i], target);
    *entry = crossing.entry < 0 ? -1 : cell.panel[std::size_t(crossing.entry)];
    if (!ghost || ghost->is_image()) return crossing.entry < 0 || goes_round_an_edge(cell, *entry, target, place_[i]);

    const auto of = [&](int panel) { return (*patch_)[std::size_t(panel)]; };
    const Vec<D> copy = periodic_->shift(ghost->copy),
                 seen_from = place_[i] - periodic_->shift(ghost->wall_copy) - copy;
    const auto in_front_of = [&](int k) { return panels_->height(std::size_t(k), seen_from) > 0; };
    if (ghost->corner >= 0) {
        const Corner<D>& corner = (*corners_)[std::size_t(ghost->corner)];
        int entered = -1;
        for (std::size_t k = 0; k < corner.panels; ++k) {
            if (!in_front_of(corner.panel[k])) return false;
            if (crossing.entry >= 0 && of(*entry) == of(corner.panel[k])) entered = int(k);
        }
        if (crossing.entry < 0) return true;
        if (entered < 0) return false;
        if (D == 2 || corner.is_point()) return true;
        return reaches_other_side(i, cell, *ghost, corner, corner.panel[entered == 0 ? 1 : 0], of(*entry), crossing);
    }
    // Past the end of a wall that just stops, a ghost is seen from the wall's front.
    if (crossing.entry < 0) return in_front_of(ghost->panel);
    if (of(*entry) != of(ghost->panel)) return shares_->seen_through(lane - ghost_begin, of(*entry));
    // The reflected line of sight, from where it enters the wall, or a hair off it, to the parent: at an edge the other
    // side would else hide the parent or not as rounding has it.
    constexpr double hair = 1e-9;
    Vec<D> foot = place_[i] + crossing.along * (target - place_[i]);
    foot += hair * (place_[ghost->parent] + copy - foot);
    if constexpr (D == 2) {
        const Cell* parents = cell_[ghost->parent];
        return !parents ||
               PanelGrid<D>::first_crossing(*parents, foot - copy, place_[ghost->parent], of(ghost->panel)).entry < 0;
    } else {
        // On the other side of a thin body with rounded edges the patch is the same.
        const auto &entered = panels_->normal[std::size_t(*entry)],
                   &mirrored = panels_->normal[std::size_t(ghost->panel)];
        if (entered.dot(mirrored) < 0) return false;
        return PanelGrid<D>::first_crossing(cell, foot, place_[ghost->parent] + copy, of(ghost->panel)).entry < 0;
    }
}

template <int D>
std::uint8_t Visibility<D>::lanes_seen(std::size_t i, std::size_t cluster, std::uint8_t in_reach) const {
    const Cell& cell = panels_near(i);
    unsigned seen = 0;
    int entry = -1;
    for (unsigned l = 0; l < W; ++l)
        if ((in_reach >> l) & 1u) seen |= unsigned(sees(i, cell, cluster * W + l, &entry)) << l;
    return std::uint8_t(seen);
}

// What lies beyond a blunt edge is water of the same body: a line of sight that only cuts the edge off, in through one
// of its two patches and out through the other, is not held up, or the support there would have a hole in the water.
template <int D>
bool Visibility<D>::goes_round_an_edge(const Cell& cell, int entry, const Vec<D>& target, const Vec<D>& from) const {
    if (blunt_edges_.empty()) return false;
    const int a = (*patch_)[std::size_t(entry)];
    auto exit = PanelGrid<D>::first_crossing(cell, target, from);
    if (exit.entry < 0) return false;
    if (cell.patch[std::size_t(exit.entry)] == a) {  // or touches the very edge: in and out in the same place
        const double along = exit.along;
        exit = PanelGrid<D>::first_crossing(cell, target, from, a);
        if (exit.entry < 0 || std::fabs(exit.along - along) > 1e-6) return false;
    }
    const int b = (*patch_)[std::size_t(cell.panel[std::size_t(exit.entry)])];
    return std::binary_search(blunt_edges_.begin(), blunt_edges_.end(), std::pair(std::min(a, b), std::max(a, b)));
}

template <int D>
void Visibility<D>::find_blunt_edges() {
    blunt_edges_.clear();
    for (const Joint<D>& joint : panels_->joints) {
        const auto k = std::size_t(joint.panel[0]), l = std::size_t(joint.panel[1]);
        const int a = (*patch_)[k], b = (*patch_)[l];
        // Convex: the neighbour falls back behind the panel. Blunt: the body fills more than 60°.
        if (a == b || panels_->height(k, panels_->centroid[l]) >= 0 ||
            panels_->normal[k].dot(panels_->normal[l]) < -0.5 - 1e-9)
            continue;
        blunt_edges_.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(blunt_edges_.begin(), blunt_edges_.end());
    blunt_edges_.erase(std::unique(blunt_edges_.begin(), blunt_edges_.end()), blunt_edges_.end());
}

template <int D>
int Visibility<D>::entry_panel(std::size_t i, std::size_t ghost) const {
    int entry = -1;
    if (!cell_[i] || !sees(i, panels_near(i), particles_->ghost_begin() + ghost, &entry)) return -1;
    return entry;
}

template class Visibility<2>;
template class Visibility<3>;

}  // namespace aquagraph::fluid
