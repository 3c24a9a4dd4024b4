// An elastic body as the coupling and the runs without water drive it, whoever solves it: give it the nodal forces at
// the end of a step, it gives back where the nodes are. One virtual call per step, none inside. solid::Solver is one
// implementation; another one need not be a part of this program (engine/calculix_solver.hpp).
//
// Arrays over nodes are interleaved: x and y (and z) of node 0, those of node 1, …: D × nodes numbers. SI units;
// loads are those on the whole thickness [N].
#pragma once
#include <span>
#include <stdexcept>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/solid/mesh.hpp"

namespace aquagraph::solid {

// The step could not be made. The solver has gone back to the last accepted state.
class SolverError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Newton did not converge, or the stiffness is not positive definite.
class ConvergenceError : public SolverError {
  public:
    using SolverError::SolverError;
};

struct Energies {                  // [J]
    double kinetic = 0;            // 1/2 v·M v
    double strain = 0;             // ∫ W dV, over the reference configuration
    double gravity_potential = 0;  // -F_gravity·u, zero in the reference configuration
    double contact = 0;            // stored in the penalties
    // Since the start or the last solve_static, trapezoidal in time:
    double external_work = 0;  // of the loads without gravity, of what moves nodes as prescribed, of moving ground
    double load_work = 0;      // the part of it that the loads given to advance() have done
    double friction = 0;       // dissipated
    double damping = 0;        // dissipated by Rayleigh's damping
    double numerical = 0;      // dissipated by the scheme
    double stored() const { return kinetic + strain + gravity_potential + contact; }
    // stored() + friction + damping + numerical - external_work is constant, to the third order of a step.
};

struct Statistics {
    long steps = 0;                // calls of advance
    long newton_iterations = 0;    // linear solves, all steps and static solves together
    long factorisations = 0;       // numeric Cholesky factorisations
    long matrices = 0;             // assemblies of a system matrix
    long gradient_iterations = 0;  // of conjugate gradients, all together
    int last_iterations = 0;       // of the last step
    double last_residual = 0;      // |r| / reference at the end of the last step

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(steps, newton_iterations, factorisations, matrices, gradient_iterations, last_iterations, last_residual);
    }
};

// Everything that the next step depends on, to write to a checkpoint.
struct State {
    double time = 0;                                               // [s]
    std::vector<double> displacements, velocities, accelerations;  // D × nodes
    std::vector<double> external_forces, internal_forces, loads;   // at the end of the last step; loads: as given
    std::vector<double> damping_forces;                            // empty without damping
    std::vector<double> rigid_bodies;  // of each: coordinates, velocities, accelerations, rotation matrix by rows
    bool accelerations_known = false;
    double external_work = 0, load_work = 0, numerical_dissipation = 0, damping_dissipation = 0;
    std::vector<double> contacts;  // of each: shift, tractions, positions (ContactHistory), dissipation, ground's work
    Statistics statistics;
    // The factorisation in use (or the matrix, for conjugate gradients), by where it was made and how it has done
    // since: that decides when it is renewed.
    bool factor_valid = false, by_gradients = false;
    double factor_time_step = 0;  // [s]
    int factor_steps = 0, factor_iterations_when_new = 0, factor_excess = 0;
    std::vector<double> factor_displacements, factor_rigid_bodies, factor_contacts;
    double factor_time = 0;   // [s], of the loads
    double stable_step = 0;   // of an explicit scheme, once computed [s] …
    int stable_step_age = 0;  // … how many steps ago, and its mode
    std::vector<double> stiffest_mode;
    std::vector<char> files;  // of a solver that is another program: the file that it continues from

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint
        fields(time, displacements, velocities, accelerations, external_forces, internal_forces, rigid_bodies, contacts,
               accelerations_known, external_work, numerical_dissipation, statistics);
        fields(damping_forces, damping_dissipation, loads, load_work);
        fields(factor_valid, by_gradients, factor_time_step, factor_steps, factor_iterations_when_new, factor_excess,
               factor_displacements, factor_rigid_bodies, factor_contacts, factor_time, stable_step, stable_step_age,
               stiffest_mode, files);
    }
};

template <int D>
class Structure {
  public:
    virtual ~Structure() = default;

    // Static equilibrium under gravity and these loads (D × nodes); velocities and accelerations become zero. Throws
    // SolverError, leaving the body as it was.
    virtual void solve_static(std::span<const double> external_forces, BlockLoop loop) = 0;
    // One step of size dt > 0 [s]; external_forces (D × nodes) act at its end, those of the step before at its start.
    // The first step takes its loads as constant. Throws SolverError, leaving the body as it was.
    virtual void advance(double dt, std::span<const double> external_forces, BlockLoop loop) = 0;
    virtual double largest_stable_step() const = 0;  // [s]
    virtual void set_time(double time) = 0;          // of laws of motions and loads [s]; advance() adds its step

    virtual const Mesh<D>& mesh() const = 0;
    virtual std::span<const double> positions() const = 0;      // X + u [m]
    virtual std::span<const double> displacements() const = 0;  // u [m]
    virtual std::span<const double> velocities() const = 0;     // [m/s]
    virtual Energies energies() const = 0;
    virtual double work_of_loads() const = 0;  // Energies::load_work, without computing the others [J]
    virtual Statistics statistics() const = 0;

    // What save() writes, restore() of a body made from the same mesh and options reads; both go on in the same way.
    virtual void save(State& state) const = 0;
    virtual void restore(const State& state) = 0;

  protected:
    Structure() = default;
    Structure(Structure&&) noexcept = default;
    Structure& operator=(Structure&&) noexcept = default;
};

}  // namespace aquagraph::solid
