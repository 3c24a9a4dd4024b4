#include "physics/solid/eigenmodes.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/solid/cholesky.hpp"

namespace aquagraph::solid {

namespace {

// Of the largest ratio of diagonals, which is about the largest λ: far below all but rigid motions, far above rounding.
constexpr double shift_of_largest = 1e-10;
constexpr int shifts_tried = 8;  // each a hundred times the one before, where K is indefinite
constexpr double tolerance = 1e-10;
constexpr int most_restarts = 1000;

using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

// y = M x from the lower triangle. The type's name and its members are what Spectra asks for.
class MassProduct {
  public:
    using Scalar = double;
    MassProduct(const std::vector<int>& column_starts, const std::vector<int>& rows, std::span<const double> values)
        : column_starts_(column_starts), rows_(rows), values_(values) {}
    Index rows() const { return Index(column_starts_.size()) - 1; }
    Index cols() const { return rows(); }
    void perform_op(const double* x, double* y) const {
        std::fill(y, y + rows(), 0.0);
        for (Index c = 0; c < rows(); ++c)
            for (int k = column_starts_[std::size_t(c)]; k < column_starts_[std::size_t(c) + 1]; ++k) {
                const int r = rows_[std::size_t(k)];
                const double m = values_[std::size_t(k)];
                y[r] += m * x[c];
                if (r != c) y[c] += m * x[r];
            }
    }

  private:
    const std::vector<int>& column_starts_;
    const std::vector<int>& rows_;
    std::span<const double> values_;
};

// y = (K - σM)⁻¹ x, less its part along the modes already found.
class ShiftedInverse {
  public:
    using Scalar = double;
    ShiftedInverse(Cholesky& cholesky, const MassProduct& mass, const std::vector<Eigenmode>& found)
        : cholesky_(cholesky), mass_(mass), found_(found), Mx_(mass.rows()) {}
    Index rows() const { return mass_.rows(); }
    Index cols() const { return rows(); }
    void set_shift(double) {}  // factorised already
    void perform_op(const double* x, double* y) const {
        const auto n = std::size_t(rows());
        cholesky_.solve({x, n}, {y, n});
        for (int twice = 0; twice < (found_.empty() ? 0 : 2); ++twice) {
            mass_.perform_op(y, Mx_.data());
            for (const Eigenmode& mode : found_) {
                const Eigen::Map<const Vector> phi(mode.vector.data(), rows());
                Eigen::Map<Vector>(y, rows()) -= phi.dot(Mx_) * phi;
            }
        }
    }

  private:
    Cholesky& cholesky_;
    const MassProduct& mass_;
    const std::vector<Eigenmode>& found_;
    mutable Vector Mx_;
};

// σ below all λ, with the factors of K - σM in `cholesky`.
double factorise_shifted(Cholesky& cholesky, const std::vector<int>& column_starts, std::span<const double> K,
                         std::span<const double> M) {
    double largest = 0;
    for (std::size_t c = 0; c + 1 < column_starts.size(); ++c) {  // the diagonal comes first in its column
        const auto k = std::size_t(column_starts[c]);
        largest = std::max(largest, std::abs(K[k] / M[k]));
    }
    double sigma = -shift_of_largest * largest;
    for (int attempt = 0; attempt < shifts_tried; ++attempt, sigma *= 100) {
        const std::span<double> values = cholesky.values();
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = K[k] - sigma * M[k];
        if (cholesky.factorise()) return sigma;
    }
    throw std::runtime_error("the stiffness is not bounded below: no shift makes it positive definite");
}

std::vector<Eigenmode> search(Cholesky& cholesky, const MassProduct& mass, double sigma, int count,
                              const std::vector<Eigenmode>& found) {
    const Index n = mass.rows(), wanted = std::min<Index>(count, n - 1);
    ShiftedInverse inverse(cholesky, mass, found);
    const Index space = std::min(n, std::max<Index>(2 * wanted + 1, 20));
    Spectra::SymGEigsShiftSolver<ShiftedInverse, const MassProduct, Spectra::GEigsMode::ShiftInvert> solver(
        inverse, mass, wanted, space, sigma);
    solver.init();
    const Index converged =
        solver.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance, Spectra::SortRule::SmallestAlge);
    if (solver.info() != Spectra::CompInfo::Successful)
        throw std::runtime_error("the search for natural modes has not converged: " + std::to_string(converged) +
                                 " of " + std::to_string(wanted) + " are known; ask for fewer");
    std::vector<Eigenmode> modes;
    for (Index k = 0; k < wanted; ++k) {
        Eigenmode& mode = modes.emplace_back();
        mode.eigenvalue = solver.eigenvalues()[k];
        const Vector phi = solver.eigenvectors(wanted).col(k);
        Vector Mphi(n);
        mass.perform_op(phi.data(), Mphi.data());
        Index largest = 0;
        phi.cwiseAbs().maxCoeff(&largest);
        const double factor = (phi[largest] < 0 ? -1 : 1) / std::sqrt(phi.dot(Mphi));
        for (Index i = 0; i < n; ++i) mode.vector.push_back(factor * phi[i]);
    }
    return modes;
}

}  // namespace

std::vector<Eigenmode> lowest_eigenmodes(const std::vector<int>& column_starts, const std::vector<int>& rows,
                                         std::span<const double> K, std::span<const double> M, int count) {
    const int size = int(column_starts.size()) - 1;
    if (count < 1 || count >= size)
        throw std::invalid_argument("between 1 and " + std::to_string(size - 1) +
                                    " natural modes can be asked for, not " + std::to_string(count));
    Cholesky cholesky(column_starts, rows);
    const MassProduct mass(column_starts, rows, M);
    const double sigma = factorise_shifted(cholesky, column_starts, K, M);
    std::vector<Eigenmode> modes = search(cholesky, mass, sigma, count, {});
    constexpr int at_a_time = 6;  // rigid motions of a free body in space
    for (;;) {
        if (int(modes.size()) >= size - 1) break;
        const int left = size - int(modes.size()) - 1;
        const double highest = modes[std::size_t(count) - 1].eigenvalue;
        bool lower = false;
        for (Eigenmode& mode : search(cholesky, mass, sigma, std::clamp(left, 1, std::min(at_a_time, count)), modes)) {
            // Relative to the shift: that is how well they are known.
            lower = lower || mode.eigenvalue - sigma < (1 - 1e-6) * (highest - sigma);
            modes.push_back(std::move(mode));
        }
        std::stable_sort(modes.begin(), modes.end(),
                         [](const Eigenmode& a, const Eigenmode& b) { return a.eigenvalue < b.eigenvalue; });
        if (!lower) break;
    }
    modes.resize(std::size_t(count));
    return modes;
}

}  // namespace aquagraph::solid
