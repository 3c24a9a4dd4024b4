// The flux pass of every scheme, kernel and Riemann solver against a double loop over the formulas as the papers print
// them; and what each scheme keeps.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/riemann.hpp"
#include "physics/fluid/schemes/ale_pair.hpp"
#include "tests/fluid/driver.hpp"
#include "tests/fluid/fixtures.hpp"

using namespace aquagraph;
using namespace aquagraph::fluid;
using namespace aquagraph::fluid::test;

namespace {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

template <int D>
Vector<D> at(const Vectors<D>& field, std::size_t i) {
    Vector<D> value;
    for (int d = 0; d < D; ++d) value[d] = field[static_cast<std::size_t>(d)][i];
    return value;
}

double limited(double a, double b) {
    if (a * b <= 0) return 0;
    return std::fabs(a) < std::fabs(b) ? a : b;
}

template <int D>
Particles<D> cloud(double spacing, bool exchange, Random& random) {
    std::array<int, D> cells;
    cells.fill(D == 2 ? 20 : 8);
    const auto points = lattice<D>(cells, spacing, 0.3, random);
    std::vector<Point<D>> ghosts;
    for (int k = 0; k < 40; ++k) {
        Point<D> x;
        for (double& component : x) component = 0.5 * cells[0] * spacing * (1 + 1.1 * random());
        ghosts.push_back(x);
    }
    Particles<D> made;
    made.has_mass_exchange = made.has_shift = exchange;
    made.resize(points.size(), ghosts.size());
    const Particles<D> plain = place<D>(points, spacing, ghosts);
    made.x = plain.x;
    made.v = plain.v;
    made.volume = plain.volume;
    made.impedance = plain.impedance;
    made.mass = plain.mass;
    made.id = plain.id;
    made.fullness = plain.fullness;
    disorder(made, spacing, random);
    if (exchange)
        each_lane(made, [&](std::size_t i) {
            for (auto& component : made.shift) component[i] = 0.3 * random();
        });
    return made;
}

// What i gets from j per own volume, without ∇W ω_j's magnitude: p along ∇W, the divergence, mass and momentum flux.
template <int D>
struct Exchange {
    Vector<D> force = Vector<D>::Zero();
    double dilation = 0, mass = 0;
};

template <int D>
Exchange<D> pair_of(const Particles<D>& s, const FluxParameters& parameters, const Tait& tait, double radius,
                    std::size_t i, std::size_t j, const Vector<D>& grad_W) {
    const Vector<D> x_ij = at<D>(s.x, j) - at<D>(s.x, i), v_i = at<D>(s.v, i), v_j = at<D>(s.v, j);
    const double r2 = x_ij.squaredNorm(), r = std::sqrt(r2), c0 = tait.sound_speed, rho_0 = tait.reference_density;
    const Vector<D> e = x_ij / r;
    Exchange<D> result;
    if (parameters.scheme == Scheme::delta_sph) {
        const double rho_jump = (s.p[j] - s.p[i]) / (c0 * c0),
                     slopes = (at<D>(s.grad_p, i) + at<D>(s.grad_p, j)).dot(x_ij) / (c0 * c0);
        const Vector<D> psi = parameters.delta * radius * c0 * (rho_jump - 0.5 * slopes) * x_ij / r2;
        const double Pi = parameters.alpha * radius * c0 * rho_0 / 2 * x_ij.dot(v_j - v_i) / r2;
        result.force = -(s.p[i] + s.p[j] - Pi) * grad_W;
        result.dilation = (v_j - v_i).dot(grad_W) - psi.dot(grad_W) / rho_0;
        return result;
    }
    if (parameters.scheme == Scheme::artificial_viscosity) {
        const double approach = x_ij.dot(v_j - v_i), Z_i = s.impedance[i], Z_j = s.impedance[j];
        const double Pi = approach < 0 ? -parameters.alpha * radius * 2 * Z_i * Z_j / (Z_i + Z_j) * approach /
                                             (r2 + 0.01 * radius * radius)
                                       : 0;
        result.force = -(s.p[i] + s.p[j] + Pi) * grad_W;
        result.dilation = (v_j - v_i).dot(grad_W);
        return result;
    }
    double p_L = s.p[i], p_R = s.p[j];
    Vector<D> v_L = v_i, v_R = v_j;
    if (parameters.muscl) {
        const double dp = p_R - p_L;
        p_L += 0.5 * limited(at<D>(s.grad_p, i).dot(x_ij), dp);
        p_R -= 0.5 * limited(at<D>(s.grad_p, j).dot(x_ij), dp);
        for (int d = 0; d < D; ++d) {
            const auto row = static_cast<std::size_t>(d);
            const double dv = v_j[d] - v_i[d];
            v_L[d] += 0.5 * limited(at<D>(s.grad_v[row], i).dot(x_ij), dv);
            v_R[d] -= 0.5 * limited(at<D>(s.grad_v[row], j).dot(x_ij), dv);
        }
    }
    const double u_L = v_L.dot(e), u_R = v_R.dot(e), Z_L = s.impedance[i], Z_R = s.impedance[j];
    InterfaceState state = acoustic_riemann(u_L, p_L, Z_L, u_R, p_R, Z_R);
    if (parameters.solver == RiemannSolver::exact) state = exact_riemann(tait, u_L, p_L, u_R, p_R);
    if (parameters.solver == RiemannSolver::low_dissipation) {
        const double c = 0.5 * (Z_L + Z_R) / rho_0, beta = std::min(3 * std::max(u_L - u_R, 0.0) / c, 1.0);
        state.pressure = (Z_R * p_L + Z_L * p_R + Z_L * Z_R * (u_L - u_R) * beta) / (Z_L + Z_R);
    }
    if (parameters.scheme == Scheme::riemann) {
        result.force = -2 * state.pressure * grad_W;
        result.dilation = 2 * (state.velocity - v_i.dot(e)) * e.dot(grad_W);
        return result;
    }
    const Vector<D> v0_i = v_i + at<D>(s.shift, i), v0_j = v_j + at<D>(s.shift, j);
    double u0 = 0.5 * (v0_i + v0_j).dot(e);
    if (j >= s.ghost_begin()) u0 = state.velocity;  // a wall
    const double flow = state.velocity - u0,
                 rho_e = DensitySeries(tait)(state.pressure);  // tests/fluid/riemann.cpp has its error
    const Vector<D> from = flow > 0 ? v_L : v_R, v_e = from + (state.velocity - from.dot(e)) * e;
    const double along = e.dot(grad_W);
    result.dilation = 2 * (u0 - v0_i.dot(e)) * along;
    result.mass = -2 * rho_e * flow * along;
    result.force = -2 * (rho_e * v_e * flow * along + state.pressure * grad_W);
    return result;
}

template <int D>
void check_twin(const FluxParameters& parameters, KernelName kernel_name) {
    CAPTURE(D);
    CAPTURE(static_cast<int>(parameters.scheme));
    CAPTURE(static_cast<int>(parameters.solver));
    CAPTURE(parameters.muscl);
    CAPTURE(static_cast<int>(kernel_name));
    const double spacing = 0.05, radius = 3.1 * spacing;
    const bool ale = parameters.scheme == Scheme::riemann_ale;
    Random random(5);
    const Kernel<D> kernel(kernel_name, radius);
    Particles<D> s = cloud<D>(spacing, ale, random);
    const auto lists = lists_of<D>(s, radius, 0.25 * radius);
    for (std::size_t block = 0; block < s.blocks(); ++block)
        compute_fluxes<D>(s, lists, kernel, parameters, water, lanes_of_block(s, block));

    double error = 0;
    for (std::size_t i = 0; i < s.count; ++i) {
        Exchange<D> sum;
        double scale_force = 0, scale_dilation = 0, scale_mass = 0;
        each_lane(s, [&](std::size_t j) {
            const double r = distance(s, i, j);
            if (j == i || r >= radius) return;
            const Vector<D> grad_W = kernel.derivative(r) / r * (at<D>(s.x, i) - at<D>(s.x, j)) * s.volume[j];
            const auto part = pair_of<D>(s, parameters, water, radius, i, j, grad_W);
            sum.force += part.force;
            sum.dilation += part.dilation;
            sum.mass += part.mass;
            scale_force += part.force.norm();
            scale_dilation += 5 * grad_W.norm();
            scale_mass += std::fabs(part.mass);
        });
        if (scale_force == 0) continue;
        const double rho_i = water.reference_density + s.deviation[i];
        Vector<D> acceleration = s.volume[i] / s.mass[i] * sum.force;
        for (int d = 0; d < D; ++d) acceleration[d] += parameters.gravity[d];
        error =
            std::max(error, (at<D>(s.acceleration, i) - acceleration).norm() / (s.volume[i] / s.mass[i] * scale_force));
        error = std::max(error, std::fabs(s.deviation_rate[i] - (sum.mass - rho_i * sum.dilation)) /
                                    (rho_i * scale_dilation + scale_mass));
        if (ale)
            error = std::max(error, std::fabs(s.mass_rate[i] - s.volume[i] * sum.mass) / (s.volume[i] * scale_mass));
    }
    CHECK(error < 1e-12);
}

}  // namespace

