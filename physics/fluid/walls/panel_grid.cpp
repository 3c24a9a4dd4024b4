#include "physics/fluid/walls/panel_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace aquagraph::fluid {

namespace {

double distance_to_segment(const auto& x, const auto& a, const auto& b) {
    const auto along = (b - a).eval();
    const double s = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (x - a - s * along).norm();
}

double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = Vec3(b - a).cross(Vec3(c - a));
    const double over_a = Vec3(c - b).cross(Vec3(x - b)).dot(n), over_b = Vec3(a - c).cross(Vec3(x - c)).dot(n),
                 over_c = Vec3(b - a).cross(Vec3(x - a)).dot(n);
    if (over_a >= 0 && over_b >= 0 && over_c >= 0) return std::fabs((x - a).dot(n)) / n.norm();
    return std::min({distance_to_segment(x, a, b), distance_to_segment(x, b, c), distance_to_segment(x, c, a)});
}

// To a point, a segment or a triangle.
template <int D>
double distance_to(const Vec<D>& x, const Vec<D>* corner, std::size_t corners) {
    if (corners == 1) return (x - corner[0]).norm();
    if constexpr (D == 3)
        if (corners == 3) return distance_to_triangle(x, corner[0], corner[1], corner[2]);
    return distance_to_segment(x, corner[0], corner[1]);
}

// Panels more numerous than this in one cell are not compared pairwise.
constexpr std::size_t most_to_compare = 200;

}  // namespace

template <int D>
void PanelGrid<D>::Cell::clear() {
    panel.clear();
    patch.clear();
    copy.clear();
    corner.clear();
    corner_copy.clear();
    for (Scalars& values : sight) values.clear();
    convex_room = one_patch = wet = false;
}

template <int D>
std::size_t PanelGrid<D>::index(const Index& cell) const {
    std::size_t k = std::size_t(cell[D - 1]);
    for (int d = D - 2; d >= 0; --d) k = k * std::size_t(cells_along_[d]) + std::size_t(cell[d]);
    return k;
}

template <int D>
typename PanelGrid<D>::Index PanelGrid<D>::index_at(const Vec<D>& x) const {
    Index cell;
    for (int d = 0; d < D; ++d)
        cell[d] = int(std::clamp((x[d] - origin_[d]) * inverse_width_, 0.0, double(cells_along_[d] - 1)));
    return cell;
}

template <int D>
template <class F>
void PanelGrid<D>::each_cell(const Index& first, const Index& last, F&& f) const {
    if constexpr (D == 2) {
        for (int y = first.y(); y <= last.y(); ++y)
            for (int x = first.x(); x <= last.x(); ++x) f(Index(x, y));
    } else {
        for (int z = first.z(); z <= last.z(); ++z)
            for (int y = first.y(); y <= last.y(); ++y)
                for (int x = first.x(); x <= last.x(); ++x) f(Index(x, y, z));
    }
}

template <int D>
template <class F>
void PanelGrid<D>::each_cell_near(const Vec<D>* corner, std::size_t corners, const Vec<D>& shift, F&& f) {
    Vec<D> low = corner[0], high = corner[0];
    for (std::size_t c = 1; c < corners; ++c) {
        low = low.cwiseMin(corner[c]);
        high = high.cwiseMax(corner[c]);
    }
    low += shift - Vec<D>::Constant(reach_);
    high += shift + Vec<D>::Constant(reach_);
    const Vec<D> end = origin_ + cells_along_.template cast<double>() / inverse_width_;
    if ((low.array() > end.array()).any() || (high.array() < origin_.array()).any()) return;
    static const double half_diagonal = D == 2 ? 0.7072 : 0.8661;
    each_cell(index_at(low), index_at(high), [&](const Index& at) {
        // A long slanted panel passes far from most cells of its bounding box.
        const Vec<D> centre =
            origin_ + (at.template cast<double>() + Vec<D>::Constant(0.5)) * (1 / inverse_width_) - shift;
        if (distance_to(centre, corner, corners) <= reach_ * (1 + half_diagonal)) f(at);
    });
}

template <int D>
void PanelGrid<D>::add(Cell& cell, const Panels<D>& panels, std::size_t k, int patch, int copy) const {
    cell.panel.push_back(int(k));
    cell.patch.push_back(patch);
    cell.copy.push_back(std::uint8_t(copy));
    cell.wet = cell.wet || panels.panels[k].wet;
}

