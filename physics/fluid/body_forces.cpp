#include "physics/fluid/body_forces.hpp"

namespace aquagraph::fluid {

template <int D>
void add_central_force(Particles<D>& s, const CentralForce<D>& force, LaneRange lanes) {
    const double rate_squared = force.rate * force.rate;
    for (std::size_t d = 0; d < D; ++d)
        for (std::size_t i = lanes.begin; i < lanes.end; ++i)
            s.acceleration[d][i] -= rate_squared * (s.x[d][i] - force.centre[d]);
}

template <int D>
void add_driving_force(Particles<D>& s, const std::array<double, D>& a, LaneRange lanes) {
    for (std::size_t d = 0; d < D; ++d)
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) s.acceleration[d][i] += a[d];
}

template <int D>
double potential_energy(const Particles<D>& s, const CentralForce<D>& force, LaneRange lanes) {
    double sum = 0;
    for (std::size_t d = 0; d < D; ++d)
        for (std::size_t i = lanes.begin; i < lanes.end; ++i) {
            const double distance = s.x[d][i] - force.centre[d];
            sum += s.mass[i] * distance * distance;
        }
    return 0.5 * force.rate * force.rate * sum;
}

template void add_central_force(Particles<2>&, const CentralForce<2>&, LaneRange);
template void add_central_force(Particles<3>&, const CentralForce<3>&, LaneRange);
template void add_driving_force<2>(Particles<2>&, const std::array<double, 2>&, LaneRange);
template void add_driving_force<3>(Particles<3>&, const std::array<double, 3>&, LaneRange);
template double potential_energy(const Particles<2>&, const CentralForce<2>&, LaneRange);
template double potential_energy(const Particles<3>&, const CentralForce<3>&, LaneRange);

}  // namespace aquagraph::fluid
