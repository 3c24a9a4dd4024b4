// Solves a symmetric positive definite system of a large matrix B, which somebody else solves with, and a small border,
// the unknowns of rigid bodies, by the Schur complement of B (Golub & Van Loan, Matrix Computations, 4th ed., 3.2.11):
//   [B  C ] [x]   [f]        W = B⁻¹ C,   S = E - Cᵀ W,
//   [Cᵀ E ] [y] = [g]        y = S⁻¹ (g - Wᵀ f),   x = B⁻¹ f - W y
// Without a border it is the solution with B alone.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "physics/block_loop.hpp"

namespace aquagraph::solid {

// x = B⁻¹ b; false if that fails. x may be b.
using SolveB = FunctionRef<bool(std::span<const double> b, std::span<double> x)>;

class Border {
  public:
    // Rows of B, columns of C.
    Border(std::size_t rows, std::size_t columns);

    // To be filled before condense().
    std::span<double> column(std::size_t k) { return std::span(columns_).subspan(k * rows_, rows_); }  // of C
    double& corner(std::size_t row, std::size_t column) { return corner_[row * count_ + column]; }     // of E

    // False if a solution fails or the whole is not positive definite, or singular to rounding.
    bool condense(SolveB solve);

    // Right side and solution: rows of B, then the border's. x may be b. False if the solution with B fails.
    bool solve(std::span<const double> b, std::span<double> x, SolveB solve);

  private:
    bool factorise_corner();

    std::size_t rows_, count_;
    std::vector<double> columns_, condensed_;  // C; W; column after column
    std::vector<double> corner_;               // E, then the lower Cholesky factor of S
    std::vector<double> small_;                // y
};

}  // namespace aquagraph::solid