template <int D>
void PanelGrid<D>::fill_sight(Cell& cell, const Panels<D>& panels) const {
    if (!cell.sight[0].empty()) return;
    for (std::size_t entry = 0; entry < cell.panel.size(); ++entry) {
        const auto k = std::size_t(cell.panel[entry]);
        const Vec<D> a = panels.start(k) + periodic_.shift(cell.copy[entry]);
        if constexpr (D == 2) {
            const double values[] = {a.x(), a.y(), panels.tangent[k].x(), panels.tangent[k].y(), panels.measure[k]};
            for (std::size_t v = 0; v < 5; ++v) cell.sight[v].push_back(values[v]);
        } else {
            const Vec3 &n = panels.normal[k], ab = panels.vertex(k, 1) - panels.start(k),
                       ac = panels.vertex(k, 2) - panels.start(k);
            const Vec3 u = ac.cross(n) * (0.5 / panels.measure[k]), v = n.cross(ab) * (0.5 / panels.measure[k]);
            const double values[] = {n.x(), n.y(),     n.z(), -n.dot(a), u.x(), u.y(),
                                     u.z(), -u.dot(a), v.x(), v.y(),     v.z(), -v.dot(a)};
            for (std::size_t q = 0; q < 12; ++q) cell.sight[q].push_back(values[q]);
        }
    }
}

template <int D>
bool PanelGrid<D>::turns_little(const Cell& cell, const Panels<D>& panels) {
    Vec<D> mean = Vec<D>::Zero();
    for (const int panel : cell.panel) mean += panels.normal[std::size_t(panel)];
    const double least = 0.71 * mean.norm();
    return std::all_of(cell.panel.begin(), cell.panel.end(),
                       [&](int panel) { return panels.normal[std::size_t(panel)].dot(mean) > least; });
}

template <int D>
void PanelGrid<D>::gather(const Cell& cell, const Panels<D>& panels, const Vec<D>& x, Cell& nearby) const {
    nearby.clear();
    for (std::size_t entry = 0; entry < cell.sight[0].size(); ++entry) {
        const auto k = std::size_t(cell.panel[entry]);
        const double near = reach_ + radius_[k];
        Vec<D> from = x - panels.centroid[k];
        if (cell.copy[entry] != 0) from -= periodic_.shift(cell.copy[entry]);
        if (from.squaredNorm() > near * near || std::fabs(from.dot(panels.normal[k])) > reach_) continue;
        nearby.panel.push_back(cell.panel[entry]);
        nearby.patch.push_back(cell.patch[entry]);
        nearby.copy.push_back(cell.copy[entry]);
        for (std::size_t v = 0; v < cell.sight.size(); ++v) nearby.sight[v].push_back(cell.sight[v][entry]);
    }
}

template <int D>
double PanelGrid<D>::clearance(const Cell& cell, const Panels<D>& panels, const Vec<D>& x) const {
    double least = reach_;
    for (std::size_t entry = 0; entry < cell.panel.size(); ++entry) {
        const auto k = std::size_t(cell.panel[entry]);
        const Vec<D> from = x - periodic_.shift(cell.copy[entry]);
        if constexpr (D == 2)
            least = std::min(least, distance_to_segment(from, panels.vertex(k, 0), panels.vertex(k, 1)));
        else
            least = std::min(
                least, std::max(std::fabs(panels.height(k, from)), (from - panels.centroid[k]).norm() - radius_[k]));
    }
    return least;
}

