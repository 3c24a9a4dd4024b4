#include "physics/coupling/fixed_point.hpp"

#include <algorithm>
#include <cmath>

namespace aquagraph::coupling {

namespace {

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

// Differences that lie in the others' span but for this part of their length teach nothing but rounding.
constexpr double least_independent_part = 1e-6;
constexpr int most_retreats = 8;  // to a 256th of the way

}  // namespace

void FixedPoint::begin(std::span<const double> start, std::span<const double> guess) {
    start_.assign(start.begin(), start.end());
    guess_.assign(guess.begin(), guess.end());
    sound_ = start_;
    iterations_ = retreats_ = 0;
    converged_ = false;
    omega_ = std::clamp(omega_, -1.0, 1.0);
}

void FixedPoint::update(std::span<const double> computed) {
    const std::size_t n = guess_.size();
    const bool first = iterations_ == 0;
    if (!first) std::swap(r_, last_r_);
    r_.resize(n);
    double moved2 = 0;
    for (std::size_t k = 0; k < n; ++k) {
        r_[k] = computed[k] - guess_[k];
        moved2 += (computed[k] - start_[k]) * (computed[k] - start_[k]);
    }
    const double norm = std::sqrt(dot(r_, r_)), moved = std::sqrt(moved2);
    ++iterations_;
    ++total_iterations;
    sound_ = guess_;
    retreats_ = 0;
    residual_ = moved > 0 ? norm / moved : 0;
    converged_ = norm <= choices.tolerance * moved;

    if (choices.relaxation == Relaxation::quasi_newton) {
        if (!first) {
            Difference difference;
            const std::size_t most = std::min<std::size_t>(n, 40);
            if (differences_.size() >= most) {  // the oldest one's memory is used again
                difference = std::move(differences_.back());
                differences_.pop_back();
            }
            difference.cycle = cycles;
            difference.residual.resize(n);
            difference.computed.resize(n);
            for (std::size_t k = 0; k < n; ++k) {
                difference.residual[k] = r_[k] - last_r_[k];
                difference.computed[k] = computed[k] - last_computed_[k];
            }
            differences_.insert(differences_.begin(), std::move(difference));
        }
        last_computed_.assign(computed.begin(), computed.end());
        if (!finished()) quasi_newton(computed);
        return;
    }
    if (!first) {
        double against = 0, change2 = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double change = r_[k] - last_r_[k];
            against += last_r_[k] * change;
            change2 += change * change;
        }
        if (change2 > 0) omega_ *= -against / change2;
    }
    if (!finished())
        for (std::size_t k = 0; k < n; ++k) guess_[k] += omega_ * r_[k];
}

// Makes q_[rank] out of a difference of residuals and fills its column of the triangle.
bool FixedPoint::orthogonalise(std::size_t column, std::size_t rank) {
    if (q_.size() <= rank) {
        q_.resize(rank + 1);
        triangle_.resize(rank + 1);
    }
    std::vector<double>& q = q_[rank];
    std::vector<double>& entries = triangle_[rank];
    q.assign(differences_[column].residual.begin(), differences_[column].residual.end());
    entries.assign(rank + 1, 0.0);
    const double length = std::sqrt(dot(q, q));
    for (int pass = 0; pass < 2; ++pass)  // twice is enough
        for (std::size_t j = 0; j < rank; ++j) {
            const double share = dot(q_[j], q);
            entries[j] += share;
            for (std::size_t k = 0; k < q.size(); ++k) q[k] -= share * q_[j][k];
        }
    const double left = std::sqrt(dot(q, q));
    if (!(left > least_independent_part * length)) return false;
    entries[rank] = left;
    for (double& x : q) x /= left;
    return true;
}

void FixedPoint::quasi_newton(std::span<const double> computed) {
    used_.clear();
    for (std::size_t column = 0; column < differences_.size(); ++column)
        if (orthogonalise(column, used_.size())) used_.push_back(column);
    if (used_.empty()) {
        for (std::size_t k = 0; k < guess_.size(); ++k) guess_[k] += omega_ * r_[k];
        return;
    }
    coefficients_.assign(used_.size(), 0.0);
    for (std::size_t j = used_.size(); j-- > 0;) {  // R c = -Qᵀ r
        double value = -dot(q_[j], r_);
        for (std::size_t m = j + 1; m < used_.size(); ++m) value -= triangle_[m][j] * coefficients_[m];
        coefficients_[j] = value / triangle_[j][j];
    }
    std::copy(computed.begin(), computed.end(), guess_.begin());
    for (std::size_t j = 0; j < used_.size(); ++j) {
        const std::vector<double>& change = differences_[used_[j]].computed;
        for (std::size_t k = 0; k < guess_.size(); ++k) guess_[k] += coefficients_[j] * change[k];
    }
}

bool FixedPoint::retreat() {
    ++failed_trials;
    if (retreats_ == most_retreats) return false;
    ++retreats_;
    for (std::size_t k = 0; k < guess_.size(); ++k) guess_[k] = 0.5 * (guess_[k] + sound_[k]);
    // Aitken's ω is the step that was made, in residuals of the last trial; the first guess of a cycle is none.
    if (choices.relaxation == Relaxation::aitken && iterations_ > 0) omega_ *= 0.5;
    return true;
}

void FixedPoint::end() {
    if (!converged_) ++unconverged;
    ++cycles;
    while (!differences_.empty() && differences_.back().cycle + long(choices.reuse) < cycles) differences_.pop_back();
}

}  // namespace aquagraph::coupling
