// What is inside solid::Solver; only its own source files see it.
#pragma once
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "physics/solid/assembly.hpp"
#include "physics/solid/cholesky.hpp"
#include "physics/solid/conjugate_gradients.hpp"
#include "physics/solid/newmark.hpp"
#include "physics/solid/solver.hpp"

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
    int steps = 0;                // solved with it
    int iterations_when_new = 0;  // the most in the first of those
    int excess = 0;               // iterations beyond those, in all later steps
};

// A step is tried with the factorisation there is, then with a new one, then also from unchanged displacements.
enum class Attempt { reusing, factorising, from_rest };

template <int D>
struct Solver<D>::Implementation {
    Implementation(Mesh<D> mesh, const Options<D>& options);

    // implicit_step.cpp
    void advance(double dt, std::span<const double> loads, BlockLoop loop);
    void find_initial_accelerations(BlockLoop loop);
    NewtonResult solve_step(double dt, Attempt attempt, BlockLoop loop);
    bool factorise_dynamic(const std::vector<double>& at, double dt, BlockLoop loop);  // false: not positive definite

    // linear_solve.cpp: the system of a time step, by the factor or by conjugate gradients, whichever is cheaper
    bool gradients_are_cheaper(double dt) const;
    bool factorise();  // the matrix in `cholesky`; false: not positive definite
    bool solve_linear(std::span<const double> b, std::span<double> x, BlockLoop loop, double gradient_tolerance);

    // static_equilibrium.cpp
    void solve_static(std::span<const double> loads, BlockLoop loop);
    NewtonResult solve_increment(double load_factor, BlockLoop loop);

    // Over the equations.
    double norm_of_free(std::span<const double> full) const;
    double norm(std::span<const double> equations) const;
    double rounding_floor() const;  // what rounding alone leaves of the residual [N]
    void update_positions();

    const Mesh<D> mesh;
    const Options<D> options;
    const NewmarkCoefficients newmark;
    Assembly<D> assembly;
    Cholesky cholesky;
    ConjugateGradients gradients;

    // D × nodes
    std::vector<double> u, v, a, positions;
    std::vector<double> internal, inertia;            // F_int(u), M a
    std::vector<double> external, previous_external;  // loads and gravity, at the end and at the start of a step
    std::vector<double> previous_internal;
    std::vector<double> old_u, old_v, old_a;          // at the start of the step
    std::vector<double> predicted_u;                  // the part of u_n+1 that does not depend on a_n+1
    std::vector<double> static_start, static_target;  // forces at the ends of a static solve
    // by equation
    std::vector<double> residual, correction;

    bool accelerations_known = false;
    double external_work = 0;
    FactorPolicy factor;
    std::vector<double> factored_at;  // displacements that the matrix of the last step was made for
    bool by_gradients = false;        // the matrix in `cholesky` has not been factorised
    Statistics statistics;
};

}  // namespace aquagraph::solid
