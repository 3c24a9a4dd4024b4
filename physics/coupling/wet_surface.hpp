// The solid's wet surface as moving panels of the fluid's walls: one panel per half of a quadratic edge, so that every
// panel runs straight from node to node. Positions and velocities of the wet nodes are taken at each exchange and
// extrapolated in between (thesis (6.1)): x + l Δt v. They are never frozen.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "physics/fluid/walls/panels.hpp"
#include "physics/solid/mesh.hpp"

namespace aquagraph::coupling {

using fluid::Vec2;

class WetSurface {
  public:
    WetSurface() = default;
    // Adds the panels of these surfaces to `panels`, as one wall. Throws std::invalid_argument for an unknown surface.
    WetSurface(const solid::Mesh<2>& mesh, const std::vector<std::string>& surfaces, const std::string& name,
               fluid::Panels<2>& panels);

    // Takes the solid's state, interleaved x and y per node.
    void take(std::span<const double> positions, std::span<const double> velocities);
    // Places the panels' vertices `ahead` seconds after the last exchange.
    void place(fluid::Panels<2>& panels, double ahead) const;
    // Adds the forces on vertices (one per vertex of `panels`) to nodal forces, interleaved; clears them first.
    void to_nodes(const std::vector<Vec2>& vertex_forces, std::span<double> nodal_forces) const;

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint: the last exchange
        fields(position_, velocity_);
    }

    int wall() const { return wall_; }
    std::size_t vertices() const { return nodes_.size(); }
    double largest_speed() const;  // of wet nodes [m/s]

  private:
    std::vector<int> nodes_;        // node of each vertex
    std::size_t first_vertex_ = 0;  // in panels
    int wall_ = -1;
    std::vector<Vec2> position_, velocity_;
};

}  // namespace aquagraph::coupling
