// What is inside solid::Solver; only its own source files see it.
#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "physics/solid/assembly.hpp"
#include "physics/solid/border.hpp"
#include "physics/solid/cholesky.hpp"
#include "physics/solid/conjugate_gradients.hpp"
#include "physics/solid/constraints.hpp"
#include "physics/solid/contact.hpp"
#include "physics/solid/newmark.hpp"
#include "physics/solid/rigid_bodies.hpp"
#include "physics/solid/solver.hpp"
#include "physics/solid/surface_loads.hpp"

namespace aquagraph::solid {

// How a Newton solve went.
struct NewtonResult {
    enum class Outcome { converged, too_many_iterations, inside_out, not_finite, not_positive_definite };
    Outcome outcome = Outcome::converged;
    int iterations = 0;
    int iterations_before_factor = 0;              // those made before the factorisation that was used at the end
    double first_residual = 0, last_residual = 0;  // [N]
    double reference = 0;                          // force that they are compared with [N]

    bool converged() const { return outcome == Outcome::converged; }
    std::string description() const;  // the reason of a failure and the residuals
};

// When the factorisation of B = M + w β Δt² K, once made, is no longer worth keeping.
struct FactorPolicy {
    bool valid = false;
    double time_step = 0;         // Δt that it was made for
    int steps = 0;                // of about this size solved with it, the first few
    int iterations_when_new = 0;  // the most in those
    int excess = 0;               // iterations beyond those, in all other steps
};

// What has been done to the body and what was lost, since the start or the last static solve [J].
struct Account {
    double external_work = 0;  // loads without gravity, and whoever moves what is prescribed
    double load_work = 0;      // of the loads given to advance() alone
    double numerical = 0;      // work of all forces that did not become kinetic energy
    double damping = 0;        // work against Rayleigh's damping
    // At the start of the step under way:
    double kinetic = 0;
    std::vector<double> reactions;       // of the freedoms of prescribed motions
    std::vector<double> body_reactions;  // of the prescribed coordinates of rigid bodies
};

// A step is tried with the factorisation there is, then with a new one, then with new ones wherever the residual falls
// slowly, then also from unchanged displacements.
enum class Attempt { reusing, factorising, renewing, from_rest };

// Squares of Euclidean norms over the unknowns, and, of forces, over the freedoms that are moved.
struct Magnitudes {
    double residual = 0, external = 0, internal = 0, inertia = 0;  // [N²]
    double step = 0;                                               // u - u at the start of the step [m²]

    double reference() const { return std::sqrt(std::max({external, internal, inertia})); }
};

// The unknowns are the free degrees of freedom of the nodes, by equation, and after them those of the rigid bodies.
template <int D>
struct Solver<D>::Implementation {
    Implementation(Mesh<D> mesh, const Options<D>& options);

    // equation_of_motion.cpp
    // At u and `time`, and at v where the body moves; returns the smallest det F.
    enum class Motion { moving, at_rest };
    double evaluate_forces(BlockLoop loop, Motion motion = Motion::moving);
    bool is_damped() const { return options.mass_damping > 0 || options.stiffness_damping > 0; }
    void add_contact_forces(BlockLoop loop);      // to the internal forces
    void add_damping(BlockLoop loop);             // likewise
    void gather_body_forces();                    // from those of the nodes
    Magnitudes dynamic_residual(BlockLoop loop);  // of forces that are evaluated
    Magnitudes static_residual();

    // linear_solve.cpp: the system B = m M + k K at `linearised`, bordered by the rigid bodies; by a factor of B or by
    // conjugate gradients, whichever is cheaper
    void linearise_here();
    void keep_histories(std::vector<ContactHistory<D>>& histories) const;  // of the contacts
    void linearise_at_start();                                             // of the step
    // K with the damping of the stiffness, times rate_factor. False: not positive definite.
    bool prepare_system(double mass_factor, double stiffness_factor, BlockLoop loop, double rate_factor = 0);
    void add_surface_tangents(BlockLoop loop);
    void assemble_border(double mass_factor, double stiffness_factor, BlockLoop loop);
    bool gradients_are_cheaper(double stiffness_factor) const;
    bool factorise();                                              // B; false: not positive definite
    bool solve_system(double gradient_tolerance, BlockLoop loop);  // residual -> correction
    bool solve_linear(std::span<const double> b, std::span<double> x, BlockLoop loop, double gradient_tolerance);  // B

    // step.cpp: what all schemes do
    void advance(double dt, std::span<const double> loads, BlockLoop loop);
    void begin_step(double dt, std::span<const double> loads, BlockLoop loop);
    void abandon_step();
    void accept_step(BlockLoop loop);
    void keep_forces();
    void find_initial_accelerations(double dt, BlockLoop loop);
    void multiply_mass(std::span<const double> x, std::span<double> y, BlockLoop loop) const;  // of the scheme

