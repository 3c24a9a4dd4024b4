// Tangents of what acts on facets, as they lie facet by facet, against central differences of its forces.
#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "physics/solid/mesh.hpp"

namespace aquagraph::solid::test {

struct TangentError {
    double worst = 0;    // largest difference of an entry [N/m]
    double largest = 0;  // entry of the tangent [N/m]
};

// matrices: lower triangles of the facets of one surface, each symmetric, of K = -∂f/∂u at u. add_forces(u, f) adds
// the forces f.
template <int D, class AddForces>
TangentError facet_tangent_error(const std::vector<Facet>& facets, std::span<const double> matrices,
                                 const std::vector<double>& u, AddForces&& add_forces) {
    const std::size_t size = u.size();
    std::vector<double> K(size * size, 0.0), plus(size), minus(size);
    const double* entry = matrices.data();
    for (const Facet& facet : facets)
        for (std::size_t r = 0; r < D * facet.size(); ++r)
            for (std::size_t c = 0; c <= r; ++c, ++entry) {
                const std::size_t row = D * std::size_t(facet[r / D]) + r % D,
                                  column = D * std::size_t(facet[c / D]) + c % D;
                K[row * size + column] += *entry;
                if (c < r) K[column * size + row] += *entry;
            }
    TangentError error;
    for (std::size_t column = 0; column < size; ++column) {
        constexpr double h = 1e-6;
        std::vector<double> moved = u;
        std::fill(plus.begin(), plus.end(), 0.0);
        std::fill(minus.begin(), minus.end(), 0.0);
        moved[column] += h;
        add_forces(moved, plus);
        moved[column] -= 2 * h;
        add_forces(moved, minus);
        for (std::size_t row = 0; row < size; ++row) {
            const double of_forces = -(plus[row] - minus[row]) / (2 * h);
            error.worst = std::max(error.worst, std::abs(K[row * size + column] - of_forces));
            error.largest = std::max(error.largest, std::abs(K[row * size + column]));
        }
    }
    return error;
}

}  // namespace aquagraph::solid::test
