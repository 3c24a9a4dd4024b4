#include "physics/fluid/walls/ghosts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace aquagraph::fluid {

namespace {
template <int D>
Vec<D> at(const Vectors<D>& values, std::size_t i) {
    Vec<D> value;
    for (int d = 0; d < D; ++d) value[d] = values[std::size_t(d)][i];
    return value;
}
}  // namespace

template <int D>
void GhostWalls<D>::update_geometry() {
    panels.update_geometry();
    for (Corner<D>& corner : corners) corner.update(panels);
    shares.update(panels);
}

template <int D>
void GhostWalls<D>::rebuild(Particles<D>& particles, double spacing, double reach, const Vec<D>& gravity,
                            BlockLoop loop) {
    periodic.check(reach);
    panels.update_geometry();
    least_depth_ = 0.05 * spacing;
    corner_slack_ = 1e-9 * spacing;
    if (!grid.knows(panels)) {
        patch = smooth_patches(panels);
        facet_ = flat_facets(panels);
    }
    if (grid.build(panels, patch, reach, periodic, particles)) {
        corners = find_corners(panels, grid, facet_, 0.5 * spacing);
        grid.add_corners(corners);
        find_owners(spacing, reach);
        shares.find_edges(panels, patch, spacing, reach);
    } else {  // walls that have come back to where they were have taken their corners along in between
        for (Corner<D>& corner : corners) corner.update(panels);
        shares.update(panels);
    }
    collect(particles, spacing, reach, loop);
    place_images(particles, loop);
    const auto order = order_.sort(image_, unsorted_.size(), spacing, loop);
    ghosts.resize(unsorted_.size());
    for (std::size_t g = 0; g < ghosts.size(); ++g) ghosts[g] = unsorted_[order[g]];

    find_shares(particles);
    particles.resize(particles.count, ghosts.size());
    loop(blocks(), [&](std::size_t block) { update_state(particles, gravity, block); });
    visibility.prepare(particles, panels, grid, periodic, ghosts, corners, shares, patch, 0.5 * spacing, loop);
}

// Images beyond another side of a body make the grid look closely around them, which may show that others stick out:
// looked at side by side, and again in order where the grid knew of nothing before.
template <int D>
void GhostWalls<D>::place_images(const Particles<D>& particles, BlockLoop loop) {
    const std::size_t n = unsorted_.size();
    for (auto& along : image_) along.resize(n);
    side_.resize(n);
    loop((n + ghosts_per_block - 1) / ghosts_per_block, [&](std::size_t block) {
        for (std::size_t g = block * ghosts_per_block; g < std::min(n, (block + 1) * ghosts_per_block); ++g) {
            const Vec<D> image = place(particles, unsorted_[g]);
            for (int d = 0; d < D; ++d) image_[std::size_t(d)][g] = image[d];
            side_[g] = side_of(particles, unsorted_[g], image);
        }
    });
    bool has_looked = false;
    for (std::size_t g = 0; g < n; ++g) {
        if (side_[g] == Side::behind || (side_[g] == Side::open_room && !has_looked)) continue;
        const Vec<D> image = at<D>(image_, g);
        if (side_[g] == Side::open_room && side_of(particles, unsorted_[g], image) != Side::beyond) continue;
        grid.look_closely_around(image, panels);
        has_looked = true;
    }
}

template <int D>
void GhostWalls<D>::find_shares(const Particles<D>& particles) {
    shares.clear();
    if (shares.edges().empty()) return;
    for (std::size_t g = 0; g < ghosts.size(); ++g) {
        if (ghosts[g].panel < 0) continue;
        const auto panel = std::size_t(ghosts[g].panel);
        shares.add(std::uint32_t(g), patch[panel], panels.normal[panel],
                   mirror(before_wall(particles, ghosts[g]), ghosts[g]).image);
    }
    shares.weigh();
}

