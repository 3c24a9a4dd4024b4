// The elastic body as the coupling drives it: total Lagrangian finite elements with large displacements, implicit or
// explicit in time. Give it the nodal forces at the end of a step, it gives back where the nodes are.
//
// Equation of motion at t_n+1 (C. Hermange, thesis, Centrale Nantes 2017, (3.37), (3.44); Hilber, Hughes & Taylor
// 1977):
//   M a_n+1 + (1 + α) F_int(u_n+1) - α F_int(u_n) = (1 + α) F_ext_n+1 - α F_ext_n          F_ext: loads and gravity
// with Newmark's update (3.38)-(3.39), γ = 1/2 - α and β = (1 - α)²/4 (3.45)-(3.46). "Newmark" has the same γ and β
// and no weighting of forces: M a_n+1 + F_int(u_n+1) = F_ext_n+1. Central differences: see explicit_step.cpp. F_ext
// also has surface loads, F_int the forces of contact.
//
// Arrays over nodes are interleaved: x and y (and z) of node 0, those of node 1, …: D × nodes numbers. SI units;
// loads are those on the whole thickness [N].
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/solid/contact_report.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/options.hpp"
#include "physics/solid/structure.hpp"

namespace aquagraph::solid {

// A natural vibration about the present state.
struct NaturalMode {
    double eigenvalue = 0;                  // ω² [1/s²]; negative where the state is unstable
    double frequency = 0;                   // ω/2π [Hz]; negative: of √-ω², growing instead of swinging
    std::vector<double> shape;              // D × nodes, largest component 1
    double mass = 0;                        // φᵀM φ with this shape [kg]
    std::array<double, 3> mass_fraction{};  // of the whole mass that moves along x, y (and z): effective modal mass
};

// Where a rigid body is and what is done to it. Rotations as in RigidBody::motion.
template <int D>
struct RigidBodyState {
    std::array<double, rigid_freedoms<D>> displacement{}, velocity{}, acceleration{};  // [m], [rad] and their rates
    std::array<double, rigid_freedoms<D>> reaction{};  // of what is prescribed, acting on the body [N], [N m]
};

template <int D>
class Solver final : public Structure<D> {
  public:
    // Throws std::invalid_argument for an option out of range, a clamp of an unknown set (naming those that exist), a
    // neo-Hookean law in plane stress, and MeshError for a mesh that check() refuses.
    Solver(Mesh<D> mesh, const Options<D>& options);
    ~Solver() override;
    Solver(Solver&&) noexcept;
    Solver& operator=(Solver&&) noexcept;

    // Static equilibrium under gravity and these loads (D × nodes), reached from the present displacements by load
    // increments that are halved where Newton fails. Velocities and accelerations become zero, external_work restarts
    // at zero. Throws ConvergenceError, leaving the solver as it was.
    void solve_static(std::span<const double> external_forces, BlockLoop loop) override;

    // One step of size dt > 0 [s]; external_forces (D × nodes) act at its end. Those at its start are the ones of the
    // step before; the first step takes its loads as constant, and its initial acceleration from M a = F_ext - F_int.
    // Throws ConvergenceError, leaving the solver as it was, and std::invalid_argument for sizes or dt out of range.
    // Bitwise the same for any loop. Allocates nothing, unless it factorises.
    void advance(double dt, std::span<const double> external_forces, BlockLoop loop) override;

    // The lowest natural frequencies, ascending, and shapes about the present displacements, with the stiffness of
    // large displacements there: prestress counts. What is prescribed and the nodes of rigid bodies stay where they
    // are; contacts that are closed stay closed. Throws std::invalid_argument unless 1 <= count < free degrees of
    // freedom, ConvergenceError if the search fails.
    std::vector<NaturalMode> natural_modes(int count, BlockLoop loop);

    // Throws the whole body: every free node, and every rigid body that is free to move so, gets this velocity [m/s].
    void set_velocity(const std::array<double, D>& velocity);

    // Time of the laws of motions and loads [s]; 0 at first, advance() adds its step. A static solve takes them as they
    // are at this time.
    double time() const;
    void set_time(double time) override;

    const Mesh<D>& mesh() const override;
    const Options<D>& options() const;
    std::span<const double> positions() const override;      // X + u [m]
    std::span<const double> displacements() const override;  // u [m]
    std::span<const double> velocities() const override;     // [m/s]
    std::span<const double> accelerations() const;           // [m/s²]

    // Sum of the forces that hold the nodes of a set, where they are clamped or moved as prescribed [N]: M a + F_int -
    // F_ext at the present state. Throws std::invalid_argument for an unknown set.
    std::array<double, D> reaction(const std::string& set) const;
    RigidBodyState<D> rigid_body(std::size_t body) const;  // in the order of the options

    ContactReport<D> contact(std::size_t contact) const;  // in the order of the options
    // The pressure of all contacts at the nodes, a mean of the Gauss points around [Pa]; zero away from them. nodal:
    // one per node.
    void contact_pressure(std::span<double> nodal) const;

    double work_of_loads() const override;
    Energies energies() const override;  // computed when asked for
    Statistics statistics() const override;
    double mass() const;  // [kg]
    // Infinite for the implicit schemes, which are unconditionally stable. Explicit: 0.9 × 2/ω_max about the state
    // where it was first asked for, or a static solve's end, and renewed when asked for a hundred steps later, where it
    // has come to differ by more than 2 % [s].
    double largest_stable_step() const override;

    // Von Mises equivalent of the Cauchy stress, mean of an element's Gauss points [Pa]. von_mises: one per element.
    void element_stress(std::span<double> von_mises) const;

    // What save() writes, restore() of a solver built from the same mesh and options reads; both continue with the same
    // bits, and so does a solver that is never saved: restore() makes the saved factorisation again, where it was made,
    // unless it is the one in use.
    void save(State& state) const override;
    void restore(const State& state) override;  // throws std::invalid_argument for sizes that do not fit

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace aquagraph::solid
