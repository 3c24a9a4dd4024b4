// The solid's wet surface as moving panels of the fluid's walls: one panel per half of a quadratic edge, so that every
// panel runs straight from node to node. Positions and velocities of the wet nodes are taken at each exchange; in
// between, τ later, they are
//     linear     x + τ v, v            (thesis (6.1))
//     quadratic  x + τ v + ½ τ² a, v + τ a, with a from the velocities of the last two exchanges
//     none       x, v                  frozen, to show why they should not be
// Where fluid and solid of a cycle are iterated, the end of the cycle is known as a guess, and wet nodes follow the
// cubic that has the places and velocities of both its ends.
//
// What the water sees of the nodes' motion may be smoothed, and what it exerts on them then is too: wet_smoothing.hpp.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "physics/coupling/choices.hpp"
#include "physics/coupling/wet_smoothing.hpp"
#include "physics/fluid/walls/panels.hpp"
#include "physics/solid/mesh.hpp"

namespace aquagraph::coupling {

using fluid::Vec2;

// What the water knows of the wet nodes since the last exchange, smoothed.
struct WetMotion {
    std::vector<Vec2> position, velocity, acceleration;
    bool known = false;                            // whether an exchange has been made
    double cycle = 0;                              // > 0: the cubic that ends then [s] …
    std::vector<Vec2> end_position, end_velocity;  // … there

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint, between cycles
        fields(position, velocity, acceleration, known);
    }
};

class WetSurface {
  public:
    Extrapolation extrapolation = Extrapolation::linear;
    WetMotion motion;

    WetSurface() = default;
    // Adds the panels of these surfaces to `panels`, as one wall. smoothing: ℓ of wet_smoothing.hpp [m]. Throws
    // std::invalid_argument for an unknown surface.
    WetSurface(const solid::Mesh<2>& mesh, const std::vector<std::string>& surfaces, const std::string& name,
               fluid::Panels<2>& panels, double smoothing = 0);

    // Takes the solid's state, interleaved x and y per node, `elapsed` seconds after the last one (0: unknown, no
    // acceleration is taken).
    void take(std::span<const double> positions, std::span<const double> velocities, double elapsed = 0);
    // The state at the end of a cycle as one vector, positions and velocities × its length [m] of each wet node, all of
    // them smoothed: at the last exchange, as extrapolated, and as the solid has it.
    void state(std::vector<double>& y, double cycle) const;
    void extrapolated(std::vector<double>& y, double cycle) const;
    void state_of(std::span<const double> positions, std::span<const double> velocities, std::vector<double>& y,
                  double cycle);
    // From now on nodes move towards this state.
    void head_for(std::span<const double> y, double cycle);

    // Places the panels' vertices `ahead` seconds after the last exchange.
    void place(fluid::Panels<2>& panels, double ahead) const;
    // How far vertices will then be from these places of all vertices of the panels [m].
    double largest_distance(const std::vector<Vec2>& from, double ahead) const;
    // ∫ (φ·n)² over those of its panels that are in contact with water (one entry per panel of `panels`), φ given at
    // the body's nodes, interleaved [m × the square of φ's unit].
    double squared_normal_motion(const fluid::Panels<2>& panels, const std::vector<bool>& in_contact,
                                 std::span<const double> nodal) const;
    // The nodal forces, interleaved, of these forces on vertices (one per vertex of `panels`); 0 at dry nodes.
    void to_nodes(const std::vector<Vec2>& vertex_forces, std::span<double> nodal_forces);

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint: the last exchange
        fields(motion);
    }

    int wall() const { return wall_; }
    std::size_t vertices() const { return nodes_.size(); }

  private:
    Vec2 position_at(std::size_t k, double ahead) const;
    Vec2 velocity_at(std::size_t k, double ahead) const;
    // One Vec2 per wet node, of values at all nodes, interleaved.
    void collect(std::span<const double> nodal, std::vector<Vec2>& wet) const;
    void smooth(std::span<const double> positions, std::span<const double> velocities);  // into the scratch below

    WetSmoothing smoothing_;
    std::vector<Vec2> nodal_, position_, velocity_;  // scratch: before smoothing, and after …
    std::vector<Vec2> force_;                        // … and of forces
    std::vector<int> nodes_;                         // node of each vertex
    std::size_t first_vertex_ = 0;                   // in panels
    int wall_ = -1;
};

}  // namespace aquagraph::coupling