template <int D>
bool PanelGrid<D>::is_convex_room(const Cell& cell, const Panels<D>& panels) const {
    const std::size_t n = cell.panel.size();
    if constexpr (D == 3) {
        // One smooth surface that turns little hides nothing worth the search: a sphere whose normals stay within
        // 45° here bulges by less than a quarter of a spacing between two particles in reach of each other.
        const bool one_patch =
            std::all_of(cell.patch.begin(), cell.patch.end(), [&](int p) { return p == cell.patch[0]; });
        if (one_patch && turns_little(cell, panels)) return true;
        if (n > most_to_compare) return false;
    }
    // Nothing is hidden where every panel has all the others in front of it or in its own plane.
    for (std::size_t e = 0; e < n; ++e) {
        const auto panel = std::size_t(cell.panel[e]);
        const double size = D == 2 ? panels.measure[panel] : std::sqrt(panels.measure[panel]);
        const Vec<D> shift = periodic_.shift(cell.copy[e]);
        for (std::size_t other = 0; other < n; ++other)
            for (std::size_t v = 0; v < D; ++v) {
                const Vec<D> x =
                    panels.vertex(std::size_t(cell.panel[other]), v) + periodic_.shift(cell.copy[other]) - shift;
                if (panels.height(panel, x) < -1e-9 * size) return false;
            }
    }
    return true;
}

template <int D>
bool PanelGrid<D>::build(const Panels<D>& panels, const std::vector<int>& patch, double reach,
                         const Periodic<D>& periodic, const Particles<D>& particles) {
    const std::size_t n = panels.size();
    const double most = std::numeric_limits<double>::max();
    Vec<D> water_low = Vec<D>::Constant(most), water_high = -water_low;
    if (D == 3) {
        for (int d = 0; d < D; ++d)
            for (std::size_t i = 0; i < particles.count; ++i) {
                water_low[d] = std::min(water_low[d], particles.x[std::size_t(d)][i]);
                water_high[d] = std::max(water_high[d], particles.x[std::size_t(d)][i]);
            }
        if (particles.count == 0) water_low = water_high = Vec<D>::Zero();
    }
    const bool covered = D == 2 || ((water_low.array() >= covered_low_.array()).all() &&
                                    (water_high.array() <= covered_high_.array()).all());
    if (reach == reach_ && covered && position_ == panels.position) {
        look_as_built();
        return false;
    }
    position_ = panels.position;
    radius_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        radius_[k] = 0;
        for (std::size_t v = 0; v < D; ++v)
            radius_[k] = std::max(radius_[k], (panels.vertex(k, v) - panels.centroid[k]).norm());
        radius_[k] *= 1 + 1e-9;
    }
    periodic_ = periodic;
    added_.clear();
    closely_.clear();
    used_ = built_ = 0;
    index_.clear();
    cells_along_.setZero();
    reach_ = reach;
    if (n == 0) return true;

    Vec<D> low = Vec<D>::Constant(most), high = -low;
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t v = 0; v < D; ++v) {
            low = low.cwiseMin(panels.vertex(k, v));
            high = high.cwiseMax(panels.vertex(k, v));
        }
    if (D == 3) {  // with room to move before the next build
        if (!covered_is_given_) {
            covered_low_ = water_low - Vec<D>::Constant(4 * reach);
            covered_high_ = water_high + Vec<D>::Constant(4 * reach);
        }
        covered_is_given_ = false;
        low = low.cwiseMax(covered_low_);
        high = high.cwiseMin(covered_high_);
        if ((low.array() > high.array() + 4 * reach).any()) return true;  // no wall near the water
        high = high.cwiseMax(low);
    }
    for (int d = 0; d < D; ++d)
        if (periodic.along[std::size_t(d)]) {
            low[d] = periodic.low[d];
            high[d] = periodic.high[d];
        }
    // Ghosts lie within reach of their panel, and who might see one within reach of it.
    origin_ = low - Vec<D>::Constant(2.001 * reach);
    high += Vec<D>::Constant(2.001 * reach);
    inverse_width_ = 1 / reach;
    std::size_t cells = 1;
    for (int d = 0; d < D; ++d) {
        cells_along_[d] = int((high[d] - origin_[d]) * inverse_width_) + 1;
        cells *= std::size_t(cells_along_[d]);
    }
    index_.assign(cells, -1);

    for (int copy = 0; copy < Periodic<D>::copies; ++copy) {
        if (!periodic.exists(copy)) continue;
        const Vec<D> shift = periodic.shift(copy);
        for (std::size_t k = 0; k < n; ++k) {
            std::array<Vec<D>, D> corner;
            for (std::size_t v = 0; v < D; ++v) corner[v] = panels.vertex(k, v);
            each_cell_near(corner.data(), D, shift, [&](const Index& at) {
                int& cell = index_[index(at)];
                if (cell < 0) cell = new_cell();
                add(cells_[std::size_t(cell)], panels, k, patch[k], copy);
            });
        }
    }
    for (std::size_t used = 0; used < used_; ++used) {
        Cell& cell = cells_[used];
        cell.convex_room = is_convex_room(cell, panels);
        cell.one_patch = std::all_of(cell.patch.begin(), cell.patch.end(), [&](int p) { return p == cell.patch[0]; });
    }
    // A panel's ghosts lie behind it, and particles within reach of them may be further than that from the panel
    // itself: round the edge of a step. Where their cell knows other walls, those must hide the ghosts.
    const double half_width = 0.5 / inverse_width_;
    for (int copy = 0; copy < Periodic<D>::copies; ++copy) {
        if (!periodic.exists(copy)) continue;
        const Vec<D> shift = periodic.shift(copy);
        for (std::size_t k = 0; k < n; ++k) {
            std::array<Vec<D>, D> corner;
            for (std::size_t v = 0; v < D; ++v) corner[v] = panels.vertex(k, v) + shift;
            Vec<D> from = corner[0], to = corner[0];
            for (std::size_t v = 1; v < D; ++v) {
                from = from.cwiseMin(corner[v]);
                to = to.cwiseMax(corner[v]);
            }
            const Vec<D> room = Vec<D>::Constant(2 * reach);
            each_cell(index_at(from - room), index_at(to + room), [&](const Index& at) {
                const int number = index_[index(at)];
                if (number < 0) return;
                Cell& cell = cells_[std::size_t(number)];
                if (!cell.convex_room && !cell.one_patch) return;
                if (std::find(cell.patch.begin(), cell.patch.end(), patch[k]) != cell.patch.end()) return;
                const Vec<D> centre = origin_ + Vec<D>(2 * at.template cast<double>() + Vec<D>::Ones()) * half_width;
                const double lowest =
                    panels.height(k, centre - shift) - half_width * panels.normal[k].template lpNorm<1>();
                if (lowest < reach && distance_to(centre, corner.data(), D) < 2 * reach + half_width * std::sqrt(D))
                    cell.convex_room = cell.one_patch = false;
            });
        }
    }
    for (std::size_t used = 0; used < used_; ++used) {
        Cell& cell = cells_[used];
        if (D == 2 || cell.wet || !cell.convex_room) fill_sight(cell, panels);
    }
    built_ = used_;
    return true;
}

