// Factor or conjugate gradients, for the system B = M + w β Δt² K of a time step.
#include <algorithm>
#include <cmath>

#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

namespace {

// Nanoseconds, measured (benchmarks/RESULTS.md, section solid): only their proportions matter.
constexpr double per_nonzero_of_factor = 0.9;      // of a solve
constexpr double per_operation_by_columns = 0.15;  // of a factorisation
constexpr double per_operation_by_blocks = 0.03;
constexpr double blocks_pay_above = 40;      // operations per nonzero: where CHOLMOD goes over to supernodes
constexpr double per_nonzero_of_matrix = 2;  // of a product: both triangles
constexpr double solves_per_factor = 40;     // while steps change little
constexpr double iterations_of_mass = 20;    // of conjugate gradients on M alone, for quadratic elements

constexpr int most_gradient_iterations = 500;

}  // namespace

// B = M (1 + r), r = w β Δt² K/M: the number of iterations grows with √(1 + r), its largest entry on the diagonal
// standing for r.
template <int D>
bool Solver<D>::Implementation::gradients_are_cheaper(double dt) const {
    if (options.linear_solver != LinearSolver::automatic)
        return options.linear_solver == LinearSolver::conjugate_gradients;
    double ratio = 0;
    const auto values = cholesky.values();
    const double weight = newmark.weight_new * newmark.beta * dt * dt;
    for (std::size_t e = 0; e < assembly.equations(); ++e) {
        const double stiffness = weight * assembly.stiffness_diagonal()[e];
        ratio = std::max(ratio, stiffness / (values[std::size_t(assembly.column_starts()[e])] - stiffness));
    }
    const double gradients_cost =
        iterations_of_mass * std::sqrt(1 + ratio) * per_nonzero_of_matrix * double(assembly.rows().size());
    const double operations = cholesky.factorisation_operations(), nonzeros = cholesky.nonzeros();
    const double per_operation =
        operations > blocks_pay_above * nonzeros ? per_operation_by_blocks : per_operation_by_columns;
    return gradients_cost < per_nonzero_of_factor * nonzeros + per_operation * operations / solves_per_factor;
}

template <int D>
bool Solver<D>::Implementation::factorise() {
    ++statistics.factorisations;
    return cholesky.factorise();
}

template <int D>
bool Solver<D>::Implementation::solve_linear(std::span<const double> b, std::span<double> x, BlockLoop loop,
                                             double gradient_tolerance) {
    if (by_gradients) {
        const int iterations =
            gradients.solve(cholesky.values(), b, x, gradient_tolerance, most_gradient_iterations, loop);
        if (iterations >= 0) {
            statistics.gradient_iterations += iterations;
            return true;
        }
        by_gradients = false;  // the same matrix, then by its factor
        if (!factorise()) return factor.valid = false;
    }
    cholesky.solve(b, x);
    return true;
}

template struct Solver<2>::Implementation;
template struct Solver<3>::Implementation;

}  // namespace aquagraph::solid
