#include "physics/coupling/wet_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace aquagraph::coupling {

WetSurface::WetSurface(const solid::Mesh<2>& mesh, const std::vector<std::string>& surfaces, const std::string& name,
                       fluid::Panels<2>& panels, double smoothing)
    : first_vertex_(panels.position.size()), wall_(int(panels.names.size())) {
    panels.names.push_back(name);
    const std::size_t first_panel = panels.panels.size();
    std::map<int, int> vertex_of_node;
    const auto vertex = [&](int node) {
        const auto [place, is_new] = vertex_of_node.try_emplace(node, int(panels.position.size()));
        if (is_new) {
            nodes_.push_back(node);
            const auto& x = mesh.nodes[std::size_t(node)];
            panels.position.emplace_back(x[0], x[1]);
            panels.velocity.push_back(Vec2::Zero());
        }
        return place->second;
    };
    for (const std::string& surface : surfaces) {
        for (const solid::Facet& edge : mesh.surface(surface)) {
            // Edges keep the solid on their left, panels keep the fluid there: walk the other way.
            const int a = vertex(edge[1]);
            const int m = edge.size() == 3 ? vertex(edge[2]) : a;
            const int b = vertex(edge[0]);
            if (m != a) panels.panels.push_back({{a, m}, wall_, false, true});
            panels.panels.push_back({{m, b}, wall_, false, true});
        }
    }
    motion.position.assign(panels.position.begin() + std::ptrdiff_t(first_vertex_), panels.position.end());
    motion.velocity.assign(nodes_.size(), Vec2::Zero());
    motion.acceleration = motion.velocity;
    nodal_ = position_ = velocity_ = force_ = motion.velocity;

    std::vector<std::array<std::size_t, 2>> segments;
    for (std::size_t k = first_panel; k < panels.panels.size(); ++k) {
        const auto& end = panels.panels[k].vertex;
        segments.push_back({std::size_t(end[0]) - first_vertex_, std::size_t(end[1]) - first_vertex_});
    }
    smoothing_ = WetSmoothing(motion.position, segments, smoothing);
}

void WetSurface::collect(std::span<const double> nodal, std::vector<Vec2>& wet) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const std::size_t n = 2 * std::size_t(nodes_[k]);
        wet[k] = Vec2(nodal[n], nodal[n + 1]);
    }
}

void WetSurface::smooth(std::span<const double> positions, std::span<const double> velocities) {
    const bool changes = smoothing_.changes();
    collect(positions, changes ? nodal_ : position_);
    if (changes) smoothing_.smooth_positions(nodal_, position_);
    collect(velocities, changes ? nodal_ : velocity_);
    if (changes) smoothing_.smooth(nodal_, velocity_);
}

void WetSurface::take(std::span<const double> positions, std::span<const double> velocities, double elapsed) {
    smooth(positions, velocities);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        motion.acceleration[k] =
            motion.known && elapsed > 0 ? Vec2((velocity_[k] - motion.velocity[k]) / elapsed) : Vec2(Vec2::Zero());
        motion.position[k] = position_[k];
        motion.velocity[k] = velocity_[k];
    }
    motion.known = true;
    motion.cycle = 0;
}

Vec2 WetSurface::position_at(std::size_t k, double ahead) const {
    if (motion.cycle > 0) {
        const double s = ahead / motion.cycle, t = 1 - s;
        return t * t * ((1 + 2 * s) * motion.position[k] + ahead * motion.velocity[k]) +
               s * s * ((1 + 2 * t) * motion.end_position[k] - t * motion.cycle * motion.end_velocity[k]);
    }
    switch (extrapolation) {
        case Extrapolation::none:
            return motion.position[k];
        case Extrapolation::quadratic:
            return motion.position[k] + ahead * (motion.velocity[k] + 0.5 * ahead * motion.acceleration[k]);
        default:
            return motion.position[k] + ahead * motion.velocity[k];
    }
}

