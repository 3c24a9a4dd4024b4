#include "physics/fluid/runge_kutta.hpp"

namespace aquagraph::fluid {

namespace {
// One component of u: value, its derivative, the two auxiliaries.
void advance(double* u, const double* k, double* u_n, double* sum, int stage, double dt, LaneRange lanes) {
    switch (stage) {
        case 0:
            for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
                u_n[i] = u[i];
                sum[i] = k[i];
                u[i] = u_n[i] + 0.5 * dt * k[i];
            }
            break;
        case 1:
        case 2: {
            const double next = stage == 1 ? 0.5 * dt : dt;
            for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
                sum[i] += 2 * k[i];
                u[i] = u_n[i] + next * k[i];
            }
            break;
        }
        default:
            for (std::size_t i = lanes.begin; i < lanes.end; ++i) u[i] = u_n[i] + dt / 6 * (sum[i] + k[i]);
    }
}
}  // namespace

template <int D>
void RungeKutta<D>::resize(const Particles<D>& particles) {
    const std::size_t lanes = particles.clusters() * W;
    const auto fit = [&](Scalars& values) {
        if (lanes > values.capacity()) values.reserve(lanes + lanes / 4);
        values.resize(lanes);
    };
    for (auto* field : {&deviation_n, &deviation_sum}) fit(*field);
    for (int d = 0; d < D; ++d)
        for (auto* field : {&x_n[d], &v_n[d], &x_sum[d], &v_sum[d]}) fit(*field);
}

template <int D>
void update_state(Particles<D>& s, const Tait& tait, LaneRange lanes) {
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
        const double rho = tait.reference_density + s.deviation[i];
        const double p = tait.pressure(s.deviation[i]);
        s.p[i] = p < 0 && s.fullness[i] < fullness_of_interior ? 0.0 : p;
        s.impedance[i] = rho * tait.sound_speed_at(s.deviation[i]);
        s.volume[i] = s.mass[i] / rho;
    }
}

template <int D>
void advance_stage(Particles<D>& s, RungeKutta<D>& rk, const Tait& tait, int stage, double dt, LaneRange lanes) {
    // Positions first: their derivative is the velocity of this stage, which the next line overwrites.
    for (int d = 0; d < D; ++d) {
        advance(s.x[d].data(), s.v[d].data(), rk.x_n[d].data(), rk.x_sum[d].data(), stage, dt, lanes);
        advance(s.v[d].data(), s.acceleration[d].data(), rk.v_n[d].data(), rk.v_sum[d].data(), stage, dt, lanes);
    }
    advance(s.deviation.data(), s.deviation_rate.data(), rk.deviation_n.data(), rk.deviation_sum.data(), stage, dt,
            lanes);
    update_state(s, tait, lanes);
}

template struct RungeKutta<2>;
template struct RungeKutta<3>;
template void update_state(Particles<2>&, const Tait&, LaneRange);
template void update_state(Particles<3>&, const Tait&, LaneRange);
template void advance_stage(Particles<2>&, RungeKutta<2>&, const Tait&, int, double, LaneRange);
template void advance_stage(Particles<3>&, RungeKutta<3>&, const Tait&, int, double, LaneRange);

}  // namespace aquagraph::fluid