template <int D>
bool GhostWalls<D>::is_near(const Vec<D>& x, double reach) const {
    for (int d = 0; d < D; ++d)
        if (periodic.along[std::size_t(d)] && !(x[d] > periodic.low[d] + reach && x[d] < periodic.high[d] - reach))
            return true;
    return grid.at(x) != nullptr;
}

template <int D>
bool GhostWalls<D>::is_near(const Particles<D>& particles, std::size_t i, double reach) const {
    return is_near(at<D>(particles.x, i), reach);
}

template <int D>
bool GhostWalls<D>::was_near(const Particles<D>& particles, std::size_t i, double reach) const {
    return is_near(at<D>(particles.x_built, i), reach);
}

template <int D>
typename GhostWalls<D>::Side GhostWalls<D>::side_of(const Particles<D>& particles, const Ghost& ghost,
                                                    const Vec<D>& image) const {
    if (ghost.panel < 0) return Side::behind;
    const Vec<D> copy = periodic.shift(ghost.copy);
    const Vec<D> x = before_wall(particles, ghost);
    const auto panel = std::size_t(ghost.panel);
    const Vec<D> foot = x - panels.height(panel, x) * panels.normal[panel] + periodic.shift(ghost.wall_copy);
    const auto* cell = grid.at(foot);
    if (!cell || cell->convex_room) return Side::open_room;
    return PanelGrid<D>::first_crossing(*cell, foot, image - copy, patch[panel]).entry >= 0 ? Side::beyond
                                                                                            : Side::behind;
}

// Which part of its plane each triangle mirrors. Between triangles of one facet feet may lie on either, and the first
// one takes them; at the border of a facet one of two that lie there in one plane does: the one on the side of growing
// x (y, z).
template <int D>
void GhostWalls<D>::find_owners(double spacing, double reach) {
    if constexpr (D == 3) {
        owned_from_.resize(panels.size());
        goes_on_.assign(panels.size(), {});
        const auto opposite = [&](std::size_t k, const Joint<3>& joint) {
            // The vertex of k that is not on the joint: the farthest from its line.
            const Vec3 &a = panels.position[std::size_t(joint.vertex[0])],
                       &b = panels.position[std::size_t(joint.vertex[1])];
            std::size_t farthest = 0;
            double largest = -1;
            for (std::size_t v = 0; v < 3; ++v) {
                const double distance = (panels.vertex(k, v) - a).cross(Vec3(b - a)).squaredNorm();
                if (distance > largest) {
                    largest = distance;
                    farthest = v;
                }
            }
            return farthest;
        };
        std::vector<std::array<bool, 3>> inner(panels.size(), {false, false, false});
        for (const Joint<3>& joint : panels.joints) {
            for (const std::size_t side : {0u, 1u}) {
                const auto k = std::size_t(joint.panel[side]), l = std::size_t(joint.panel[1 - side]);
                const std::size_t v = opposite(k, joint);
                if (facet_[k] == facet_[l]) inner[k][v] = true;
                if (patch[k] == patch[l]) goes_on_[k][v] = true;
            }
        }
        for (std::size_t k = 0; k < panels.size(); ++k) {
            for (std::size_t v = 0; v < 3; ++v) {
                const Vec3 &a = panels.vertex(k, (v + 1) % 3), &b = panels.vertex(k, (v + 2) % 3);
                const double height = 2 * panels.measure[k] / (b - a).norm();
                const Vec3 inward = panels.normal[k].cross(Vec3(b - a).normalized());
                bool owner = true;
                for (const int d : {2, 1, 0})
                    if (std::fabs(inward[d]) > 1e-6) owner = inward[d] > 0;
                owned_from_[k][v] = (inner[k][v] ? -1e-3 * reach : owner ? -1e-9 * spacing : 1e-9 * spacing) / height;
            }
        }
    } else {
        static_cast<void>(spacing);
        static_cast<void>(reach);
    }
}

