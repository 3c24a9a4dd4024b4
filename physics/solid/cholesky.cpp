#include "physics/solid/cholesky.hpp"

#include <cholmod.h>
#include <dlfcn.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace aquagraph::solid {

namespace {

// OpenBLAS and BLIS each have a function for it; other libraries have no threads of their own, or are told by the
// environment.
void keep_blas_to_one_thread() {
    if (void* set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<void (*)(int)>(set)(1);
    if (void* set = dlsym(RTLD_DEFAULT, "bli_thread_set_num_threads")) reinterpret_cast<void (*)(long)>(set)(1);
}

// CHOLMOD's loops over supernodes ask OpenMP for four threads whatever it has been told, and these spin beside those of
// the tasks. The limit belongs to the calling thread: to be set before each factorisation.
void keep_openmp_to_one_thread() {
    static void* const set = dlsym(RTLD_DEFAULT, "omp_set_max_active_levels");
    if (set != nullptr) reinterpret_cast<void (*)(int)>(set)(0);
}

}  // namespace

struct Cholesky::Implementation {
    cholmod_common common{};
    cholmod_sparse* matrix = nullptr;
    cholmod_factor* factor = nullptr;
    cholmod_dense* right_side = nullptr;
    cholmod_dense *solution = nullptr, *workspace_y = nullptr, *workspace_e = nullptr;  // kept by cholmod_solve2

    Implementation() {
        keep_blas_to_one_thread();
        cholmod_start(&common);
        common.print = 0;
        common.supernodal = CHOLMOD_AUTO;
        common.final_ll = 1;  // L Lᵀ, not L D Lᵀ: an indefinite matrix must be noticed
    }
    ~Implementation() {
        cholmod_free_dense(&workspace_e, &common);
        cholmod_free_dense(&workspace_y, &common);
        cholmod_free_dense(&solution, &common);
        cholmod_free_dense(&right_side, &common);
        cholmod_free_factor(&factor, &common);
        cholmod_free_sparse(&matrix, &common);
        cholmod_finish(&common);
    }
    // Finds the order of elimination, once.
    void analyse() {
        if (factor != nullptr) return;
        factor = cholmod_analyze(matrix, &common);
        if (factor == nullptr) throw std::runtime_error("CHOLMOD cannot analyse the stiffness matrix of the solid");
    }
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;
};

Cholesky::Cholesky(const std::vector<int>& column_starts, const std::vector<int>& rows)
    : implementation_(std::make_unique<Implementation>()) {
    Implementation& self = *implementation_;
    const std::size_t n = column_starts.size() - 1;
    constexpr int lower_triangle = -1, sorted = 1, packed = 1;
    self.matrix =
        cholmod_allocate_sparse(n, n, rows.size(), sorted, packed, lower_triangle, CHOLMOD_REAL, &self.common);
    self.right_side = cholmod_allocate_dense(n, 1, n, CHOLMOD_REAL, &self.common);
    if (self.matrix == nullptr || self.right_side == nullptr) throw std::bad_alloc();
    std::copy(column_starts.begin(), column_starts.end(), static_cast<int*>(self.matrix->p));
    std::copy(rows.begin(), rows.end(), static_cast<int*>(self.matrix->i));
}

Cholesky::~Cholesky() = default;

double Cholesky::nonzeros() const {
    implementation_->analyse();
    return implementation_->common.lnz;
}

double Cholesky::factorisation_operations() const {
    implementation_->analyse();
    return implementation_->common.fl;
}

std::span<double> Cholesky::values() {
    return {static_cast<double*>(implementation_->matrix->x), implementation_->matrix->nzmax};
}

std::span<const double> Cholesky::values() const {
    return {static_cast<const double*>(implementation_->matrix->x), implementation_->matrix->nzmax};
}

bool Cholesky::factorise() {
    Implementation& self = *implementation_;
    self.analyse();
    keep_openmp_to_one_thread();
    cholmod_factorize(self.matrix, self.factor, &self.common);
    if (self.common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (self.common.status != CHOLMOD_OK) return false;
    constexpr double singular_to_rounding = 1e-15;  // (smallest / largest diagonal entry of L)²
    return cholmod_rcond(self.factor, &self.common) > singular_to_rounding;
}

void Cholesky::solve(std::span<const double> b, std::span<double> x) {
    Implementation& self = *implementation_;
    std::copy(b.begin(), b.end(), static_cast<double*>(self.right_side->x));
    if (self.workspace_y != nullptr && self.workspace_y->nzmax == 4 * b.size()) {
        // cholmod_solve2 asks for 4 × n, leaves the shape 1 × n behind, and would allocate anew because they differ.
        self.workspace_y->nrow = self.workspace_y->d = 4;
        self.workspace_y->ncol = b.size();
    }
    cholmod_solve2(CHOLMOD_A, self.factor, self.right_side, nullptr, &self.solution, nullptr, &self.workspace_y,
                   &self.workspace_e, &self.common);
    if (self.common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    const auto* solution = static_cast<const double*>(self.solution->x);
    std::copy(solution, solution + b.size(), x.begin());
}

}  // namespace aquagraph::solid
