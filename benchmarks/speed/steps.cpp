// Whole steps: evaluations of fluid particles per second with everything included, beside what open codes reach on a
// comparable block at the same support; where the time goes; and whether a million particles cost more each.
#include "benchmarks/speed/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "benchmarks/speed/block.hpp"
#include "tasks/executor.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::benchmarks {

namespace {

struct Measured {
    double
        seconds_per_step;  // of a round the mean, as steps with and without a rebuild differ; of the rounds the median
    std::size_t particles;
    Times parts;  // seconds of all steps
    int steps;
    double lanes_before, lanes_after, bytes;
    long rebuilds;
};

constexpr int rounds = 3;

template <int D>
Measured measure(std::size_t n, double ratio, double mach, int steps, const fluid::FluxParameters& flux,
                 tasks::Executor& executor) {
    WaterBlock<D> block(n, ratio, mach, flux);
    Times parts;
    std::array<double, rounds> seconds{};
    long rebuilds = 0;
    executor.execute([&] {
        for (int k = 0; k < 3; ++k) block.step(tasks::parallel_loop, parts);  // warm, pruned
        parts.clear();
        rebuilds = block.fluid.rebuilds;
        for (double& round : seconds)
            for (int k = 0; k < steps; ++k) round += seconds_of([&] { block.step(tasks::parallel_loop, parts); });
    });
    if (!block.finite()) throw std::runtime_error("a block of water has blown up: its speed means nothing");
    std::sort(seconds.begin(), seconds.end());
    return {seconds[rounds / 2] / steps,
            block.fluid.particles.count,
            parts,
            rounds * steps,
            block.lanes_per_pair(false),
            block.lanes_per_pair(true),
            bytes_per_particle(block.fluid),
            block.fluid.rebuilds - rebuilds};
}

// Fluid particles advanced per second and evaluation on two threads of the same machine at R = 2.6 Δx (20 neighbours in
// 2D, 80 in 3D), everything included. None of them reconstructs states at the interface of a pair.
struct OpenCodes {
    double lammps, sphinxsys, dualsphysics;  // millions per second
};
constexpr OpenCodes open_codes[2] = {{9.6, 4.40, 3.46}, {1.81, 0.66, 0.87}};

struct NamedScheme {
    const char* name;
    fluid::FluxParameters flux;
};
std::vector<NamedScheme> schemes() {
    using fluid::RiemannSolver, fluid::Scheme;
    const auto with = [](bool muscl, Scheme scheme, RiemannSolver solver = RiemannSolver::acoustic) {
        fluid::FluxParameters flux;
        flux.muscl = muscl;
        flux.scheme = scheme;
        flux.solver = solver;
        return flux;
    };
    return {{"Riemann, MUSCL", with(true, Scheme::riemann)},
            {"Riemann, first order", with(false, Scheme::riemann)},
            {"Riemann, MUSCL, low dissipation", with(true, Scheme::riemann, RiemannSolver::low_dissipation)},
            {"Riemann, MUSCL, exact solver", with(true, Scheme::riemann, RiemannSolver::exact)},
            {"Riemann ALE, MUSCL", with(true, Scheme::riemann_ale)},
            {"δ-SPH", with(false, Scheme::delta_sph)},
            {"artificial viscosity", with(false, Scheme::artificial_viscosity)}};
}

// Every scheme beside the open codes.
template <int D>
std::string scheme_rows(std::size_t n, int steps, tasks::Executor& executor) {
    std::string rows;
    const OpenCodes& codes = open_codes[D - 2];
    for (const auto& [name, flux] : schemes()) {
        std::cerr << D << "D, " << name << "\n";
        const Measured m = measure<D>(n, 2.6, 0.1, steps, flux, executor);
        const double rate = 4 * double(m.particles) / m.seconds_per_step / 1e6;
        rows += fmt::format("| {}D | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", D, name, rate, rate / codes.lammps,
                            rate / codes.sphinxsys, rate / codes.dualsphysics);
    }
    return rows;
}

// Where the time of the default scheme goes.
template <int D>
std::string part_rows(std::size_t n, int steps, tasks::Executor& executor) {
    std::string rows;
    for (const double mach : {0.02, 0.1}) {
        const Measured m = measure<D>(n, 2.6, mach, steps, {}, executor);
        const double evaluations = 4 * double(m.particles), to_ns = 1e9 * executor.threads() / evaluations;
        const auto part = [&](const char* name) { return to_ns * m.parts.at(name) / m.steps; };
        rows += fmt::format(
            "| {}D, {:g} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {} in {} | {:.2f} | {:.2f} |\n", D, mach,
            m.particles, to_ns * m.seconds_per_step, part("gradients"), part("fluxes"), part("Runge-Kutta"),
            part("step, lists"), m.rebuilds, m.steps, m.lanes_before, m.lanes_after);
    }
    return rows;
}

}  // namespace

std::string step_tables(int threads) {
    tasks::Executor executor(threads);
    constexpr std::size_t n2 = 316, n3 = 46;
    const OpenCodes &plane = open_codes[0], &space = open_codes[1];
    std::string text = fmt::format(
        "Millions of fluid particles evaluated per second, lists and everything else included, on {} "
        "threads in double precision: a free block of water in a vortex of Mach 0.1, {} particles in 2D and {} in 3D, "
        "at R = 2.6 Δx (20 and 72 neighbours). A step of RK4 is four evaluations, one of RK3 three, one of Verlet one; "
        "the passes are the same. Medians of {} rounds. The open codes were measured on a comparable block, at the "
        "same "
        "support and on two threads of this type of machine: LAMMPS {:.2f} in 2D and {:.2f} in 3D, SPHinXsys {:.2f} "
        "and {:.2f}, DualSPHysics {:.2f} and {:.2f} M/s; none of them reconstructs states at the interface of a "
        "pair.\n\n| | scheme | M evaluations/s | of LAMMPS | of SPHinXsys | of DualSPHysics "
        "|\n|---|---|---|---|---|---|\n",
        threads, n2 * n2, n3 * n3 * n3, rounds, plane.lammps, space.lammps, plane.sphinxsys, space.sphinxsys,
        plane.dualsphysics, space.dualsphysics);
    text += scheme_rows<2>(n2, 10, executor) + scheme_rows<3>(n3, 5, executor);
    text +=
        "\nWhere the time of Riemann with MUSCL goes, in ns per particle, evaluation and core:\n\n| dimension, Mach | "
        "particles | all | gradients | fluxes | Runge-Kutta | step and lists | rebuilds in steps | lanes per pair, "
        "lists "
        "of a run | lists of a step |\n|---|---|---|---|---|---|---|---|---|---|\n";
    text += part_rows<2>(n2, 10, executor) + part_rows<3>(n3, 5, executor);
    text += fmt::format(
        "\nThe same in 3D at Mach 0.1, on {} threads:\n\n| particles | step [µs per particle] | bytes per particle "
        "|\n|---|---|---|\n",
        threads);
    for (const std::size_t n : {n3, std::size_t(100)}) {
        std::cerr << "3D, " << n * n * n << " particles\n";
        const Measured m = measure<3>(n, 2.6, 0.1, n == n3 ? 5 : 2, {}, executor);
        text += fmt::format("| {} | {:.2f} | {:.0f} |\n", m.particles, 1e6 * m.seconds_per_step / double(m.particles),
                            m.bytes);
    }
    return text;
}

}  // namespace aquagraph::benchmarks
