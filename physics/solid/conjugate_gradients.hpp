// Conjugate gradients, preconditioned with the diagonal (Hestenes & Stiefel, J. Res. Nat. Bur. Stand. 49, 1952), for
// the systems of tiny time steps: there B = M + w β Δt² K is hardly more than the mass matrix, whose condition does not
// grow with the mesh (Wathen, IMA J. Numer. Anal. 7, 1987), and a dozen iterations take less than one pass through a
// factor. Bitwise the same for any number of threads; allocates nothing in solve().
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "physics/block_loop.hpp"

namespace aquagraph::solid {

class ConjugateGradients {
  public:
    // The pattern of the lower triangle by columns (CSC), rows ascending, every diagonal entry in it; kept by
    // reference.
    ConjugateGradients(const std::vector<int>& column_starts, const std::vector<int>& rows);

    // y = A x for the symmetric matrix with these values in that pattern.
    void multiply(std::span<const double> values, std::span<const double> x, std::span<double> y, BlockLoop loop) const;

    // Solves A x = b from x = 0 until |b - A x| <= tolerance |b|. Returns the number of iterations, or -1 if that takes
    // more than `most`, or A turns out not to be positive definite.
    int solve(std::span<const double> values, std::span<const double> b, std::span<double> x, double tolerance,
              int most, BlockLoop loop);

  private:
    void build_transpose();

    const std::vector<int>& column_starts_;
    const std::vector<int>& rows_;
    // The part of each row left of the diagonal: which nonzero, and in which column. Built when first needed.
    std::vector<std::uint32_t> row_starts_, nonzero_, column_;
    std::vector<double> residual_, direction_, product_, partial_sums_;
};

}  // namespace aquagraph::solid
