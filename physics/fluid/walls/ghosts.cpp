#include "physics/fluid/walls/ghosts.hpp"

#include <Eigen/Geometry>

namespace aquagraph::fluid {

void GhostWalls::update_geometry() {
    panels.update_geometry();
    for (Corner& corner : corners) corner.update(panels);
}

void GhostWalls::rebuild(Particles<2>& particles, double spacing, double reach, const Vec2& gravity) {
    panels.update_geometry();
    patch = smooth_patches(panels);
    corners = find_corners(panels, 0.5 * spacing);
    grid.build(panels, patch, reach);
    least_depth_ = 0.05 * spacing;
    collect(particles, spacing, reach);

    image_[0].resize(unsorted_.size());
    image_[1].resize(unsorted_.size());
    for (std::size_t g = 0; g < unsorted_.size(); ++g) {
        const Vec2 image = mirror(particles, unsorted_[g]).image;
        image_[0][g] = image.x();
        image_[1][g] = image.y();
        if (sticks_out(particles, unsorted_[g], image)) grid.look_closely_around(image);
    }
    const auto order = order_.sort(image_, unsorted_.size(), spacing);
    ghosts.resize(unsorted_.size());
    for (std::size_t g = 0; g < ghosts.size(); ++g) ghosts[g] = unsorted_[order[g]];

    particles.resize(particles.count, ghosts.size());
    for (std::size_t block = 0; block < blocks(); ++block) update_state(particles, gravity, block);
    visibility.prepare(particles, panels, grid, ghosts, corners, patch, 0.5 * spacing);
}

// True if the image lies beyond another side of the body behind the panel.
bool GhostWalls::sticks_out(const Particles<2>& particles, const Ghost& ghost, const Vec2& image) const {
    if (ghost.panel < 0) return false;
    const Vec2 x(particles.x[0][ghost.parent], particles.x[1][ghost.parent]);
    const PanelGrid::Cell* cell = grid.at(x.x(), x.y());
    if (!cell || cell->convex_room) return false;
    const auto panel = std::size_t(ghost.panel);
    const Vec2 foot = x - (x - panels.start(panel)).dot(panels.normal[panel]) * panels.normal[panel];
    return PanelGrid::first_crossing(*cell, foot, image, patch[panel]).entry >= 0;
}

void GhostWalls::collect(const Particles<2>& particles, double spacing, double reach) {
    unsorted_.clear();
    const double tolerance = 0.5 * spacing;
    for (std::size_t j = 0; j < particles.count; ++j) {
        const Vec2 x(particles.x[0][j], particles.x[1][j]);
        const PanelGrid::Cell* cell = grid.at(x.x(), x.y());
        if (!cell) continue;
        for (const int k : cell->panel) {
            const auto panel = std::size_t(k);
            const Vec2 from = x - panels.start(panel);
            const double d = from.dot(panels.normal[panel]), s = from.dot(panels.tangent[panel]);
            if (d <= -tolerance || d >= reach || s < 0 || s >= panels.measure[panel]) continue;
            if (!cell->convex_room && d > 0) {
                // Something between the particle and the foot of its perpendicular hides the panel from it.
                const Vec2 foot = x - (d - 1e-6 * spacing) * panels.normal[panel];
                if (PanelGrid::first_crossing(*cell, x, foot).entry >= 0) continue;
            }
            unsorted_.push_back({std::uint32_t(j), k, -1});
        }
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const Corner& corner = corners[c];
            const Vec2 from = x - corner.point;
            if (from.squaredNorm() >= reach * reach) continue;
            const auto k = std::size_t(corner.panel[0]), l = std::size_t(corner.panel[1]);
            if (from.dot(corner.away[0]) < 0 || from.dot(corner.away[1]) < 0 ||
                from.dot(panels.normal[k]) <= -tolerance || from.dot(panels.normal[l]) <= -tolerance)
                continue;
            unsorted_.push_back({std::uint32_t(j), -1, std::int32_t(c)});
        }
    }
}

GhostWalls::Mirror GhostWalls::mirror(const Particles<2>& particles, const Ghost& ghost) const {
    const Vec2 x(particles.x[0][ghost.parent], particles.x[1][ghost.parent]);
    Mirror m;
    if (ghost.corner >= 0) {
        const Corner& corner = corners[std::size_t(ghost.corner)];
        const Vec2 from = x - corner.point;
        m.image = corner.point - from;
        m.wall_velocity = corner.velocity;
        m.S = -Eigen::Matrix2d::Identity();
        m.T = m.S;
        if (!corner.sharp) {  // nearly flat: like a plane across the line to the corner
            const Vec2 e = from.normalized();
            m.T = Eigen::Matrix2d::Identity() - 2 * e * e.transpose();
        }
        return m;
    }
    const auto k = std::size_t(ghost.panel);
    const Panel<2>& panel = panels.panels[k];
    const Vec2& n = panels.normal[k];
    const Vec2 from = x - panels.start(k);
    const double s = std::clamp(from.dot(panels.tangent[k]) / panels.measure[k], 0.0, 1.0);
    const Vec2 &v_first = panels.velocity[std::size_t(panel.vertex[0])],
               &v_second = panels.velocity[std::size_t(panel.vertex[1])];
    m.wall_velocity = (1 - s) * v_first + s * v_second;
    m.S = Eigen::Matrix2d::Identity() - 2 * n * n.transpose();
    m.T = panel.no_slip ? Eigen::Matrix2d(-Eigen::Matrix2d::Identity()) : m.S;
    m.image = x - 2 * std::max(from.dot(n), least_depth_) * n;
    return m;
}

