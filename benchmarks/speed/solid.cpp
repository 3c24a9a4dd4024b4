// The finite elements: what forces and tangents of each element type cost, and which linear solver is the faster one at
// which size and time step.
#include "benchmarks/speed/solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

#include "benchmarks/speed/block.hpp"
#include "physics/solid/assembly.hpp"
#include "physics/solid/cholesky.hpp"
#include "physics/solid/solver.hpp"
#include "tasks/executor.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::benchmarks {

namespace {

using solid::Mesh, solid::Options;

template <int D>
Options<D> rubber() {
    Options<D> options;
    options.material.law = solid::MaterialLaw::neo_hookean;
    options.material.density = 1100;
    options.material.youngs_modulus = 6e6;
    options.material.poissons_ratio = 0.49;
    options.clamps = {{"left", {}}};
    options.clamps[0].fixed.fill(true);
    options.gravity[D - 1] = -9.81;
    return options;
}

// Median seconds of several calls.
template <class Work>
double seconds_per_call(const Work& work, int calls) {
    std::vector<double> seconds;
    for (int k = 0; k < calls; ++k) seconds.push_back(seconds_of(work));
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

template <int D>
std::string element_row(const char* name, const Mesh<D>& mesh, int points, tasks::Executor& executor) {
    solid::Assembly<D> assembly(mesh, rubber<D>());
    std::vector<double> u(D * mesh.nodes.size()), forces(u.size()), values(assembly.rows().size());
    for (std::size_t k = 0; k < u.size(); ++k) u[k] = 1e-5 * std::sin(0.7 * double(k));
    double serial[2], parallel[2];
    const auto measure = [&](double(&seconds)[2], BlockLoop loop) {
        seconds[0] = seconds_per_call([&] { assembly.internal_forces(u, forces, loop); }, 9);
        seconds[1] = seconds_per_call([&] { assembly.system_matrix(u, 1, 1, values, loop); }, 5);
    };
    measure(serial, serial_loop);
    executor.execute([&] { measure(parallel, tasks::parallel_loop); });
    const double elements = double(mesh.elements.size());
    return fmt::format("| {} | {} | {:.0f} | {:.1f} | {:.0f} | {:.2f} | {:.2f} |\n", name, mesh.elements.size(),
                       serial[0] / elements * 1e9, serial[0] / elements / points * 1e9, serial[1] / elements * 1e9,
                       serial[0] / parallel[0], serial[1] / parallel[1]);
}

template <int D>
std::string solver_rows(const Mesh<D>& mesh, tasks::Executor& executor) {
    std::string rows;
    solid::Assembly<D> assembly(mesh, rubber<D>());
    solid::Cholesky cholesky(assembly.column_starts(), assembly.rows());
    const std::vector<double> loads(D * mesh.nodes.size(), 0.0);
    constexpr int steps = 6;
    for (const double dt : {1e-6, 1e-5, 1e-4, 1e-3}) {
        std::cerr << D << "D, " << assembly.equations() << " unknowns, dt " << dt << "\n";
        std::string cells;
        for (const auto method : {solid::LinearSolver::cholesky, solid::LinearSolver::conjugate_gradients,
                                  solid::LinearSolver::automatic}) {
            Options<D> options = rubber<D>();
            options.linear_solver = method;
            solid::Solver<D> solver(mesh, options);
            double first = 0, later = 0;
            executor.execute([&] {
                first = seconds_of([&] { solver.advance(dt, loads, tasks::parallel_loop); });
                later = seconds_of([&] {
                    for (int k = 1; k < steps; ++k) solver.advance(dt, loads, tasks::parallel_loop);
                });
            });
            const solid::Statistics s = solver.statistics();
            if (method == solid::LinearSolver::automatic)
                cells += fmt::format(" {} |", s.gradient_iterations > 0 ? "gradients" : "factor");
            else
                cells += fmt::format(" {:.3g} | {:.3g} | {:.1f} | {} |", first * 1e3, later / (steps - 1) * 1e3,
                                     double(s.newton_iterations) / steps,
                                     method == solid::LinearSolver::cholesky
                                         ? std::to_string(s.factorisations)
                                         : fmt::format("{:.0f}", double(s.gradient_iterations) / steps));
        }
        rows +=
            fmt::format("| {}D | {} | {:.1e} | {:.0e} |{}\n", D, assembly.equations(), cholesky.nonzeros(), dt, cells);
    }
    return rows;
}

}  // namespace

std::string solid_tables(int threads) {
    tasks::Executor executor(threads);
    std::string text = fmt::format(
        "Neo-Hookean rubber, ν 0.49. What the forces (internal_forces) and the matrix (tangents and their sums, "
        "system_matrix) of an\nelement cost on one core, and how many times faster {} threads are.\n\n"
        "| element | elements | forces, ns per element | per Gauss point | matrix, ns per element | forces × | matrix "
        "× |\n"
        "|---|---|---|---|---|---|---|\n",
        threads);
    const auto plane = solid::box_mesh({0, 0}, {0.2, 0.1}, 160, 80);
    const auto body = solid::box_mesh({0, 0, 0}, {0.1, 0.05, 0.05}, {40, 20, 20});
    const auto coarse = solid::box_mesh({0, 0, 0}, {0.1, 0.05, 0.05}, {20, 10, 10});
    text += element_row("Q4, enhanced", solid::without_mid_side_nodes(plane), 4, executor);
    text += element_row("Q8", plane, 4, executor);
    text += element_row("H8, enhanced", solid::without_mid_side_nodes(body), 8, executor);
    text += element_row("H20", coarse, 8, executor);
    text += fmt::format(
        "\nTime steps of a clamped block under gravity, HHT -0.3, on {} threads: the first step (it factorises the "
        "mass, "
        "for the first\nacceleration, then its own) and the mean of the next five, Newton iterations per step, "
        "factorisations in all or iterations of\nconjugate gradients per step, and which of the two the automatic "
        "choice takes.\n\n"
        "| | unknowns | nonzeros of L | Δt [s] | factor: first [ms] | later [ms] | Newton | factorisations | "
        "gradients: "
        "first [ms] | later [ms] | Newton | iterations | automatic "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        threads);
    text += solver_rows(solid::box_mesh({0, 0}, {0.1, 0.02}, 80, 20), executor);
    text += solver_rows(solid::box_mesh({0, 0}, {0.2, 0.05}, 260, 64), executor);
    text += solver_rows(solid::box_mesh({0, 0, 0}, {0.1, 0.02, 0.02}, {40, 4, 4}), executor);
    text += solver_rows(solid::box_mesh({0, 0, 0}, {0.1, 0.05, 0.05}, {30, 15, 15}), executor);
    text += solver_rows(solid::box_mesh({0, 0, 0}, {0.1, 0.05, 0.05}, {44, 22, 22}), executor);
    return text;
}

}  // namespace aquagraph::benchmarks
