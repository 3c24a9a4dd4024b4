// The linear systems of Newton's method: B = m M + k K over the equations, by a factor or by conjugate gradients,
// bordered by the unknowns of rigid bodies.
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
constexpr double to_rounding = 1e-14;  // a system that Newton does not come back to

}  // namespace

template <int D>
void Solver<D>::Implementation::keep_histories(std::vector<ContactHistory<D>>& histories) const {
    histories.resize(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) histories[k] = contacts[k].history();
}

template <int D>
void Solver<D>::Implementation::linearise_here() {
    linearised.u = u;
    linearised.bodies = bodies.motions();
    linearised.time = time;
    linearised.ground_shifts.resize(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) linearised.ground_shifts[k] = contacts[k].shift();
    keep_histories(linearised.contacts);
}

template <int D>
void Solver<D>::Implementation::linearise_at_start() {
    linearised.u = old_u;
    linearised.bodies = old_bodies;
    linearised.time = old_time;
    linearised.ground_shifts.resize(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) linearised.ground_shifts[k] = contacts[k].history().shift;
    keep_histories(linearised.contacts);
}

template <int D>
void Solver<D>::Implementation::add_surface_tangents(BlockLoop loop) {
    std::span<double> matrices = assembly.facet_matrices();
    surface_loads.tangents(linearised.time, load_factor, linearised.u, matrices, loop);
    matrices = matrices.subspan(surface_loads.matrix_size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        contacts[k].tangents(linearised.ground_shifts[k], linearised.u, linearised.contacts[k], matrices, loop);
        matrices = matrices.subspan(contacts[k].matrix_size());
    }
}

// C = B T and E = Tᵀ B T, with the own masses of the bodies. The change of T with the rotation is left out: it costs an
// iteration, and the matrix stays symmetric.
template <int D>
void Solver<D>::Implementation::assemble_border(double mass_factor, double stiffness_factor, BlockLoop loop) {
    for (std::size_t n = 0; n < bodies.unknowns().size(); ++n) {
        std::fill(column.begin(), column.end(), 0.0);
        bodies.column(n, linearised.bodies, column);
        assembly.multiply_stiffness(column, column_product, loop);
        assembly.multiply_mass(column, momentum, loop);
        for (std::size_t f = 0; f < column.size(); ++f)
            column_product[f] = mass_factor * momentum[f] + stiffness_factor * column_product[f];
        for (std::size_t e = 0; e < assembly.equations(); ++e)
            border.column(n)[e] = column_product[assembly.freedoms()[e]];
        for (std::size_t m = 0; m < bodies.unknowns().size(); ++m) {
            std::fill(column.begin(), column.end(), 0.0);
            bodies.column(m, linearised.bodies, column);
            double& entry = border.corner(m, n);
            entry = mass_factor * bodies.own_mass(m, n, linearised.bodies);
            for (std::size_t f = 0; f < column.size(); ++f) entry += column[f] * column_product[f];
        }
    }
}

template <int D>
bool Solver<D>::Implementation::prepare_system(double mass_factor, double stiffness_factor, BlockLoop loop,
                                               double rate_factor) {
    add_surface_tangents(loop);
    assembly.system_matrix(linearised.u, stiffness_factor, mass_factor, cholesky.values(), loop, rate_factor);
    ++statistics.matrices;
    assemble_border(mass_factor, stiffness_factor, loop);
    by_gradients = mass_factor != 0 && gradients_are_cheaper(stiffness_factor);
    if (!by_gradients && !factorise()) return false;
    return border.condense(
        [&](std::span<const double> b, std::span<double> x) { return solve_linear(b, x, loop, to_rounding); });
}

template <int D>
bool Solver<D>::Implementation::solve_system(double gradient_tolerance, BlockLoop loop) {
    return border.solve(residual, correction, [&](std::span<const double> b, std::span<double> x) {
        return solve_linear(b, x, loop, gradient_tolerance);
    });
}

// B = M (1 + r), r = w β Δt² K/M: the number of iterations grows with √(1 + r), its largest entry on the diagonal
// standing for r.
template <int D>
bool Solver<D>::Implementation::gradients_are_cheaper(double weight) const {
    if (options.linear_solver != LinearSolver::automatic)
        return options.linear_solver == LinearSolver::conjugate_gradients;
    double ratio = 0;
    const auto values = cholesky.values();
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
