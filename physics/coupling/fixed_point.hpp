// Fluid and solid in one cycle until they agree: y is what the fluid assumes of the wet nodes at the end of the cycle,
// S(y) what the solid then makes of the fluid's loads, and y = S(y) is sought. With a light body in water S contracts
// too little or not at all (added mass), so y moves by what the residuals r_k = S(y_k) - y_k of earlier iterations
// teach:
//   aitken        y_k+1 = y_k + ω_k r_k,  ω_k = -ω_k-1 r_k-1·(r_k - r_k-1) / |r_k - r_k-1|²  (Irons & Tuck 1969;
//                 Küttler & Wall 2008); the first of a cycle takes the ω of the cycle before, at most 1
//   quasi_newton  y_k+1 = S(y_k) + Σ_j c_j ΔS_j,  c minimising |r_k + Σ_j c_j Δr_j|: the interface quasi-Newton method
//                 with an inverse Jacobian from least squares (Degroote, Bathe & Vierendeels 2009), with differences of
//                 the last cycles as well; the first of a run relaxes by 0.1
// Converged: |r| <= tolerance × |S(y) - y_0|, y_0 being the state at the start of the cycle.
//
// A guess may be so far off that S(y) does not exist: the wall is driven through particles, or the solid cannot bear
// their loads. It is then taken back half way to the last one for which S was computed, y_0 where there is none yet,
// and tried again, up to eight times in a row.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "physics/coupling/choices.hpp"

namespace aquagraph::coupling {

struct IterationChoices {
    Relaxation relaxation = Relaxation::quasi_newton;
    double tolerance = 1e-3;
    int most = 20;          // iterations of a cycle
    std::size_t reuse = 5;  // cycles whose differences quasi_newton uses
};

class FixedPoint {
  public:
    IterationChoices choices;

    // A cycle begins at `start`; the first guess of its end.
    void begin(std::span<const double> start, std::span<const double> guess);
    std::span<const double> guess() const { return guess_; }
    // S(guess) is known: the next guess, unless converged() or there have been enough iterations.
    void update(std::span<const double> computed);
    // S(guess) could not be computed: a guess half as far from one that was. False: it has been halved often enough.
    bool retreat();
    // The cycle is over: what it has taught is kept.
    void end();

    bool converged() const { return converged_; }
    bool finished() const { return converged_ || iterations_ >= choices.most; }
    int iterations() const { return iterations_; }  // of this cycle
    double residual() const { return residual_; }   // |r| over |S(y) - y_0|, of the last one
    int retreats() const { return retreats_; }      // of the present guess
    long total_iterations = 0, cycles = 0, unconverged = 0, failed_trials = 0;

    template <class Archive>
    void archive(Archive& fields) {  // for a checkpoint, between cycles
        fields(omega_, iterations_, residual_, converged_, total_iterations, cycles, unconverged, failed_trials,
               differences_);
    }

  private:
    struct Difference {
        std::vector<double> residual, computed;
        long cycle = 0;
        template <class Archive>
        void archive(Archive& fields) {
            fields(residual, computed, cycle);
        }
    };
    void quasi_newton(std::span<const double> computed);
    bool orthogonalise(std::size_t column, std::size_t rank);

    std::vector<double> start_, guess_, r_, last_r_, last_computed_;
    std::vector<double> sound_;  // the last guess whose S was computed
    double omega_ = 0.1, residual_ = 0;
    int iterations_ = 0, retreats_ = 0;
    bool converged_ = false;
    std::vector<Difference> differences_;  // the latest first
    // Of the least squares: orthonormal columns, the triangle, which differences they belong to, coefficients.
    std::vector<std::vector<double>> q_, triangle_;
    std::vector<std::size_t> used_;
    std::vector<double> coefficients_;
};

}  // namespace aquagraph::coupling