void GhostWalls::update_state(Particles<2>& particles, const Vec2& gravity, std::size_t block) const {
    const std::size_t begin = block * ghosts_per_block, end = std::min(ghosts.size(), begin + ghosts_per_block);
    for (std::size_t g = begin; g < end; ++g) {
        const std::size_t j = ghosts[g].parent, lane = particles.ghost_begin() + g;
        const Mirror m = mirror(particles, ghosts[g]);
        const Vec2 x(particles.x[0][j], particles.x[1][j]), v(particles.v[0][j], particles.v[1][j]);
        const Vec2 v_ghost = m.wall_velocity + m.T * (v - m.wall_velocity);
        for (int d = 0; d < 2; ++d) {
            particles.x[std::size_t(d)][lane] = m.image[d];
            particles.v[std::size_t(d)][lane] = v_ghost[d];
        }
        const double density = particles.mass[j] / particles.volume[j];
        particles.p[lane] = particles.p[j] + density * gravity.dot(m.image - x);
        particles.impedance[lane] = particles.impedance[j];
        particles.volume[lane] = particles.volume[j];
    }
}

void GhostWalls::update_gradients(Particles<2>& particles, const Vec2& gravity, std::size_t block) const {
    const std::size_t begin = block * ghosts_per_block, end = std::min(ghosts.size(), begin + ghosts_per_block);
    for (std::size_t g = begin; g < end; ++g) {
        const std::size_t j = ghosts[g].parent, lane = particles.ghost_begin() + g;
        const Mirror m = mirror(particles, ghosts[g]);
        const Vec2 grad_p(particles.grad_p[0][j], particles.grad_p[1][j]);
        Eigen::Matrix2d grad_v;
        grad_v << particles.grad_v[0][0][j], particles.grad_v[0][1][j], particles.grad_v[1][0][j],
            particles.grad_v[1][1][j];
        // The hydrostatic part goes on behind the wall, only the rest is mirrored. A particle too bare to have a
        // gradient leaves its ghost without one.
        const bool bare = grad_p.squaredNorm() == 0;
        const Vec2 weight = particles.mass[j] / particles.volume[j] * gravity;
        const Vec2 ghost_grad_p = bare ? Vec2(Vec2::Zero()) : Vec2(weight + m.S * (grad_p - weight));
        const Eigen::Matrix2d ghost_grad_v = m.T * grad_v * m.S;
        for (int d = 0; d < 2; ++d) {
            particles.grad_p[std::size_t(d)][lane] = ghost_grad_p[d];
            for (int e = 0; e < 2; ++e) particles.grad_v[std::size_t(d)][std::size_t(e)][lane] = ghost_grad_v(d, e);
        }
    }
}

std::size_t GhostWalls::hold_back(Particles<2>& particles, double spacing) const {
    std::size_t held = 0;
    for (const Ghost& ghost : ghosts) {
        if (ghost.panel < 0) continue;
        const auto k = std::size_t(ghost.panel);
        const std::size_t j = ghost.parent;
        const Vec2 from = Vec2(particles.x[0][j], particles.x[1][j]) - panels.start(k);
        const double d = from.dot(panels.normal[k]), s = from.dot(panels.tangent[k]);
        if (d >= 0 || d < -0.5 * spacing || s < 0 || s > panels.measure[k]) continue;
        const Vec2 v = Vec2(particles.v[0][j], particles.v[1][j]) - mirror(particles, ghost).wall_velocity;
        const Vec2 back = (1e-3 * spacing - d) * panels.normal[k],
                   slower = std::max(0.0, -v.dot(panels.normal[k])) * panels.normal[k];
        for (int c = 0; c < 2; ++c) {
            particles.x[std::size_t(c)][j] += back[c];
            particles.v[std::size_t(c)][j] += slower[c];
        }
        ++held;
    }
    return held;
}

Escape GhostWalls::deepest(const Particles<2>& particles) const {
    Escape escape;
    for (const Ghost& ghost : ghosts) {
        if (ghost.panel < 0) continue;
        const auto k = std::size_t(ghost.panel);
        const Vec2 from = Vec2(particles.x[0][ghost.parent], particles.x[1][ghost.parent]) - panels.start(k);
        const double depth = -from.dot(panels.normal[k]), s = from.dot(panels.tangent[k]);
        if (s < 0 || s > panels.measure[k]) continue;
        if (depth > escape.depth) escape = {ghost.parent, depth, ghost.panel};
    }
    return escape;
}

}  // namespace aquagraph::fluid
