// Whole steps: evaluations of fluid particles per second with everything included, beside what open codes reach on a
// comparable block at the same support; where the time goes; and whether a million particles cost more each.
#include "benchmarks/speed/steps.hpp"

#include <fmt/format.h>

#include "benchmarks/speed/block.hpp"
#include "tasks/executor.hpp"
#include "tasks/parallel_loop.hpp"

namespace aquagraph::benchmarks {

namespace {

struct Measured {
    double seconds_per_step;  // the mean: now and then lists are rebuilt
    std::size_t particles;
    Times parts;  // seconds of all steps
    int steps;
    double lanes_before, lanes_after, bytes;
    long rebuilds;
};

template <int D>
Measured measure(std::size_t n, double ratio, double mach, int steps, tasks::Executor& executor) {
    WaterBlock<D> block(n, ratio, mach);
    Times parts;
    double seconds = 0;
    long rebuilds = 0;
    executor.execute([&] {
        for (int k = 0; k < 3; ++k) block.step(tasks::parallel_loop, parts);  // warm, pruned
        parts.clear();
        rebuilds = block.fluid.rebuilds;
        for (int k = 0; k < steps; ++k) seconds += seconds_of([&] { block.step(tasks::parallel_loop, parts); });
    });
    return {seconds / steps,
            block.fluid.particles.count,
            parts,
            steps,
            block.lanes_per_pair(false),
            block.lanes_per_pair(true),
            block.bytes_per_particle(),
            block.fluid.rebuilds - rebuilds};
}

// Fluid particles advanced per second and evaluation on two threads of the same machine at R = 2.6 Δx (20 neighbours in
// 2D, 80 in 3D), everything included. None of them reconstructs states at the interface of a pair.
struct OpenCodes {
    double lammps, sphinxsys, dualsphysics;  // millions per second
};
constexpr OpenCodes open_codes[2] = {{9.6, 4.40, 3.46}, {1.81, 0.66, 0.87}};

template <int D>
void add_rows(std::size_t n, int steps, tasks::Executor& executor, std::string& comparison, std::string& parts) {
    for (const double mach : {0.02, 0.1}) {
        const Measured m = measure<D>(n, 2.6, mach, steps, executor);
        const double evaluations = 4 * double(m.particles);
        const OpenCodes& codes = open_codes[D - 2];
        comparison +=
            fmt::format("| {}D, {:g} | {} | {:.2f} | {} | {} | {} |\n", D, mach, m.particles,
                        evaluations / m.seconds_per_step / 1e6, codes.lammps, codes.sphinxsys, codes.dualsphysics);
        const auto per_evaluation = [&](const char* name) {
            return 1e9 * executor.threads() * m.parts.at(name) / m.steps / evaluations;
        };
        parts +=
            fmt::format("| {}D, {:g} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {} in {} | {:.2f} | {:.2f} |\n", D,
                        mach, 1e9 * executor.threads() * m.seconds_per_step / evaluations, per_evaluation("gradients"),
                        per_evaluation("fluxes"), per_evaluation("Runge-Kutta"), per_evaluation("step, lists"),
                        m.rebuilds, m.steps, m.lanes_before, m.lanes_after);
    }
}

}  // namespace

std::string step_tables(int threads) {
    tasks::Executor executor(threads);
    std::string comparison =
        "| dimension, Mach | particles | aquagraph, MUSCL, double [M/s] | LAMMPS [M/s] | SPHinXsys [M/s] | "
        "DualSPHysics [M/s] |\n|---|---|---|---|---|---|\n";
    std::string parts =
        "| dimension, Mach | evaluation [ns per particle and core] | gradients | fluxes | Runge-Kutta | step and lists "
        "| rebuilds in steps | lanes per pair, lists of a run | lists of a step "
        "|\n|---|---|---|---|---|---|---|---|---|\n";
    add_rows<2>(316, 40, executor, comparison, parts);
    add_rows<3>(46, 20, executor, comparison, parts);
    std::string size = "| particles | step [µs per particle] | bytes per particle |\n|---|---|---|\n";
    for (const std::size_t n : {46, 100}) {
        const Measured m = measure<3>(n, 2.6, 0.1, n == 46 ? 20 : 6, executor);
        size += fmt::format("| {} | {:.2f} | {:.0f} |\n", m.particles, 1e6 * m.seconds_per_step / double(m.particles),
                            m.bytes);
    }
    return fmt::format(
        "\n## Whole steps\n\nEvaluations of fluid particles per second, lists and everything else included, on {} "
        "threads, at R = 2.6 Δx; a step of RK4 is four. A free block of water in a vortex.\n\n{}\nWhere the time goes:"
        "\n\n{}\nIn 3D, R = 2.6 Δx, Mach 0.1, on {} threads:\n\n{}",
        threads, comparison, parts, threads, size);
}

}  // namespace aquagraph::benchmarks
