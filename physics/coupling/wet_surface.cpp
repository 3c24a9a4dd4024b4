#include "physics/coupling/wet_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace aquagraph::coupling {

WetSurface::WetSurface(const solid::Mesh<2>& mesh, const std::vector<std::string>& surfaces, const std::string& name,
                       fluid::Panels<2>& panels)
    : first_vertex_(panels.position.size()), wall_(int(panels.names.size())) {
    panels.names.push_back(name);
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
    position_.assign(panels.position.begin() + std::ptrdiff_t(first_vertex_), panels.position.end());
    velocity_.assign(nodes_.size(), Vec2::Zero());
}

void WetSurface::take(std::span<const double> positions, std::span<const double> velocities) {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const std::size_t n = 2 * std::size_t(nodes_[k]);
        position_[k] = Vec2(positions[n], positions[n + 1]);
        velocity_[k] = Vec2(velocities[n], velocities[n + 1]);
    }
}

void WetSurface::place(fluid::Panels<2>& panels, double ahead) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        panels.position[first_vertex_ + k] = position_[k] + ahead * velocity_[k];
        panels.velocity[first_vertex_ + k] = velocity_[k];
    }
}

void WetSurface::to_nodes(const std::vector<Vec2>& vertex_forces, std::span<double> nodal_forces) const {
    std::fill(nodal_forces.begin(), nodal_forces.end(), 0.0);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const std::size_t n = 2 * std::size_t(nodes_[k]);
        nodal_forces[n] = vertex_forces[first_vertex_ + k].x();
        nodal_forces[n + 1] = vertex_forces[first_vertex_ + k].y();
    }
}

double WetSurface::largest_speed() const {
    double largest = 0;
    for (const Vec2& v : velocity_) largest = std::max(largest, v.squaredNorm());
    return std::sqrt(largest);
}

}  // namespace aquagraph::coupling