template <int D>
bool GhostWalls<D>::owns(std::size_t panel, const Vec<D>& x) const {
    if constexpr (D == 2) {
        const double s = (x - panels.start(panel)).dot(panels.tangent[panel]);
        return s >= 0 && s < panels.measure[panel];
    } else {
        const auto shape = panels.shape_functions(panel, x);
        const auto& from = owned_from_[panel];
        return shape[0] >= from[0] && shape[1] >= from[1] && shape[2] >= from[2];
    }
}

template <int D>
void GhostWalls<D>::collect(const Particles<D>& particles, double spacing, double reach, BlockLoop loop) {
    const std::size_t parts = (particles.count + particles_per_part - 1) / particles_per_part;
    if (parts_.size() < parts) parts_.resize(parts);
    loop(parts, [&](std::size_t p) {
        Part& part = parts_[p];
        std::vector<Ghost>& found = part.ghosts;
        found.clear();
        const std::size_t end = std::min(particles.count, (p + 1) * particles_per_part);
        for (std::size_t j = p * particles_per_part; j < end; ++j) {
            const Vec<D> x = at<D>(particles.x, j);
            const std::size_t first = found.size();
            if (const auto* cell = grid.at(x)) {
                collect_panels(j, x, *cell, spacing, reach, part);
                collect_corners(j, x, *cell, spacing, reach, found);
            }
            if (!periodic.any()) continue;
            const std::size_t last = found.size();
            collect_images(particles, {std::uint32_t(j), -1}, reach, found);
            for (std::size_t g = first; g < last; ++g) collect_images(particles, Ghost(found[g]), reach, found);
        }
    });
    unsorted_.clear();
    for (std::size_t p = 0; p < parts; ++p)
        unsorted_.insert(unsorted_.end(), parts_[p].ghosts.begin(), parts_[p].ghosts.end());
}

template <int D>
void GhostWalls<D>::collect_panels(std::size_t j, const Vec<D>& x, const typename PanelGrid<D>::Cell& cell,
                                   double spacing, double reach, Part& part) const {
    const double tolerance = 0.5 * spacing;
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    auto& [found, mirrored_by] = part;
    const std::size_t first = found.size();
    mirrored_by.clear();
    for (std::size_t entry = 0; entry < cell.panel.size(); ++entry) {
        const auto panel = std::size_t(cell.panel[entry]);
        const int copy = cell.copy[entry];
        const Vec<D> there = copy == 0 ? x : Vec<D>(x - periodic.shift(copy));
        const double d = panels.height(panel, there);
        if (d <= -tolerance || d >= reach || !owns(panel, there)) continue;
        if constexpr (D == 3) {  // one ghost per facet: of the triangle that the foot lies on, or nearly
            const auto shape = panels.shape_functions(panel, there);
            const double inside = std::min({shape[0], shape[1], shape[2]});
            const auto same = std::find_if(mirrored_by.begin(), mirrored_by.end(), [&](const ByFacet& other) {
                return other.facet == facet_[panel] && other.copy == copy;
            });
            if (same != mirrored_by.end()) {
                if (inside > same->inside && same->inside < 0) {
                    same->inside = inside;
                    if (same->ghost != none) found[same->ghost].panel = int(panel);
                }
                continue;
            }
            mirrored_by.push_back({facet_[panel], copy, inside, none});
        }
        if (!cell.convex_room && d > 0) {
            // Something between the particle and the foot of its perpendicular hides the panel from it.
            const Vec<D> foot = x - (d - 1e-6 * spacing) * panels.normal[panel];
            if (PanelGrid<D>::first_crossing(cell, x, foot).entry >= 0) continue;
        }
        const Ghost ghost{std::uint32_t(j), int(panel), -1, std::uint8_t(copy), 0};
        if (periodic.any() && mirrors_already(std::span(found).subspan(first), x, ghost, spacing)) continue;
        if (D == 3) mirrored_by.back().ghost = found.size();
        found.push_back(ghost);
    }
}

