// Which degrees of freedom are not unknowns: clamped, prescribed, or those of a rigid body's nodes.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "physics/solid/mesh.hpp"
#include "physics/solid/options.hpp"

namespace aquagraph::solid {

// By D node + direction. Throws std::invalid_argument for an unknown set, and where a motion or a rigid body holds what
// something else holds already.
template <int D>
std::vector<bool> held_freedoms(const Mesh<D>& mesh, const Options<D>& options);

// Prescribed motions of nodes: their displacements, velocities and accelerations are those of their laws, exactly.
template <int D>
class PrescribedMotions {
  public:
    PrescribedMotions(const Mesh<D>& mesh, const std::vector<Motion<D>>& motions);

    const std::vector<std::size_t>& freedoms() const { return freedoms_; }  // D node + direction, of all

    // At time t [s]; D × nodes.
    void place(double t, std::span<double> u, std::span<double> v, std::span<double> a) const;
    void set_rates(double t, std::span<double> v, std::span<double> a) const;  // velocities and accelerations alone
    // u = start + part × (displacement at t - start)
    void ramp(double t, double part, std::span<const double> start, std::span<double> u) const;

  private:
    struct Group {
        TimeFunction displacement;
        std::size_t first, last;  // in freedoms_
    };
    std::vector<Group> groups_;
    std::vector<std::size_t> freedoms_;
};

}  // namespace aquagraph::solid
