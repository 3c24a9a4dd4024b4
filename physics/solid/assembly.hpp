// From elements to the body: which degrees of freedom are free, sums of element forces at the nodes, the consistent
// mass matrix, the sparse system matrix. Every sum runs over a precomputed list in a fixed order, so that blocks may be
// done by any number of threads and the bits stay the same. Nothing here allocates once constructed.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/solid/element_group.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/options.hpp"
#include "physics/solid/viscous_elements.hpp"

namespace aquagraph::solid {

// Rows of contributions: those to row r are entries[starts[r]] … entries[starts[r + 1] - 1].
struct Lists {
    std::vector<std::size_t> starts;
    std::vector<std::uint32_t> entries;
};

template <int D>
class Assembly {
  public:
    // Throws std::invalid_argument for an unknown set or a law that there is not.
    Assembly(const Mesh<D>& mesh, const Options<D>& options);

    std::size_t nodes() const { return node_elements_.starts.size() - 1; }
    std::size_t equations() const { return freedoms_.size(); }
    const std::vector<int>& equation_of() const { return equation_of_; }           // of D node + direction; -1: held
    const std::vector<std::size_t>& freedoms() const { return freedoms_; }         // D node + direction, of an equation
    const std::vector<double>& gravity_forces() const { return gravity_forces_; }  // ∫ ρ g N dV, D × nodes [N]
    double mass() const { return mass_; }                                          // [kg]

    // F_int(u), D × nodes. Returns the smallest det F of all Gauss points: not positive means that an element is inside
    // out.
    double internal_forces(std::span<const double> u, std::span<double> forces, BlockLoop loop);

    // Of the damping of the stiffness, with velocities v; only where the options ask for it.
    void viscous_forces(std::span<const double> u, std::span<const double> v, std::span<double> forces, BlockLoop loop);
    bool is_viscous() const { return !parts_.empty() && parts_.front().viscous != nullptr; }

    // y = M x with the consistent mass, D × nodes, held ones included.
    void multiply_mass(std::span<const double> x, std::span<double> y, BlockLoop loop) const;

    // The pattern of the lower triangle over the equations, by columns (CSC).
    const std::vector<int>& column_starts() const { return column_starts_; }
    const std::vector<int>& rows() const { return rows_; }

    // HRZ-lumped masses of the nodes [kg] (Hinton, Rock & Zienkiewicz, Earthq. Eng. Struct. Dyn. 4, 1976): the diagonal
    // of each element's mass scaled to its mass. (Sums of rows would be negative at the corners of quadratic elements.)
    const std::vector<double>& lumped_masses() const { return lumped_masses_; }

    // What facets add to K (stiff_facets in surface_facets.hpp): packed lower triangles, one after the other, to be
    // written before system_matrix; zero at first.
    std::span<double> facet_matrices() { return std::span(element_matrices_).subspan(first_facet_matrix_); }

    // values = stiffness_factor × K + mass_factor × M in that pattern, K(u) with ∂F_d/∂v × rate_factor of the damping
    // of the stiffness: how velocities change with displacements.
    void system_matrix(std::span<const double> u, double stiffness_factor, double mass_factor, std::span<double> values,
                       BlockLoop loop, double rate_factor = 0);
    // y = K x with the K of the last system_matrix, D × nodes, held ones included.
    void multiply_stiffness(std::span<const double> x, std::span<double> y, BlockLoop loop);
    // The diagonal of K(u) in the last system_matrix, by equation [N/m].
    const std::vector<double>& stiffness_diagonal() const { return stiffness_diagonal_; }

    double energy(std::span<const double> u) const;                             // ∫ W dV [J]
    void von_mises(std::span<const double> u, std::span<double> stress) const;  // one per element [Pa]

  private:
    struct Part {
        std::unique_ptr<ElementGroup<D>> elements;
        std::unique_ptr<ViscousGroup<D>> viscous;                       // null without damping of the stiffness
        std::size_t first_force = 0, first_matrix = 0, first_pack = 0;  // of its packs, in the arrays of all groups
        std::vector<NodeIndex> connectivity;                            // [pack][node][lane]
    };
    struct NodeGraph {  // nodes that share an element, ascending
        std::vector<std::size_t> starts;
        std::vector<int> neighbours;
    };

    // Calls visit(facet, where its packed matrix begins in element_matrices_).
    template <class Visit>
    void for_facets(const Visit& visit) const;

    void make_groups(const Mesh<D>& mesh, const Options<D>& options);
    void number_equations(const Mesh<D>& mesh, const Options<D>& options);
    void list_node_elements(const Mesh<D>& mesh);
    void build_mass(const Mesh<D>& mesh, const Options<D>& options, const NodeGraph& graph);
    void build_pattern(const Mesh<D>& mesh, const NodeGraph& graph);

    void sum_at_nodes(std::span<double> forces, BlockLoop loop) const;  // of element_forces_

    // Calls body(part, first pack, last pack) for blocks of packs of all groups.
    template <class Body>
    void for_packs(std::size_t work_per_block, BlockLoop loop, const Body& body) const;

    std::vector<Part> parts_;
    std::size_t packs_ = 0;
    std::vector<const Material*> material_of_;  // element; only while building
    std::vector<int> equation_of_;
    std::vector<std::size_t> freedoms_;
    std::vector<double> gravity_forces_;
    std::vector<double> lumped_masses_;
    double mass_ = 0;

    Lists node_elements_;                              // of a node: where its x forces lie in element_forces_
    std::vector<double> element_forces_, smallest_J_;  // by pack

    std::vector<std::size_t> mass_starts_;  // rows of M over the nodes
    std::vector<int> mass_columns_;
    std::vector<double> mass_values_;

    std::vector<int> column_starts_, rows_;
    Lists stiffness_entries_;                     // of a nonzero: where its parts lie in element_matrices_
    std::vector<std::uint32_t> mass_of_nonzero_;  // in mass_values_; no_mass where the directions differ
    std::vector<double> element_matrices_;
    std::vector<Facet> facets_;
    std::size_t first_facet_matrix_ = 0;
    std::vector<double> stiffness_diagonal_;
};

}  // namespace aquagraph::solid
