#include "physics/fluid/particles.hpp"

#include <algorithm>

namespace aquagraph::fluid {

namespace {
// Far from everything, near enough that its square is harmless.
constexpr double far_away = 1e9;
}  // namespace

template <int D>
void Particles<D>::resize(std::size_t fluid, std::size_t ghosts) {
    const std::size_t room = (fluid + W - 1) / W * W;
    count = fluid;
    ghost_count = ghosts;
    ghost_clusters = (ghosts + W - 1) / W;
    const std::size_t lanes = room + ghost_clusters * W;

    // Growth leaves slack, so that a particle more or a ghost more at the next rebuild allocates nothing.
    const auto fit = [](auto& values, std::size_t n) {
        if (n > values.capacity()) values.reserve(n + n / 4 + 16 * W);
        values.resize(n);
    };
    fit(id, room);
    for (auto* field : {&mass, &deviation, &deviation_rate}) fit(*field, room);
    if (has_mass_exchange) fit(mass_rate, room);
    for (int d = 0; d < D; ++d)
        for (auto* field : {&acceleration[d], &x_built[d]}) fit(*field, room);
    for (auto* field : {&p, &impedance, &volume, &fullness}) fit(*field, lanes);
    if (has_mass_exchange) {
        fit(exchange, lanes);
        std::fill(exchange.begin(), exchange.begin() + std::ptrdiff_t(room), 1.0);
        std::fill(exchange.begin() + std::ptrdiff_t(room), exchange.end(), 0.0);
    }
    if (has_shift || has_mass_exchange)
        for (auto& component : shift) fit(component, lanes);
    for (int d = 0; d < D; ++d) {
        for (auto* field : {&x[d], &v[d], &grad_p[d]}) fit(*field, lanes);
        for (int e = 0; e < D; ++e) fit(grad_v[d][e], lanes);
    }
    const auto blank = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (int d = 0; d < D; ++d) {
                x[d][i] = far_away;
                v[d][i] = grad_p[d][i] = 0;
                for (int e = 0; e < D; ++e) grad_v[d][e][i] = 0;
            }
            p[i] = volume[i] = fullness[i] = 0;
            impedance[i] = 1;
        }
    };
    blank(count, room);
    blank(room + ghost_count, lanes);
    for (std::size_t i = count; i < room; ++i) {
        id[i] = -1;
        mass[i] = deviation[i] = deviation_rate[i] = 0;
        for (int d = 0; d < D; ++d) {
            acceleration[d][i] = 0;
            x_built[d][i] = far_away;
        }
    }
}

template <int D>
std::size_t Particles<D>::bytes() const {
    return bytes_of(id, mass, deviation, acceleration, deviation_rate, x_built, x, v, p, impedance, volume, grad_p,
                    grad_v, fullness, mass_rate, exchange, shift);
}

template struct Particles<2>;
template struct Particles<3>;

}  // namespace aquagraph::fluid
