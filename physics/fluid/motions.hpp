// What a pass over pairs reads of particle i where positions and velocities are all that it needs.
#pragma once
#include "physics/fluid/particles.hpp"

namespace aquagraph::fluid {

template <int D>
struct Motions {
    const double* x[D];
    const double* v[D];

    explicit Motions(const Particles<D>& s) {
        for (std::size_t d = 0; d < D; ++d) {
            x[d] = s.x[d].data();
            v[d] = s.v[d].data();
        }
    }

    struct Own {
        double x[D], v[D];
    };
    Own load(std::size_t i) const {
        Own own;
        for (std::size_t d = 0; d < D; ++d) {
            own.x[d] = x[d][i];
            own.v[d] = v[d][i];
        }
        return own;
    }
};

}  // namespace aquagraph::fluid
