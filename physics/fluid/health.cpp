#include "physics/fluid/health.hpp"

#include <cmath>

namespace aquagraph::fluid {

template <int D>
Diagnosis examine(const Particles<D>& s, double reference_density, const Domain<D>& domain, bool closed,
                  LaneRange lanes) {
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        bool finite = std::isfinite(s.deviation[i]) && std::isfinite(s.p[i]);
        for (std::size_t d = 0; d < D; ++d) finite = finite && std::isfinite(s.x[d][i]) && std::isfinite(s.v[d][i]);
        if (!finite) return {Ailment::not_finite, i};
        if (!(s.deviation[i] > -0.9 * reference_density)) return {Ailment::no_volume, i};
        if (closed && !domain.contains(s, i)) return {Ailment::left_domain, i};
    }
    return {};
}

template <int D>
FluidEnergies energies(const Particles<D>& s, const double (&gravity)[3], LaneRange lanes) {
    FluidEnergies sum;
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        double v2 = 0, gx = 0;
        for (std::size_t d = 0; d < D; ++d) {
            v2 += s.v[d][i] * s.v[d][i];
            gx += gravity[d] * s.x[d][i];
        }
        sum.kinetic += 0.5 * s.mass[i] * v2;
        sum.potential -= s.mass[i] * gx;
    }
    return sum;
}

template <int D>
std::size_t remove_outside(Particles<D>& s, const Domain<D>& domain) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        if (!domain.contains(s, i)) continue;
        if (kept != i) {
            s.id[kept] = s.id[i];
            for (auto* field : {&s.mass, &s.deviation, &s.deviation_rate, &s.fullness, &s.p, &s.impedance, &s.volume})
                (*field)[kept] = (*field)[i];
            for (std::size_t d = 0; d < D; ++d)
                for (auto* field : {&s.x[d], &s.v[d], &s.acceleration[d], &s.x_built[d]}) (*field)[kept] = (*field)[i];
        }
        ++kept;
    }
    const std::size_t removed = s.count - kept;
    if (removed > 0) s.resize(kept, 0);
    return removed;
}

template Diagnosis examine(const Particles<2>&, double, const Domain<2>&, bool, LaneRange);
template Diagnosis examine(const Particles<3>&, double, const Domain<3>&, bool, LaneRange);
template FluidEnergies energies(const Particles<2>&, const double (&)[3], LaneRange);
template FluidEnergies energies(const Particles<3>&, const double (&)[3], LaneRange);
template std::size_t remove_outside(Particles<2>&, const Domain<2>&);
template std::size_t remove_outside(Particles<3>&, const Domain<3>&);

}  // namespace aquagraph::fluid