// A wall that is longer than the period lies beside its own copy: what one of the two mirrors, the other would mirror
// to the same place.
template <int D>
bool GhostWalls<D>::mirrors_already(std::span<const Ghost> of_particle, const Vec<D>& x, const Ghost& ghost,
                                    double spacing) const {
    const auto image = [&](const Ghost& of) {
        const Vec<D> shift = periodic.shift(of.wall_copy);
        return Vec<D>(mirror(x - shift, of).image + shift);
    };
    return std::any_of(of_particle.begin(), of_particle.end(), [&](const Ghost& other) {
        return other.wall_copy != ghost.wall_copy &&
               (image(other) - image(ghost)).squaredNorm() < 1e-12 * spacing * spacing;
    });
}

template <int D>
void GhostWalls<D>::collect_corners(std::size_t j, const Vec<D>& x, const typename PanelGrid<D>::Cell& cell,
                                    double spacing, double reach, std::vector<Ghost>& found) const {
    const double tolerance = 0.5 * spacing;
    for (std::size_t entry = 0; entry < cell.corner.size(); ++entry) {
        const Corner<D>& corner = corners[std::size_t(cell.corner[entry])];
        const int copy = cell.corner_copy[entry];
        const Vec<D> there = copy == 0 ? x : Vec<D>(x - periodic.shift(copy));
        Vec<D> from = there - corner.point;
        if constexpr (D == 3) {
            if (!corner.is_point()) {
                const double length = corner.edge.norm(), s = from.dot(corner.edge) / length;
                if (s < -corner_slack_ || s >= length - corner_slack_) continue;
                from -= s / length * corner.edge;
            }
        }
        if (from.squaredNorm() >= reach * reach) continue;
        bool mirrors = true;
        for (std::size_t k = 0; k < corner.aways && mirrors; ++k) mirrors = from.dot(corner.away[k]) >= 0;
        for (std::size_t k = 0; k < corner.panels && mirrors; ++k)
            mirrors = from.dot(panels.normal[std::size_t(corner.panel[k])]) > -tolerance;
        if (mirrors) found.push_back({std::uint32_t(j), -1, cell.corner[entry], std::uint8_t(copy), 0});
    }
}

template <int D>
void GhostWalls<D>::collect_images(const Particles<D>& particles, const Ghost& ghost, double reach,
                                   std::vector<Ghost>& found) const {
    for (int copy = 1; copy < Periodic<D>::copies; ++copy) {
        if (!periodic.exists(copy)) continue;
        Ghost image = ghost;
        image.copy = std::uint8_t(copy);
        if (periodic.is_near(place(particles, image), copy, reach)) found.push_back(image);
    }
}

template <int D>
Vec<D> GhostWalls<D>::before_wall(const Particles<D>& particles, const Ghost& ghost) const {
    const Vec<D> x = at<D>(particles.x, ghost.parent);
    return ghost.wall_copy == 0 ? x : Vec<D>(x - periodic.shift(ghost.wall_copy));
}

template <int D>
Vec<D> GhostWalls<D>::place(const Particles<D>& particles, const Ghost& ghost) const {
    return mirror(before_wall(particles, ghost), ghost).image + periodic.shift(ghost.wall_copy) +
           periodic.shift(ghost.copy);
}

template <int D>
typename GhostWalls<D>::Mirror GhostWalls<D>::mirror_at_corner(const Vec<D>& x, const Corner<D>& corner) const {
    Mirror m;
    m.wall_velocity = corner.velocity;
    m.S = -Mat<D>::Identity();
    Vec<D> from = x - corner.point;
    bool slips_along = false;
    if constexpr (D == 3) {
        if (!corner.is_point()) {
            const Vec3 along = corner.edge.normalized();
            from -= from.dot(along) * along;
            m.S += 2 * along * along.transpose();
            m.wall_velocity += std::clamp(corner.along(x), 0.0, 1.0) * corner.edge_velocity;
            slips_along = !panels.panels[std::size_t(corner.panel[0])].no_slip &&
                          !panels.panels[std::size_t(corner.panel[1])].no_slip;
        }
        m.image = x - 2 * from;
    } else {
        m.image = corner.point - from;
    }
    m.T = slips_along ? m.S : Mat<D>(-Mat<D>::Identity());
    if (!corner.sharp) {  // nearly flat: like a plane across the line to the corner
        const Vec<D> e = from.normalized();
        m.T = Mat<D>::Identity() - 2 * e * e.transpose();
    }
    return m;
}

