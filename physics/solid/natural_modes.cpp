#include <cmath>

#include "physics/solid/eigenmodes.hpp"
#include "physics/solid/solver_implementation.hpp"

namespace aquagraph::solid {

template <int D>
std::vector<NaturalMode> Solver<D>::natural_modes(int count, BlockLoop loop) {
    Assembly<D>& assembly = implementation_->assembly;
    const std::vector<double>& u = implementation_->u;
    std::vector<double> K(assembly.rows().size()), M(assembly.rows().size());
    const auto of_last_matrix = implementation_->linearised;
    implementation_->linearise_here();
    implementation_->add_surface_tangents(loop);
    implementation_->linearised = of_last_matrix;
    assembly.system_matrix(u, 1, 0, K, loop);
    assembly.system_matrix(u, 0, 1, M, loop);
    std::vector<Eigenmode> found;
    try {
        found = lowest_eigenmodes(assembly.column_starts(), assembly.rows(), K, M, count);
    } catch (const std::runtime_error& error) {
        throw ConvergenceError("solid: " + std::string(error.what()));
    }
    std::vector<NaturalMode> modes;
    std::vector<double> momentum(u.size());
    for (const Eigenmode& eigen : found) {
        NaturalMode& mode = modes.emplace_back();
        mode.eigenvalue = eigen.eigenvalue;
        mode.frequency = std::copysign(std::sqrt(std::abs(eigen.eigenvalue)) / (2 * M_PI), eigen.eigenvalue);
        mode.shape.assign(u.size(), 0.0);
        for (std::size_t e = 0; e < eigen.vector.size(); ++e) mode.shape[assembly.freedoms()[e]] = eigen.vector[e];
        // Γ_d = φᵀ M e_d with φᵀ M φ = 1: the effective mass is Γ_d²
        assembly.multiply_mass(mode.shape, momentum, loop);
        std::array<double, 3> participation{};
        for (std::size_t f = 0; f < u.size(); ++f) participation[f % D] += momentum[f];
        for (std::size_t d = 0; d < D; ++d)
            mode.mass_fraction[d] = participation[d] * participation[d] / assembly.mass();
        double largest = 0;
        for (const double x : mode.shape)
            if (std::abs(x) > std::abs(largest)) largest = x;
        for (double& x : mode.shape) x /= largest;
        mode.mass = 1 / (largest * largest);
    }
    return modes;
}

template std::vector<NaturalMode> Solver<2>::natural_modes(int, BlockLoop);
template std::vector<NaturalMode> Solver<3>::natural_modes(int, BlockLoop);

}  // namespace aquagraph::solid