template <int D>
void PanelGrid<D>::add_corners(const std::vector<Corner<D>>& corners) {
    for (int copy = 0; copy < Periodic<D>::copies; ++copy) {
        if (!periodic_.exists(copy)) continue;
        const Vec<D> shift = periodic_.shift(copy);
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const Vec<D> ends[2] = {corners[c].point, corners[c].point + corners[c].edge};
            each_cell_near(ends, corners[c].is_point() ? 1 : 2, shift, [&](const Index& at) {
                const int cell = index_[index(at)];
                if (cell < 0) return;
                cells_[std::size_t(cell)].corner.push_back(int(c));
                cells_[std::size_t(cell)].corner_copy.push_back(std::uint8_t(copy));
            });
        }
    }
}

template <int D>
const typename PanelGrid<D>::Cell* PanelGrid<D>::at(const Vec<D>& x) const {
    Index where;
    for (int d = 0; d < D; ++d) {
        const double along = (x[d] - origin_[d]) * inverse_width_;
        if (!(along >= 0 && along < cells_along_[d])) return nullptr;
        where[d] = int(along);
    }
    const int cell = index_[index(where)];
    return cell < 0 ? nullptr : &cells_[std::size_t(cell)];
}

template <int D>
void PanelGrid<D>::look_closely_around(const Vec<D>& x, const Panels<D>& panels) {
    Index first, last;
    for (int d = 0; d < D; ++d) {
        const int centre = int(std::floor((x[d] - origin_[d]) * inverse_width_));
        first[d] = std::max(0, centre - 1);
        last[d] = std::min(cells_along_[d] - 1, centre + 1);
    }
    each_cell(first, last, [&](const Index& at) {
        int& cell = index_[index(at)];
        if (cell < 0) {
            cell = new_cell();
            added_.push_back(index(at));
        }
        Cell& of = cells_[std::size_t(cell)];
        if (of.convex_room || of.one_patch) closely_.push_back({std::size_t(cell), of.convex_room, of.one_patch});
        of.convex_room = of.one_patch = false;
        fill_sight(of, panels);
    });
}

