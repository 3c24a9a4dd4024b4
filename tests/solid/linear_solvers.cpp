// Factor by columns, factor by blocks, conjugate gradients: one system, one solution; and the same motion by each.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "physics/solid/conjugate_gradients.hpp"
#include "tests/solid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::solid;
using namespace aquagraph::solid::test;

namespace {

Options<3> rubber() {
    Options<3> options;
    options.material = material(MaterialLaw::neo_hookean, 1100, 6e6, 0.45);
    options.clamps = {{"left", {true, true, true}}};
    options.gravity = {0, 0, -9.81};
    return options;
}
Mesh<3> block() {
    return box_mesh({0, 0, 0}, {0.1, 0.03, 0.03}, {14, 5, 5});  // large enough to be factorised by blocks
}

}  // namespace

TEST_CASE("the factor by blocks and conjugate gradients solve the same system") {
    Assembly<3> assembly(block(), rubber());
    Cholesky cholesky(assembly.column_starts(), assembly.rows());
    REQUIRE(cholesky.factorisation_operations() > 40 * cholesky.nonzeros());
    const std::vector<double> u(3 * assembly.nodes(), 0.0);
    assembly.system_matrix(u, 0.25e-10, 1, cholesky.values(), serial_loop);
    const std::size_t n = assembly.equations();
    std::vector<double> b(n), x(n), y(n), product(n);
    for (std::size_t k = 0; k < n; ++k) b[k] = std::sin(0.37 * double(k));
    REQUIRE(cholesky.factorise());
    cholesky.solve(b, x);
    ConjugateGradients gradients(assembly.column_starts(), assembly.rows());
    const int iterations = gradients.solve(cholesky.values(), b, y, 1e-12, 1000, serial_loop);
    CHECK(iterations > 5);
    CHECK(iterations < 200);
    double largest = 0, difference = 0, residual = 0;
    gradients.multiply(cholesky.values(), x, product, serial_loop);
    for (std::size_t k = 0; k < n; ++k) {
        largest = std::max(largest, std::abs(x[k]));
        difference = std::max(difference, std::abs(x[k] - y[k]));
        residual = std::max(residual, std::abs(product[k] - b[k]));
    }
    CHECK(difference < 1e-9 * largest);
    CHECK(residual < 1e-11);
    std::vector<double> threaded(n);
    gradients.solve(cholesky.values(), b, threaded, 1e-12, 1000, ThreadedLoop{});
    CHECK(threaded == y);
    CHECK(gradients.solve(cholesky.values(), b, y, 1e-12, 3, serial_loop) == -1);  // too few
    CHECK(gradients.solve(cholesky.values(), std::vector<double>(n, 0.0), y, 1e-12, 3, serial_loop) == 0);
}

TEST_CASE("the same motion by each linear solver") {
    const Mesh<3> mesh = block();
    const std::vector<double> loads(3 * mesh.nodes.size(), 0.0);
    const auto fall = [&](LinearSolver method, double dt) {
        Options<3> options = rubber();
        options.linear_solver = method;
        Solver<3> solver(mesh, options);
        for (int k = 0; k < 5; ++k) solver.advance(dt, loads, serial_loop);
        return solver;
    };
    for (const double dt : {2e-6, 1e-4}) {
        const Solver<3> factored = fall(LinearSolver::cholesky, dt);
        const Solver<3> iterated = fall(LinearSolver::conjugate_gradients, dt);
        CHECK(factored.statistics().gradient_iterations == 0);
        CHECK(factored.statistics().factorisations >= 2);
        CHECK(iterated.statistics().gradient_iterations > 0);
        CHECK(iterated.statistics().factorisations == 0);
        double largest = 0, difference = 0;
        for (std::size_t k = 0; k < loads.size(); ++k) {
            largest = std::max(largest, std::abs(factored.displacements()[k]));
            difference = std::max(difference, std::abs(factored.displacements()[k] - iterated.displacements()[k]));
        }
        CHECK(difference < 1e-6 * largest);
    }
}

TEST_CASE("a system that conjugate gradients cannot solve in reasonable time is factorised") {
    Options<2> options;
    options.material = material(MaterialLaw::linear, 1, 1e6, 0.3);
    options.clamps = {{"left", {true, true}}};
    options.linear_solver = LinearSolver::conjugate_gradients;
    const Mesh<2> mesh = box_mesh({0, 0}, {1, 0.05}, 100, 4);
    Solver<2> solver(mesh, options);
    solver.advance(1e-3, traction(mesh, "right", {0, 1e-3}), serial_loop);
    CHECK(solver.statistics().factorisations >= 1);
    CHECK(solver.statistics().steps == 1);
}
