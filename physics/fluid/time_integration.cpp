#include "physics/fluid/time_integration.hpp"

#include <algorithm>

namespace aquagraph::fluid {

namespace {

constexpr std::size_t lanes_per_block = clusters_per_block * W;

// One component of u by the scheme: value, its rate, the two auxiliaries.
void advance_rk4(double* u, const double* k, double* u_n, double* sum, int stage, double dt, LaneRange lanes) {
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

void advance_rk3(double* u, const double* f, double* k, int stage, double dt, LaneRange lanes) {
    constexpr double A[3] = {0, -5.0 / 9, -153.0 / 128}, B[3] = {1.0 / 3, 15.0 / 16, 8.0 / 15};
    if (stage == 0)
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) k[i] = dt * f[i];
    else
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) k[i] = A[stage] * k[i] + dt * f[i];
    for (std::size_t i = lanes.begin; i < lanes.end; ++i) u[i] += B[stage] * k[i];
}

void advance(IntegrationScheme scheme, double* u, const double* k, double* u_n, double* sum, int stage, double dt,
             LaneRange lanes) {
    switch (scheme) {
        case IntegrationScheme::rk4:
            advance_rk4(u, k, u_n, sum, stage, dt, lanes);
            break;
        case IntegrationScheme::rk3:
            advance_rk3(u, k, sum, stage, dt, lanes);
            break;
        case IntegrationScheme::verlet:
            for (std::size_t i = lanes.begin; i < lanes.end; ++i) u[i] = u_n[i] + 0.5 * dt * k[i];
    }
}

// With mass exchange what is integrated is the momentum: v and dv/dt become m v and d(m v)/dt, or back.
template <int D>
void times_mass(Particles<D>& s, LaneRange lanes) {
    for (int d = 0; d < D; ++d)
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            s.v[d][i] *= s.mass[i];
            s.acceleration[d][i] *= s.mass[i];
        }
}
template <int D>
void over_mass(Particles<D>& s, LaneRange lanes) {
    for (int d = 0; d < D; ++d)
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            s.v[d][i] /= s.mass[i];
            s.acceleration[d][i] /= s.mass[i];
        }
}

}  // namespace

template <int D>
double TimeIntegration<D>::stage_time(int stage) const {
    constexpr double rk4[4] = {0, 0.5, 0.5, 1}, rk3[3] = {0, 1.0 / 3, 3.0 / 4};
    return scheme == IntegrationScheme::rk4 ? rk4[stage] : scheme == IntegrationScheme::rk3 ? rk3[stage] : 1.0;
}

template <int D>
void TimeIntegration<D>::resize(const Particles<D>& particles) {
    const std::size_t lanes = particles.clusters() * W;
    const auto fit = [&](Scalars& values) {
        if (lanes > values.capacity()) values.reserve(lanes + lanes / 4);
        values.resize(lanes);
    };
    const bool start = scheme != IntegrationScheme::rk3, sum = scheme != IntegrationScheme::verlet;
    if (start) fit(deviation_n);
    if (sum) fit(deviation_sum);
    if (particles.has_mass_exchange && start) fit(mass_n);
    if (particles.has_mass_exchange && sum) fit(mass_sum);
    for (int d = 0; d < D; ++d) {
        if (scheme == IntegrationScheme::rk4) fit(x_n[d]);
        if (start) fit(v_n[d]);
        if (sum) {
            fit(x_sum[d]);
            fit(v_sum[d]);
        }
    }
}

template <int D>
void update_state(Particles<D>& s, const Tait& tait, LaneRange lanes) {
    // Plain pointers and a Tait of its own: then the loop for water is one of vectors.
    double* const deviation = s.deviation.data();
    const double* const mass = s.mass.data();
    const double* const fullness = s.fullness.data();
    double* const pressure = s.p.data();
    double* const impedance = s.impedance.data();
    double* const volume = s.volume.data();
    // Where water bears no tension nothing would hold its density while it is stretched: spray would thin out without
    // end, and pull with all it lacks once its support fills up. Cavities open between particles there instead.
    constexpr double least_density = 0.9;  // over ρ0
    const auto update = [=](const Tait& own, std::size_t i) __attribute__((always_inline)) {
        const double least = (least_density - 1) * own.reference_density;
        deviation[i] = fullness[i] < fullness_of_interior ? std::max(deviation[i], least) : deviation[i];
        const double rho = own.reference_density + deviation[i];
        const double p = own.pressure(deviation[i]);
        pressure[i] = fullness[i] < fullness_of_interior ? std::max(p, 0.0) : p;
        impedance[i] = rho * own.sound_speed_at(deviation[i]);
        volume[i] = mass[i] / rho;
    };
    if (tait.exponent == 7) {
        const Tait water{tait.reference_density, tait.sound_speed};
#pragma omp simd
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) update(water, i);
    } else {
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) update(tait, i);
    }
}