template <int D>
void PanelGrid<D>::look_as_built() {
    for (auto before = closely_.rbegin(); before != closely_.rend(); ++before) {
        cells_[before->cell].convex_room = before->convex_room;
        cells_[before->cell].one_patch = before->one_patch;
    }
    for (const std::size_t place : added_) index_[place] = -1;
    closely_.clear();
    added_.clear();
    used_ = built_;
}

template <int D>
int PanelGrid<D>::new_cell() {
    if (used_ == cells_.size()) cells_.emplace_back();
    cells_[used_].clear();
    return int(used_++);
}

template <int D>
typename PanelGrid<D>::Crossing PanelGrid<D>::first_crossing(const Cell& cell, const Vec<D>& a, const Vec<D>& b,
                                                             int patch_left_out) {
    const std::size_t n = cell.sight[0].size();  // none where nothing hides anything
    constexpr double slack = 1e-9;               // panels overlap by a hair, or sight would slip between two of them
    constexpr std::size_t chunk = 16;
    Crossing first;
    for (std::size_t begin = 0; begin < n; begin += chunk) {
        double along[chunk], least = first.along;
        const std::size_t m = std::min(chunk, n - begin);
        if constexpr (D == 2) {
            const double ax = a.x(), ay = a.y(), bx = b.x(), by = b.y();
            const double *x = &cell.sight[0][begin], *y = &cell.sight[1][begin], *tx = &cell.sight[2][begin],
                         *ty = &cell.sight[3][begin], *length = &cell.sight[4][begin];
#pragma omp simd reduction(min : least)
            for (std::size_t k = 0; k < m; ++k) {
                // distance along the normal (-ty, tx) and along the tangent, of both ends
                const double da = -(ax - x[k]) * ty[k] + (ay - y[k]) * tx[k],
                             db = -(bx - x[k]) * ty[k] + (by - y[k]) * tx[k];
                const double sa = (ax - x[k]) * tx[k] + (ay - y[k]) * ty[k],
                             sb = (bx - x[k]) * tx[k] + (by - y[k]) * ty[k];
                const double t = da / (da - db), s = sa + t * (sb - sa);
                const bool crosses = (da * db < 0) & (s >= -slack * length[k]) & (s <= (1 + slack) * length[k]);
                along[k] = crosses ? t : 2.0;
                least = along[k] < least ? along[k] : least;
            }
        } else {
            const double ax = a.x(), ay = a.y(), az = a.z(), bx = b.x() - ax, by = b.y() - ay, bz = b.z() - az;
            const double* q[12];
            for (std::size_t v = 0; v < 12; ++v) q[v] = &cell.sight[v][begin];
            const double *nx = q[0], *ny = q[1], *nz = q[2], *o = q[3], *ux = q[4], *uy = q[5], *uz = q[6], *u0 = q[7],
                         *vx = q[8], *vy = q[9], *vz = q[10], *v0 = q[11];
#pragma omp simd reduction(min : least)
            for (std::size_t k = 0; k < m; ++k) {
                const double da = nx[k] * ax + ny[k] * ay + nz[k] * az + o[k],
                             change = nx[k] * bx + ny[k] * by + nz[k] * bz;
                const double t = -da / change, x = ax + t * bx, y = ay + t * by, z = az + t * bz;
                const double u = ux[k] * x + uy[k] * y + uz[k] * z + u0[k],
                             v = vx[k] * x + vy[k] * y + vz[k] * z + v0[k];
                const bool crosses = (da * (da + change) < 0) & (u >= -slack) & (v >= -slack) & (u + v <= 1 + slack);
                along[k] = crosses ? t : 2.0;
                least = along[k] < least ? along[k] : least;
            }
        }
        if (least == first.along) continue;
        for (std::size_t k = 0; k < m; ++k)
            if (along[k] < first.along && cell.patch[begin + k] != patch_left_out) first = {int(begin + k), along[k]};
    }
    return first;
}

template class PanelGrid<2>;
template class PanelGrid<3>;

}  // namespace aquagraph::fluid