    // explicit_step.cpp
    bool is_explicit() const { return options.scheme == Scheme::central_difference; }
    NewtonResult step_explicitly(double dt, BlockLoop loop);
    bool solve_lumped(BlockLoop loop);  // residual -> correction; false: a body without inertia
    double largest_stable_step();
    double find_stable_step(bool again);

    // implicit_step.cpp
    NewtonResult step_implicitly(double dt, BlockLoop loop);
    NewtonResult solve_step(double dt, Attempt attempt, BlockLoop loop);
    // Where Newton starts: with the accelerations of the step before, or with its displacements.
    enum class Guess { same_accelerations, same_displacements };
    void guess(Guess guess, double dt);
    double first_iterate(double dt, Attempt attempt, BlockLoop loop);  // the better guess; its smallest det F
    double norm_of_forces() const;                      // of those that the step begins with, and of its loads [N]
    bool factorise_dynamic(double dt, BlockLoop loop);  // false: not positive definite
    void correct_accelerations(double to_displacement, double dt);
    void update_velocities(double dt);  // from the accelerations

    // static_equilibrium.cpp
    void solve_static(std::span<const double> loads, BlockLoop loop);
    NewtonResult solve_increment(double part, bool predict, BlockLoop loop);
    bool move_held(bool predict, BlockLoop loop);
    bool correct_displacements(BlockLoop loop);  // false: not positive definite
    double size_of_displacements() const;

    // energy_account.cpp
    void open_account(BlockLoop loop);   // at the start of a step
    void close_account(BlockLoop loop);  // at its end
    double kinetic_energy(BlockLoop loop);

    void take_loads(
        std::span<const double> given);       // those there were become the previous ones; throws std::invalid_argument
    void restore_factor(const State& state);  // solver_state.cpp
    double norm(std::span<const double> unknowns) const;
    double rounding_floor() const;  // what rounding alone leaves of the residual [N]
    void update_positions();

    const Mesh<D> mesh;
    const Options<D> options;
    const NewmarkCoefficients newmark;
    Assembly<D> assembly;
    PrescribedMotions<D> motions;
    RigidBodies<D> bodies;
    SurfaceLoads<D> surface_loads;
    std::vector<GroundContact<D>> contacts;
    Cholesky cholesky;
    ConjugateGradients gradients;
    Border border;
    Border lumped_border;  // of the explicit scheme: bodies alone

    double time = 0, old_time = 0;
    double load_factor = 1;  // of the loads on surfaces: less than 1 on the way of a static solve
    // D × nodes
    std::vector<double> u, v, a, positions;
    std::vector<double> loads, previous_loads;        // given for the end of the step, and of the one before
    std::vector<double> internal, inertia;            // F_int(u), M a
    std::vector<double> external, previous_external;  // loads and gravity, at the end and at the start of a step
    std::vector<double> previous_internal;
    std::vector<double> contact_forces;             // the part of F_int at u that is the ground's; empty without
    double contact_size2 = 0;                       // |that|² [N²]
    std::vector<double> damping, previous_damping;  // the part of those that damps; empty without
    std::vector<double> old_u, old_v, old_a;        // at the start of the step
    std::vector<double> predicted_u;                // the part of u_n+1 that does not depend on a_n+1
    std::vector<double> static_start,
        static_start_u;                          // forces that hold, and displacements, where a static solve began
    std::vector<double> momentum;                // M v
    std::vector<double> column, column_product;  // of a rigid body's unknown; empty without bodies
    // by unknown
    std::vector<double> residual, correction;

    // Over the coordinates of the rigid bodies: generalised forces as those of the nodes above.
    using BodyMotions = std::vector<typename RigidBodies<D>::Motion>;
    BodyMotions old_bodies, static_start_bodies;
    std::vector<ContactHistory<D>> static_start_contacts;
    std::vector<double> body_external, body_internal, body_inertia, body_previous_external, body_previous_internal;
    std::vector<double> body_loads, body_previous_loads;
    std::vector<double> body_static_start;

    struct Linearisation {  // where a tangent is taken
        std::vector<double> u;
        BodyMotions bodies;
        double time = 0;
        std::vector<std::array<double, D>> ground_shifts;
        std::vector<ContactHistory<D>> contacts;
        bool operator==(const Linearisation&) const = default;
    };
    Linearisation linearised;
    double stable_step = 0;             // of an explicit scheme, once computed [s] …
    int stable_step_age = 0;            // … so many steps ago
    std::vector<double> stiffest_mode;  // its mode, from which it is renewed

    bool accelerations_known = false;
    Account account;
    FactorPolicy factor;
    bool by_gradients = false;  // the matrix in `cholesky` has not been factorised
    Statistics statistics;
};

}  // namespace aquagraph::solid
