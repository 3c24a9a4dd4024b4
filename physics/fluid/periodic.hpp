// Directions in which the domain repeats itself: what leaves on one side comes back on the other.
#pragma once
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "physics/fluid/particles.hpp"
#include "physics/fluid/walls/panels.hpp"

namespace aquagraph::fluid {

template <int D>
struct Periodic {
    std::array<bool, D> along{};
    Vec<D> low = Vec<D>::Zero(), high = Vec<D>::Zero();  // [m], of the directions along which it is periodic

    // The neighbouring copies of the domain: one base-3 digit per direction; 0 no shift, 1 a period up, 2 one down.
    static constexpr int copies = D == 2 ? 9 : 27;

    bool any() const {
        for (const bool periodic : along)
            if (periodic) return true;
        return false;
    }
    bool exists(int copy) const {
        for (std::size_t d = 0; d < D; ++d, copy /= 3)
            if (copy % 3 != 0 && !along[d]) return false;
        return true;
    }
    Vec<D> shift(int copy) const {
        Vec<D> by = Vec<D>::Zero();
        for (int d = 0; d < D && copy > 0; ++d, copy /= 3)
            if (copy % 3 != 0) by[d] = copy % 3 == 1 ? high[d] - low[d] : low[d] - high[d];
        return by;
    }
    // True if x, which this copy has shifted, is within `reach` of the domain along the directions of the shift.
    bool is_near(const Vec<D>& x, int copy, double reach) const {
        for (int d = 0; d < D; ++d, copy /= 3)
            if (copy % 3 != 0 && !(x[d] >= low[d] - reach && x[d] <= high[d] + reach)) return false;
        return true;
    }
    // Brings particles back into the domain. They may have left it by any number of periods.
    void wrap(Particles<D>& particles) const {
        for (std::size_t d = 0; d < D; ++d) {
            if (!along[d]) continue;
            const double from = low[int(d)], period = high[int(d)] - from;
            for (std::size_t i = 0; i < particles.count; ++i) {
                double& x = particles.x[d][i];
                if (x >= from && x < from + period) continue;
                x -= period * std::floor((x - from) / period);
                if (!(x < from + period)) x = from;  // a hair below `from`, plus a period, rounds to the upper end
            }
        }
    }
    // A period must be longer than the lists reach, or more than one copy of a particle would be in sight.
    void check(double reach) const {
        for (std::size_t d = 0; d < D; ++d)
            if (along[d] && !(high[int(d)] - low[int(d)] > reach))
                throw std::invalid_argument(
                    "the period along " + std::string(1, "xyz"[d]) + ", " + std::to_string(high[int(d)] - low[int(d)]) +
                    " m, is shorter than the reach of the neighbour lists, " + std::to_string(reach) + " m");
    }
};

}  // namespace aquagraph::fluid
