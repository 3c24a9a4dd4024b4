// What several tests of the solid need: loads on surfaces, nodes by position, a loop on several threads, the lowest
// frequency by inverse iteration.
#pragma once
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "physics/block_loop.hpp"
#include "physics/solid/assembly.hpp"
#include "physics/solid/cholesky.hpp"
#include "physics/solid/mesh.hpp"
#include "physics/solid/solver.hpp"

namespace aquagraph::solid::test {

// Consistent nodal forces of a constant traction [N/m²] on a straight-sided surface: 1/6, 1/6, 4/6 of each edge.
inline std::vector<double> traction(const Mesh<2>& mesh, const std::string& surface, std::array<double, 2> t) {
    std::vector<double> forces(2 * mesh.nodes.size(), 0.0);
    constexpr std::array<double, 3> share{1.0 / 6, 1.0 / 6, 4.0 / 6};
    for (const Facet& edge : mesh.surface(surface)) {
        const auto &A = mesh.nodes[static_cast<std::size_t>(edge[0])],
                   &B = mesh.nodes[static_cast<std::size_t>(edge[1])];
        const double length = std::hypot(B[0] - A[0], B[1] - A[1]);
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 2; ++i)
                forces[2 * static_cast<std::size_t>(edge[k]) + i] += share[k] * length * t[i];
    }
    return forces;
}

// Every number that a law may want.
inline Material material(MaterialLaw law, double density, double E, double nu, double c10 = 0, double c01 = 0,
                         double bulk_modulus = 0) {
    Material made;
    made.law = law;
    made.density = density;
    made.youngs_modulus = E;
    made.poissons_ratio = nu;
    made.c10 = c10;
    made.c01 = c01;
    made.bulk_modulus = bulk_modulus;
    return made;
}

// Soft rubber, 1 MPa.
template <int D>
Options<D> soft_rubber() {
    Options<D> options;
    options.material = material(MaterialLaw::neo_hookean, 1000, 1e6, 0.3);
    return options;
}

// 0.1 m by 0.01 m.
inline const Mesh<2>& slender_beam() {
    static const Mesh<2> mesh = box_mesh({0, 0}, {0.1, 0.01}, 10, 1);
    return mesh;
}

inline std::size_t nearest_node(const Mesh<2>& mesh, double x, double y) {
    std::size_t best = 0;
    const auto distance = [&](std::size_t n) { return std::hypot(mesh.nodes[n][0] - x, mesh.nodes[n][1] - y); };
    for (std::size_t n = 1; n < mesh.nodes.size(); ++n)
        if (distance(n) < distance(best)) best = n;
    return best;
}

inline std::vector<double> no_load(const Mesh<2>& mesh) {
    return std::vector<double>(2 * mesh.nodes.size(), 0.0);
}

inline std::vector<double> copy(std::span<const double> values) {
    return {values.begin(), values.end()};
}

// A box mesh with every node moved.
template <class Map>
Mesh<2> mapped(Mesh<2> mesh, const Map& map) {
    for (auto& X : mesh.nodes) X = map(X);
    return mesh;
}

// A loop on real threads that take blocks as they come.
struct ThreadedLoop {
    unsigned threads = 4;
    void operator()(std::size_t blocks, BlockBody body) const {
        std::atomic<std::size_t> next{0};
        std::vector<std::thread> team;
        for (unsigned t = 0; t < threads; ++t)
            team.emplace_back([&] {
                for (std::size_t block = next++; block < blocks; block = next++) body(block);
            });
        for (std::thread& thread : team) thread.join();
    }
};

// The same numbers in [-1, 1[ on every run.
class Random {
  public:
    double operator()() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1;
    }

  private:
    std::uint64_t state_ = 42;
};

// Puts a solver into this state of motion.
inline void start_with(Solver<2>& solver, const std::vector<double>& u, const std::vector<double>& v) {
    State state;
    solver.save(state);
    state.displacements = u;
    state.velocities = v;
    solver.restore(state);
}

// The same steps three times: straight on one thread, on four threads, and from half way by a solver that the second
// one has handed its state to.
struct SixSteps {
    Solver<2> straight, threaded, restarted;

    SixSteps(const Mesh<2>& mesh, const Options<2>& options)
        : straight(mesh, options), threaded(mesh, options), restarted(mesh, options) {
        const ThreadedLoop threads{4};
        for (int k = 0; k < 6; ++k) {
            if (k == 3) {
                State state;
                threaded.save(state);
                restarted.restore(state);
            }
            straight.advance(1e-3, no_load(mesh), serial_loop);
            threaded.advance(1e-3, no_load(mesh), BlockLoop(threads));
            if (k >= 3) restarted.advance(1e-3, no_load(mesh), serial_loop);
        }
    }
};

struct Mode {
    double frequency = 0;       // [Hz]
    std::vector<double> shape;  // 2 × nodes, largest component 1
};

// Lowest eigenpair K φ = ω² M φ of the undeformed body by inverse iteration.
inline Mode lowest_mode(const Mesh<2>& mesh, const Options<2>& options) {
    Assembly<2> assembly(mesh, options);
    Cholesky cholesky(assembly.column_starts(), assembly.rows());
    const std::size_t size = 2 * mesh.nodes.size();
    std::vector<double> x(size, 0.0), Mx(size), b(assembly.equations()), y(assembly.equations());
    assembly.system_matrix(x, 1, 0, cholesky.values(), serial_loop);
    if (!cholesky.factorise()) throw ConvergenceError("the stiffness is singular");
    for (std::size_t e = 0; e < b.size(); ++e) x[assembly.freedoms()[e]] = 1.0 + static_cast<double>(e % 7);
    double omega_squared = 0;
    for (int k = 0; k < 60; ++k) {
        assembly.multiply_mass(x, Mx, serial_loop);
        for (std::size_t e = 0; e < b.size(); ++e) b[e] = Mx[assembly.freedoms()[e]];
        cholesky.solve(b, y);
        double yb = 0, yMy = 0;
        for (std::size_t e = 0; e < b.size(); ++e) {
            yb += y[e] * b[e];
            x[assembly.freedoms()[e]] = y[e];
        }
        assembly.multiply_mass(x, Mx, serial_loop);
        for (std::size_t e = 0; e < b.size(); ++e) yMy += y[e] * Mx[assembly.freedoms()[e]];
        omega_squared = yb / yMy;
        for (double& value : x) value /= std::sqrt(yMy);
    }
    double largest = 0;
    for (const double value : x)
        if (std::abs(value) > std::abs(largest)) largest = value;
    for (double& value : x) value /= largest;
    return {std::sqrt(omega_squared) / (2 * M_PI), x};
}

}  // namespace aquagraph::solid::test
