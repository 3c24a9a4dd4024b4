#include "physics/coupling/staggered_stability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace aquagraph::coupling {

double growth_per_cycle(const StaggeredScheme& scheme, double z, double omega_dt) {
    // In units of the step and of the mode's mass: x, v Δt, a Δt², then v of one and two exchanges ago and, for
    // quadratic extrapolation under CPS with HHT, three.
    using Row = Eigen::Matrix<double, 1, 6>;
    const Eigen::Matrix<double, 6, 6> unit = Eigen::Matrix<double, 6, 6>::Identity();
    const Row x = unit.row(0), v = unit.row(1), a = unit.row(2);
    const auto velocity = [&](int cycles_ago) -> Row { return unit.row(cycles_ago == 0 ? 1 : 2 + cycles_ago); };
    const auto of_wet_nodes = [&](int cycles_ago) -> Row {
        if (scheme.extrapolation != Extrapolation::quadratic) return velocity(cycles_ago);
        return 2 * velocity(cycles_ago) - velocity(cycles_ago + 1);
    };
    const auto& [beta, gamma, weight_new, weight_old] = scheme.newmark;
    const double k = omega_dt * omega_dt;
    const int delay = scheme.side_by_side ? 1 : 0;
    const Row f_new = -z * of_wet_nodes(delay), f_old = -z * of_wet_nodes(delay + 1);
    const Row predicted = x + v + (0.5 - beta) * a;
    const Row a_new = (weight_new * f_new + weight_old * f_old - weight_new * k * predicted - weight_old * k * x) /
                      (1 + weight_new * k * beta);
    Eigen::Matrix<double, 6, 6> map = Eigen::Matrix<double, 6, 6>::Zero();
    map.row(0) = predicted + beta * a_new;
    map.row(1) = v + (1 - gamma) * a + gamma * a_new;
    map.row(2) = a_new;
    map.row(3) = v;
    map.row(4) = unit.row(3);
    map.row(5) = unit.row(4);
    return map.eigenvalues().cwiseAbs().maxCoeff();
}

int largest_stable_ratio(const StaggeredScheme& scheme, std::span<const WetMode> modes, double impedance,
                         double fluid_step, int most) {
    constexpr int frequencies = 12;  // in each mode's band
    for (int p = 1; p <= most; ++p) {
        const double dt = p * fluid_step;
        for (const WetMode& mode : modes)
            for (int k = 0; k < frequencies; ++k) {
                const double omega =
                    mode.angular_frequency * std::pow(lowest_wet_frequency, double(k) / (frequencies - 1));
                if (growth_per_cycle(scheme, impedance * dt / mode.mass_per_area, omega * dt) > 1 + negligible_growth)
                    return p - 1;
            }
    }
    return most;
}

}  // namespace aquagraph::coupling
