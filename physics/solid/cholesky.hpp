// Sparse Cholesky factorisation L Lᵀ of a symmetric positive definite matrix with a fixed pattern, by CHOLMOD (Chen,
// Davis, Hager & Rajamanickam, ACM Trans. Math. Softw. 35, 2008). The order of elimination and the pattern of L are
// found once, when first needed; solving reuses its workspace. Plane and small meshes are factorised column by column
// (simplicial), which calls no BLAS; where supernodes pay (more than 40 operations per nonzero of L: solid bodies) by
// blocks, with BLAS, which is held to one thread: threads belong to the tasks.
#pragma once
#include <memory>
#include <span>
#include <vector>

namespace aquagraph::solid {

class Cholesky {
  public:
    // Lower triangle by columns (CSC), rows ascending.
    Cholesky(const std::vector<int>& column_starts, const std::vector<int>& rows);
    ~Cholesky();

    std::span<double> values();  // of the pattern, to be filled before factorise()
    std::span<const double> values() const;

    // False if the matrix is not positive definite, or singular to rounding. Throws std::bad_alloc, and
    // std::runtime_error if CHOLMOD cannot analyse the pattern.
    bool factorise();

    // Solves A x = b with the last factorisation. x may be b.
    void solve(std::span<const double> b, std::span<double> x);

    double nonzeros() const;                  // of L
    double factorisation_operations() const;  // floating-point operations

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace aquagraph::solid