template <int D>
void advance_stage(Particles<D>& s, TimeIntegration<D>& u, const Tait& tait, int stage, double dt, LaneRange lanes) {
    // Positions first: their rate is the velocity of this stage, which is overwritten next. A Verlet step has placed
    // them already.
    if (u.scheme != IntegrationScheme::verlet) {
        for (int d = 0; d < D; ++d) {
            double shifted[lanes_per_block];
            const double* rate = s.v[d].data() + lanes.begin;
            if (s.has_shift) {
                for (std::size_t k = 0; k < lanes.end - lanes.begin; ++k)
                    shifted[k] = rate[k] + s.shift[d][lanes.begin + k];
                rate = shifted;
            }
            advance(u.scheme, s.x[d].data() + lanes.begin, rate, u.x_n[d].data() + lanes.begin,
                    u.x_sum[d].data() + lanes.begin, stage, dt, {0, lanes.end - lanes.begin});
        }
    }
    if (s.has_mass_exchange) times_mass(s, lanes);
    for (int d = 0; d < D; ++d)
        advance(u.scheme, s.v[d].data(), s.acceleration[d].data(), u.v_n[d].data(), u.v_sum[d].data(), stage, dt,
                lanes);
    advance(u.scheme, s.deviation.data(), s.deviation_rate.data(), u.deviation_n.data(), u.deviation_sum.data(), stage,
            dt, lanes);
    if (s.has_mass_exchange) {
        advance(u.scheme, s.mass.data(), s.mass_rate.data(), u.mass_n.data(), u.mass_sum.data(), stage, dt, lanes);
        over_mass(s, lanes);
    }
    update_state(s, tait, lanes);
}

template <int D>
void predict(Particles<D>& s, TimeIntegration<D>& u, const Tait& tait, double dt, LaneRange lanes) {
    const auto extrapolate = [&](double* value, const double* rate, double* middle) {
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            middle[i] = value[i] + 0.5 * dt * rate[i];
            value[i] += dt * rate[i];
        }
    };
    for (int d = 0; d < D; ++d)
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            // d(m v)/dt/m is dv/dt and a part that only carries mass along.
            const double a =
                s.acceleration[d][i] - (s.has_mass_exchange ? s.v[d][i] * s.mass_rate[i] / s.mass[i] : 0.0);
            s.x[d][i] += dt * (s.v[d][i] + (s.has_shift ? s.shift[d][i] : 0.0) + 0.5 * dt * a);
        }
    if (s.has_mass_exchange) times_mass(s, lanes);
    for (int d = 0; d < D; ++d) extrapolate(s.v[d].data(), s.acceleration[d].data(), u.v_n[d].data());
    extrapolate(s.deviation.data(), s.deviation_rate.data(), u.deviation_n.data());
    if (s.has_mass_exchange) {
        extrapolate(s.mass.data(), s.mass_rate.data(), u.mass_n.data());
        over_mass(s, lanes);
    }
    update_state(s, tait, lanes);
}

template struct TimeIntegration<2>;
template struct TimeIntegration<3>;
template void update_state(Particles<2>&, const Tait&, LaneRange);
template void update_state(Particles<3>&, const Tait&, LaneRange);
template void advance_stage(Particles<2>&, TimeIntegration<2>&, const Tait&, int, double, LaneRange);
template void advance_stage(Particles<3>&, TimeIntegration<3>&, const Tait&, int, double, LaneRange);
template void predict(Particles<2>&, TimeIntegration<2>&, const Tait&, double, LaneRange);
template void predict(Particles<3>&, TimeIntegration<3>&, const Tait&, double, LaneRange);

}  // namespace aquagraph::fluid