template <int D>
typename GhostWalls<D>::Mirror GhostWalls<D>::mirror(const Vec<D>& x, const Ghost& ghost) const {
    if (ghost.corner >= 0) return mirror_at_corner(x, corners[std::size_t(ghost.corner)]);
    Mirror m;
    if (ghost.is_image()) {
        m.image = x;
        m.wall_velocity = Vec<D>::Zero();
        m.S = m.T = Mat<D>::Identity();
        return m;
    }
    const auto k = std::size_t(ghost.panel);
    const Panel<D>& panel = panels.panels[k];
    const Vec<D>& n = panels.normal[k];
    const auto shape = panels.shape_functions_on(k, x);
    m.wall_velocity = shape[0] * panels.velocity[std::size_t(panel.vertex[0])];
    for (std::size_t v = 1; v < D; ++v) m.wall_velocity += shape[v] * panels.velocity[std::size_t(panel.vertex[v])];
    m.S = Mat<D>::Identity() - 2 * n * n.transpose();
    m.T = panel.no_slip ? Mat<D>(-Mat<D>::Identity()) : m.S;
    m.image = x - 2 * std::max(panels.height(k, x), least_depth_) * n;
    return m;
}

template <int D>
void GhostWalls<D>::update_state(Particles<D>& particles, const Vec<D>& gravity, std::size_t block) const {
    const std::size_t begin = block * ghosts_per_block, end = std::min(ghosts.size(), begin + ghosts_per_block);
    for (std::size_t g = begin; g < end; ++g) {
        const Ghost& ghost = ghosts[g];
        const std::size_t j = ghost.parent, lane = particles.ghost_begin() + g;
        const Vec<D> x = before_wall(particles, ghost), v = at<D>(particles.v, j);
        const Mirror m = mirror(x, ghost);
        const Vec<D> image = m.image + periodic.shift(ghost.wall_copy) + periodic.shift(ghost.copy),
                     v_ghost = ghost.is_image() ? v : Vec<D>(m.wall_velocity + m.T * (v - m.wall_velocity));
        for (int d = 0; d < D; ++d) {
            particles.x[std::size_t(d)][lane] = image[d];
            particles.v[std::size_t(d)][lane] = v_ghost[d];
        }
        const double density = particles.mass[j] / particles.volume[j];
        particles.p[lane] = particles.p[j] + density * gravity.dot(m.image - x);
        particles.impedance[lane] = particles.impedance[j];
        particles.volume[lane] = particles.volume[j];
        // Water goes over into its periodic image, not through a wall.
        if (particles.has_mass_exchange) particles.exchange[lane] = ghost.is_image() ? 1 : 0;
    }
    for (const auto& share : shares.of(begin, end)) {
        const Ghost& ghost = ghosts[share.ghost];
        const Vec<D> image = mirror(before_wall(particles, ghost), ghost).image;
        particles.volume[particles.ghost_begin() + share.ghost] *= shares.weight(share, image);
    }
}

template <int D>
void GhostWalls<D>::update_shift(Particles<D>& particles, std::size_t block) const {
    const std::size_t begin = block * ghosts_per_block, end = std::min(ghosts.size(), begin + ghosts_per_block);
    for (std::size_t g = begin; g < end; ++g) {
        if (!ghosts[g].is_image()) continue;
        for (auto& component : particles.shift) component[particles.ghost_begin() + g] = component[ghosts[g].parent];
    }
}

