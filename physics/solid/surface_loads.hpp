// Pressures that follow the deformed surface: f_a = -p(t) ∫ N_a n da, n pointing out (Bonet & Wood, 2nd ed., 8.5.2).
// (Loads that do not follow it: dead_loads.hpp.) The tangent is symmetrised, facet by facet: of a closed surface, or
// one whose rim is held, the sum is symmetric anyway, and the parts that are dropped cancel; at a free rim they do not,
// and Newton takes longer.
#pragma once
#include <span>
#include <vector>

#include "physics/solid/options.hpp"
#include "physics/solid/surface_facets.hpp"

namespace aquagraph::solid {

template <int D>
class SurfaceLoads {
  public:
    SurfaceLoads(const Mesh<D>& mesh, const Options<D>& options);

    // nodal += the loads at time t with these displacements.
    void add_forces(double t, std::span<const double> u, std::span<double> nodal, BlockLoop loop);
    // -∂f/∂u of the pressures × factor, into the matrices of their facets (stiff_facets).
    void tangents(double t, double factor, std::span<const double> u, std::span<double> matrices, BlockLoop loop) const;
    std::size_t matrix_size() const;

  private:
    struct Following {
        TimeFunction pressure;
        SurfaceFacets<D> facets;
    };
    std::vector<Following> pressures_;
};

}  // namespace aquagraph::solid
