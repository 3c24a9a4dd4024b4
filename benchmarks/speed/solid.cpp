// The finite elements: what forces and tangents of each element type cost, and which linear solver is the faster one at
// which size and time step.
#include "benchmarks/speed/solid.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <vector>

#include "benchmarks/speed/block.hpp"
#include "physics/solid/assembly.hpp"
#include "physics/solid/calculix_export.hpp"
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

// What the tables of the linear solvers say in their columns.
std::string solver_heading(int threads) {
    return fmt::format(
        "Time steps of a clamped block under gravity, HHT -0.3, on {} threads: the first step (it also "
        "solves with the mass,\nfor the first acceleration) and the mean of the next five, Newton iterations per step, "
        "factorisations in all or iterations of\nconjugate gradients per step, and which of the two the automatic "
        "choice takes after the first step.\n\n"
        "| | unknowns | nonzeros of L | Δt [s] | factor: first [ms] | later [ms] | Newton | factorisations | "
        "gradients: "
        "first [ms] | later [ms] | Newton | iterations | automatic "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        threads);
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
            long in_first = 0;  // iterations, among them those for the first acceleration, of the mass alone
            executor.execute([&] {
                first = seconds_of([&] { solver.advance(dt, loads, tasks::parallel_loop); });
                in_first = solver.statistics().gradient_iterations;
                later = seconds_of([&] {
                    for (int k = 1; k < steps; ++k) solver.advance(dt, loads, tasks::parallel_loop);
                });
            });
            const solid::Statistics s = solver.statistics();
            if (method == solid::LinearSolver::automatic)
                cells += fmt::format(" {} |", s.gradient_iterations > in_first ? "gradients" : "factor");
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

// CalculiX on the same mesh: wall time and Newton iterations of a static solve, or nothing where it is not installed.
struct CalculixTime {
    double seconds;
    int iterations;
};
std::optional<CalculixTime> time_calculix(const Mesh<3>& mesh, const Options<3>& options, const solid::CalculixRun& run,
                                          int threads) {
    if (std::system("command -v ccx > /dev/null 2>&1") != 0) return {};
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("aquagraph_speed_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    {
        std::ofstream deck(folder / "body.inp");
        solid::write_calculix(deck, mesh, options, run);
    }
    const std::string command =
        fmt::format("cd '{}' && OMP_NUM_THREADS={} ccx -i body > body.log 2>&1", folder.string(), threads);
    int status = 0;
    CalculixTime time{seconds_of([&] { status = std::system(command.c_str()); }), 0};
    std::ifstream log(folder / "body.log");
    for (std::string line; std::getline(log, line);)
        if (line.starts_with(" iteration ")) ++time.iterations;
    std::filesystem::remove_all(folder);
    if (status != 0 || time.iterations == 0) throw std::runtime_error("ccx has failed on the benchmark's deck");
    return time;
}

// A cantilever of rubber bent by a quarter of its length.
std::string calculix_rows(std::array<int, 3> elements, int threads) {
    const Mesh<3> mesh = solid::box_mesh({0, 0, 0}, {0.1, 0.02, 0.02}, elements);
    Options<3> options = rubber<3>();
    options.material.poissons_ratio = 0.45;
    options.gravity = {};
    solid::CalculixRun run;
    run.is_static = true;
    run.step = 0.25;
    run.end = 1;
    run.print_every = 4;
    run.printed = {mesh.node_set("right").back()};
    run.loads = {{solid::traction_forces(mesh, "right", {0, 0, 2e3}), {}}};
    std::string rows;
    for (const int used : {1, threads}) {
        std::cerr << "beside CalculiX, " << mesh.elements.size() << " elements, " << used << " threads\n";
        tasks::Executor executor(used);
        std::vector<double> ours, theirs;
        for (int round = 0; round < 3; ++round) {
            executor.execute([&] {
                solid::Solver<3> solver(mesh, options);
                const double seconds =
                    seconds_of([&] { solver.solve_static(run.loads[0].forces, tasks::parallel_loop); });
                ours.push_back(seconds / double(solver.statistics().newton_iterations));
            });
            if (const auto time = time_calculix(mesh, options, run, used))
                theirs.push_back(time->seconds / time->iterations);
        }
        std::sort(ours.begin(), ours.end());
        std::sort(theirs.begin(), theirs.end());
        rows += fmt::format("| {} | {} | {} | {:.1f} | {} | {} |\n", mesh.elements.size(), 3 * mesh.nodes.size(), used,
                            ours[1] * 1e3, theirs.empty() ? "not installed" : fmt::format("{:.1f}", theirs[1] * 1e3),
                            theirs.empty() ? "" : fmt::format("{:.1f}", theirs[1] / ours[1]));
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
    text += '\n';
    text += solver_heading(threads);
    text += solver_rows(solid::box_mesh({0, 0}, {0.1, 0.02}, 80, 20), executor);
    text += solver_rows(solid::box_mesh({0, 0}, {0.2, 0.05}, 260, 64), executor);
    text += solver_rows(solid::box_mesh({0, 0, 0}, {0.1, 0.02, 0.02}, {40, 4, 4}), executor);
    text += solver_rows(solid::box_mesh({0, 0, 0}, {0.1, 0.05, 0.05}, {30, 15, 15}), executor);
    text +=
        "\nA Newton iteration (forces, matrix, factorisation, solution) of a static cantilever of neo-Hookean rubber "
        "in H20 with 2 × 2 × 2 points,\nbeside CalculiX's (C3D20R, its default solver; its whole run over its "
        "iterations, reading the deck included). Medians of three, in turn.\n\n"
        "| elements | unknowns | threads | ms per iteration | CalculiX [ms] | ratio |\n|---|---|---|---|---|---|\n";
    text += calculix_rows({20, 4, 4}, threads);
    text += calculix_rows({30, 6, 6}, threads);
    return text;
}

std::string large_solid_table(int threads) {
    tasks::Executor executor(threads);
    return solver_heading(threads) + solver_rows(solid::box_mesh({0, 0, 0}, {0.1, 0.05, 0.05}, {44, 22, 22}), executor);
}

}  // namespace aquagraph::benchmarks