template <int D>
void GhostWalls<D>::update_gradients(Particles<D>& particles, const Vec<D>& gravity, std::size_t block) const {
    const std::size_t begin = block * ghosts_per_block, end = std::min(ghosts.size(), begin + ghosts_per_block);
    for (std::size_t g = begin; g < end; ++g) {
        const Ghost& ghost = ghosts[g];
        const std::size_t j = ghost.parent, lane = particles.ghost_begin() + g;
        const Vec<D> grad_p = at<D>(particles.grad_p, j);
        Mat<D> grad_v;
        for (int d = 0; d < D; ++d)
            for (int e = 0; e < D; ++e) grad_v(d, e) = particles.grad_v[std::size_t(d)][std::size_t(e)][j];
        Vec<D> ghost_grad_p = grad_p;
        if (!ghost.is_image()) {
            const Mirror m = mirror(before_wall(particles, ghost), ghost);
            // The hydrostatic part goes on behind the wall, only the rest is mirrored. A particle too bare to have a
            // gradient leaves its ghost without one.
            const bool bare = grad_p.squaredNorm() == 0;
            const Vec<D> weight = particles.mass[j] / particles.volume[j] * gravity;
            ghost_grad_p = bare ? Vec<D>(Vec<D>::Zero()) : Vec<D>(weight + m.S * (grad_p - weight));
            grad_v = Mat<D>(m.T * grad_v * m.S);
        }
        particles.fullness[lane] = particles.fullness[j];
        for (int d = 0; d < D; ++d) {
            particles.grad_p[std::size_t(d)][lane] = ghost_grad_p[d];
            for (int e = 0; e < D; ++e) particles.grad_v[std::size_t(d)][std::size_t(e)][lane] = grad_v(d, e);
        }
    }
}

// Since the lists were built a particle may have moved on to the next triangle of a smooth surface: the panel that
// mirrors it goes on there.
template <int D>
bool GhostWalls<D>::is_held_by(std::size_t panel, const Vec<D>& x) const {
    if constexpr (D == 2) {
        return panels.is_over(panel, x);
    } else {
        const auto shape = panels.shape_functions(panel, x);
        for (std::size_t v = 0; v < D; ++v)
            if (shape[v] < 0 && !goes_on_[panel][v]) return false;
        return true;
    }
}

template <int D>
std::size_t GhostWalls<D>::hold_back(Particles<D>& particles, double spacing) const {
    std::size_t held = 0;
    for (const Ghost& ghost : ghosts) {
        if (ghost.panel < 0 || ghost.copy != 0) continue;
        const auto k = std::size_t(ghost.panel);
        const std::size_t j = ghost.parent;
        const Vec<D> x = before_wall(particles, ghost);
        const double d = panels.height(k, x);
        if (d >= 0 || d < -0.5 * spacing || !is_held_by(k, x)) continue;
        const Vec<D> v = at<D>(particles.v, j) - mirror(x, ghost).wall_velocity;
        const Vec<D> back = (1e-3 * spacing - d) * panels.normal[k],
                     slower = std::max(0.0, -v.dot(panels.normal[k])) * panels.normal[k];
        for (int c = 0; c < D; ++c) {
            particles.x[std::size_t(c)][j] += back[c];
            particles.v[std::size_t(c)][j] += slower[c];
        }
        ++held;
    }
    return held;
}

template <int D>
Escape GhostWalls<D>::deepest(const Particles<D>& particles) const {
    Escape escape;
    for (const Ghost& ghost : ghosts) {
        if (ghost.panel < 0 || ghost.copy != 0) continue;
        const auto k = std::size_t(ghost.panel);
        const Vec<D> x = before_wall(particles, ghost);
        const double depth = -panels.height(k, x);
        if (depth > escape.depth && is_held_by(k, x)) escape = {ghost.parent, depth, ghost.panel};
    }
    return escape;
}

template class GhostWalls<2>;
template class GhostWalls<3>;

}  // namespace aquagraph::fluid
