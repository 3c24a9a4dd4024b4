// The lowest eigenpairs of K φ = λ M φ: Lanczos' method on (K - σM)⁻¹ M with σ below all λ, so that the lowest λ become
// the largest eigenvalues and converge first (Ericsson & Ruhe, Math. Comput. 35, 1980; restarted implicitly by the
// library Spectra), the inverse by Cholesky's factors. A Krylov space holds one vector of a multiple eigenvalue only:
// the search is repeated in what is M-orthogonal to all found, until it finds nothing lower.
#pragma once
#include <span>
#include <vector>

namespace aquagraph::solid {

struct Eigenmode {
    double eigenvalue = 0;
    std::vector<double> vector;  // φ, with φᵀ M φ = 1; its largest entry is positive
};

// K and M symmetric, M positive definite, lower triangles by columns (CSC) in one pattern, rows ascending. K may be
// singular or indefinite: then the lowest λ are zero or negative. Ascending; the same bits in every call. Throws
// std::invalid_argument unless 1 <= count < size of the matrices, std::runtime_error if the search does not converge.
std::vector<Eigenmode> lowest_eigenmodes(const std::vector<int>& column_starts, const std::vector<int>& rows,
                                         std::span<const double> K, std::span<const double> M, int count);

}  // namespace aquagraph::solid