TEST_CASE("every scheme's fluxes are those of a double loop over its formulas") {
    for (const KernelName kernel : {KernelName::wendland_c2, KernelName::cubic_spline}) {
        for (const Scheme scheme : {Scheme::riemann, Scheme::riemann_ale})
            for (const bool muscl : {false, true})
                for (const RiemannSolver solver :
                     {RiemannSolver::acoustic, RiemannSolver::low_dissipation, RiemannSolver::exact}) {
                    const FluxParameters parameters{
                        .muscl = muscl, .scheme = scheme, .solver = solver, .gravity = {0.3, -9.81, 2}};
                    check_twin<2>(parameters, kernel);
                    check_twin<3>(parameters, kernel);
                }
        for (const Scheme scheme : {Scheme::delta_sph, Scheme::artificial_viscosity}) {
            const FluxParameters parameters{.scheme = scheme, .delta = 0.13, .alpha = 0.07, .gravity = {0.3, -9.81, 2}};
            check_twin<2>(parameters, kernel);
            check_twin<3>(parameters, kernel);
        }
    }
}

TEST_CASE("every scheme and integration keeps mass and momentum of free water, also with mass exchange and shifting") {
    for (const Scheme scheme : {Scheme::riemann, Scheme::riemann_ale, Scheme::delta_sph, Scheme::artificial_viscosity})
        for (const IntegrationScheme integration :
             {IntegrationScheme::rk4, IntegrationScheme::rk3, IntegrationScheme::verlet})
            for (const Transport transport : {Transport::none, Transport::x_sph, Transport::shifting}) {
                if (transport == Transport::shifting && scheme != Scheme::riemann_ale) continue;
                CAPTURE(static_cast<int>(scheme));
                CAPTURE(static_cast<int>(integration));
                CAPTURE(static_cast<int>(transport));
                Fluid<2> fluid = make_fluid<2>(0.05, water, {.scheme = scheme, .alpha = 0.05});
                fluid.integration.scheme = integration;
                fluid.transport = transport;
                fluid.viscosity.dynamic = 0.5;
                fluid.cfl = integration == IntegrationScheme::verlet ? 0.1 : 0.25;
                fluid.prepare_particles();
                Random random(11);
                fill(fluid.particles, std::vector<FillBox<2>>{{{0, 0}, {1.0, 0.8}}}, fluid.spacing, water, 0,
                     std::nullopt);
                auto& s = fluid.particles;
                for (std::size_t i = 0; i < s.count; ++i) {
                    s.v[0][i] = s.x[0][i] < 0.5 ? 1 : -0.5;
                    s.v[1][i] = s.x[0][i] + 0.2 * random();
                }
                Driver<2> driver(std::move(fluid));
                const auto totals = [&] {
                    Vector<2> momentum = Vector<2>::Zero();
                    double mass = 0, magnitude = 0;
                    const auto& p = driver.fluid.particles;
                    for (std::size_t i = 0; i < p.count; ++i) {
                        mass += p.mass[i];
                        momentum += p.mass[i] * at<2>(p.v, i);
                        magnitude += p.mass[i] * at<2>(p.v, i).norm();
                    }
                    return std::tuple(mass, momentum, magnitude);
                };
                const auto [mass, momentum, magnitude] = totals();
                driver.start();
                for (int step = 0; step < 40; ++step) driver.step(driver.largest_step());
                const auto [mass_after, momentum_after, ignored] = totals();
                CHECK(std::fabs(mass_after - mass) < 1e-13 * mass);
                CHECK((momentum_after - momentum).norm() < 1e-12 * magnitude);
                if (scheme == Scheme::riemann_ale) {  // and they do exchange
                    double largest = 0;
                    for (std::size_t i = 0; i < driver.fluid.particles.count; ++i)
                        largest = std::max(largest, std::fabs(driver.fluid.particles.mass[i] / mass * 320 - 1));
                    CHECK(largest > 1e-4);
                }
            }
}
