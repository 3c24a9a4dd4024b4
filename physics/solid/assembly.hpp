// From elements to the body: which degrees of freedom are free, sums of element forces at the nodes, the consistent
// mass matrix, the sparse system matrix. Every sum runs over a precomputed list in a fixed order, so that blocks may be
// done by any number of threads and the bits stay the same. Nothing here allocates once constructed.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/solid/element_group.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/solver.hpp"

namespace aquagraph::solid {

// Rows of contributions: those to row r are entries[starts[r]] … entries[starts[r + 1] - 1].
struct Lists {
    std::vector<std::size_t> starts, entries;
};

class Assembly {
  public:
    // Throws std::invalid_argument for an unknown set or a law that there is not.
    Assembly(const Mesh& mesh, const Options& options);

    std::size_t nodes() const { return node_elements_.starts.size() - 1; }
    std::size_t equations() const { return freedoms_.size(); }
    const std::vector<int>& equation_of() const { return equation_of_; }           // of 2 node + direction; -1: clamped
    const std::vector<std::size_t>& freedoms() const { return freedoms_; }         // 2 node + direction, of an equation
    const std::vector<double>& gravity_forces() const { return gravity_forces_; }  // ∫ ρ g N dV, 2 × nodes [N]
    double mass() const { return mass_; }                                          // [kg]
    const ElementGroup& elements() const { return *elements_; }

    // F_int(u), 2 × nodes. Returns the smallest det F of all Gauss points: not positive means that an element is inside
    // out.
    double internal_forces(std::span<const double> u, std::span<double> forces, BlockLoop loop);

    // y = M x with the consistent mass, 2 × nodes, clamped ones included.
    void multiply_mass(std::span<const double> x, std::span<double> y, BlockLoop loop) const;

    // The pattern of the lower triangle over the equations, by columns (CSC).
    const std::vector<int>& column_starts() const { return column_starts_; }
    const std::vector<int>& rows() const { return rows_; }

    // values = stiffness_factor × K(u) + mass_factor × M in that pattern.
    void system_matrix(std::span<const double> u, double stiffness_factor, double mass_factor, std::span<double> values,
                       BlockLoop loop);
    // The diagonal of K(u) in the last system_matrix, by equation [N/m].
    const std::vector<double>& stiffness_diagonal() const { return stiffness_diagonal_; }

  private:
    void number_equations(const Mesh& mesh, const std::vector<Clamp>& clamps);
    void list_node_elements(const Mesh& mesh);
    void build_mass(const Mesh& mesh, const Options& options);
    void build_pattern(const Mesh& mesh);

    std::unique_ptr<ElementGroup> elements_;
    std::vector<int> equation_of_;
    std::vector<std::size_t> freedoms_;
    std::vector<double> gravity_forces_;
    double mass_ = 0;

    Lists node_elements_;                              // of a node: where its x forces lie in element_forces_
    std::vector<double> element_forces_, smallest_J_;  // by pack
    std::vector<std::array<double, quad8::node_count * quad8::node_count>> element_mass_;  // [8 a + b], one direction

    Lists mass_columns_;  // rows of M over the nodes
    std::vector<double> mass_values_;

    std::vector<int> column_starts_, rows_;
    Lists stiffness_entries_;          // of a nonzero: where its parts lie in element_matrices_
    std::vector<double> system_mass_;  // M in the pattern
    std::vector<double> element_matrices_;
    std::vector<double> stiffness_diagonal_;
};

}  // namespace aquagraph::solid