Vec2 WetSurface::velocity_at(std::size_t k, double ahead) const {
    if (motion.cycle > 0) {
        const double s = ahead / motion.cycle, t = 1 - s;
        return 6 * s * t / motion.cycle * (motion.end_position[k] - motion.position[k]) +
               t * (1 - 3 * s) * motion.velocity[k] + s * (1 - 3 * t) * motion.end_velocity[k];
    }
    if (extrapolation == Extrapolation::quadratic) return motion.velocity[k] + ahead * motion.acceleration[k];
    return motion.velocity[k];
}

void WetSurface::place(fluid::Panels<2>& panels, double ahead) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        panels.position[first_vertex_ + k] = position_at(k, ahead);
        panels.velocity[first_vertex_ + k] = velocity_at(k, ahead);
    }
}

namespace {
void put(std::vector<double>& y, std::size_t k, const Vec2& position, const Vec2& way) {
    y[4 * k] = position.x();
    y[4 * k + 1] = position.y();
    y[4 * k + 2] = way.x();
    y[4 * k + 3] = way.y();
}
}  // namespace

void WetSurface::state(std::vector<double>& y, double cycle) const {
    y.resize(4 * nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) put(y, k, motion.position[k], cycle * motion.velocity[k]);
}

void WetSurface::extrapolated(std::vector<double>& y, double cycle) const {
    y.resize(4 * nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) put(y, k, position_at(k, cycle), cycle * velocity_at(k, cycle));
}

void WetSurface::state_of(std::span<const double> positions, std::span<const double> velocities, std::vector<double>& y,
                          double cycle) {
    y.resize(4 * nodes_.size());
    smooth(positions, velocities);
    for (std::size_t k = 0; k < nodes_.size(); ++k) put(y, k, position_[k], cycle * velocity_[k]);
}

void WetSurface::head_for(std::span<const double> y, double cycle) {
    motion.end_position.resize(nodes_.size());
    motion.end_velocity.resize(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        motion.end_position[k] = Vec2(y[4 * k], y[4 * k + 1]);
        motion.end_velocity[k] = Vec2(y[4 * k + 2], y[4 * k + 3]) / cycle;
    }
    motion.cycle = cycle;
}

double WetSurface::largest_distance(const std::vector<Vec2>& from, double ahead) const {
    double largest2 = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k)
        largest2 = std::max(largest2, (position_at(k, ahead) - from[first_vertex_ + k]).squaredNorm());
    return std::sqrt(largest2);
}

double WetSurface::squared_normal_motion(const fluid::Panels<2>& panels, const std::vector<bool>& in_contact,
                                         std::span<const double> nodal) const {
    double sum = 0;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (panels.panels[k].wall != wall_ || !in_contact[k]) continue;
        std::array<double, 2> along_normal;
        for (std::size_t end = 0; end < 2; ++end) {
            const std::size_t vertex = std::size_t(panels.panels[k].vertex[end]) - first_vertex_,
                              n = 2 * std::size_t(nodes_[vertex]);
            along_normal[end] = Vec2(nodal[n], nodal[n + 1]).dot(panels.normal[k]);
        }
        const auto [a, b] = along_normal;
        sum += panels.measure[k] / 3 * (a * a + a * b + b * b);
    }
    return sum;
}

void WetSurface::to_nodes(const std::vector<Vec2>& vertex_forces, std::span<double> nodal_forces) {
    std::span<const Vec2> forces(vertex_forces.data() + first_vertex_, nodes_.size());
    if (smoothing_.changes()) {
        smoothing_.gather(forces, force_);
        forces = force_;
    }
    std::fill(nodal_forces.begin(), nodal_forces.end(), 0.0);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const std::size_t n = 2 * std::size_t(nodes_[k]);
        nodal_forces[n] = forces[k].x();
        nodal_forces[n + 1] = forces[k].y();
    }
}

}  // namespace aquagraph::coupling
