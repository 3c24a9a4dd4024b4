// Which lanes of a cluster lie near a point: what the search and the pruning of lists do most of the time.
#pragma once
#include <cstddef>

#include "physics/fluid/particles.hpp"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace aquagraph::fluid {

// Positions as plain pointers.
template <int D>
struct Places {
    const double* x[D];
    explicit Places(const Vectors<D>& positions) {
        for (int d = 0; d < D; ++d) x[d] = positions[d].data();
    }
};

// Squared distances [m²] from `own` to the W lanes of a cluster that begin at `first`; below() gives bit l where that
// of lane l is smaller than a limit [m²], to which the square of the lane's velocity relative to `velocity` may add.
#ifdef __AVX512F__
template <int D>
class LaneDistances {
    static_assert(W == 8);

  public:
    [[gnu::always_inline]] LaneDistances(const Places<D>& places, std::size_t first, const double (&own)[D]) {
        for (int d = 0; d < D; ++d) {
            const __m512d dx = _mm512_sub_pd(_mm512_loadu_pd(places.x[d] + first), _mm512_set1_pd(own[d]));
            squared_ = d == 0 ? _mm512_mul_pd(dx, dx) : _mm512_fmadd_pd(dx, dx, squared_);
        }
    }
    [[gnu::always_inline]] unsigned below(double limit) const {
        return _mm512_cmp_pd_mask(squared_, _mm512_set1_pd(limit), _CMP_LT_OQ);
    }
    [[gnu::always_inline]] unsigned below(double limit, double per_speed, const Places<D>& velocities,
                                          std::size_t first, const double (&velocity)[D]) const {
        __m512d speed;  // squared
        for (int d = 0; d < D; ++d) {
            const __m512d dv = _mm512_sub_pd(_mm512_loadu_pd(velocities.x[d] + first), _mm512_set1_pd(velocity[d]));
            speed = d == 0 ? _mm512_mul_pd(dv, dv) : _mm512_fmadd_pd(dv, dv, speed);
        }
        return _mm512_cmp_pd_mask(squared_, _mm512_fmadd_pd(_mm512_set1_pd(per_speed), speed, _mm512_set1_pd(limit)),
                                  _CMP_LT_OQ);
    }

  private:
    __m512d squared_;
};
#else
template <int D>
class LaneDistances {
  public:
    LaneDistances(const Places<D>& places, std::size_t first, const double (&own)[D]) {
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            double r2 = 0;
            for (int d = 0; d < D; ++d) {
                const double dx = places.x[d][first + l] - own[d];
                r2 += dx * dx;
            }
            squared_[l] = r2;
        }
    }
    // Sums of powers of two: a form that GCC turns into one vector compare.
    unsigned below(double limit) const {
        unsigned bits = 0;
#pragma omp simd reduction(+ : bits)
        for (unsigned l = 0; l < W; ++l) bits += squared_[l] < limit ? 1u << l : 0u;
        return bits;
    }
    unsigned below(double limit, double per_speed, const Places<D>& velocities, std::size_t first,
                   const double (&velocity)[D]) const {
        unsigned bits = 0;
#pragma omp simd reduction(+ : bits)
        for (unsigned l = 0; l < W; ++l) {
            double speed = 0;
            for (int d = 0; d < D; ++d) {
                const double dv = velocities.x[d][first + l] - velocity[d];
                speed += dv * dv;
            }
            bits += squared_[l] < limit + per_speed * speed ? 1u << l : 0u;
        }
        return bits;
    }

  private:
    double squared_[W];
};
#endif

}  // namespace aquagraph::fluid
