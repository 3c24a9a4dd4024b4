#include "physics/fluid/filling.hpp"

#include <cmath>

#include "physics/fluid/runge_kutta.hpp"

namespace aquagraph::fluid {

namespace {
// Cells along one edge; an edge that is a whole number of cells but for rounding counts whole.
std::size_t cells(double length, double spacing) {
    return std::size_t(std::floor(length / spacing * (1 + 1e-9) + 1e-9));
}
}  // namespace

double hydrostatic_deviation(const Tait& tait, double gravity, double depth) {
    if (depth <= 0) return 0;
    const double head = (tait.exponent - 1) * gravity * depth / (tait.sound_speed * tait.sound_speed);
    return tait.reference_density * std::expm1(std::log1p(head) / (tait.exponent - 1));
}

template <int D>
std::size_t particles_in(const FillBox<D>& box, double spacing) {
    std::size_t n = 1;
    for (std::size_t d = 0; d < D; ++d) n *= cells(box.max[d] - box.min[d], spacing);
    return n;
}

template <int D>
void fill(Particles<D>& particles, const std::vector<FillBox<D>>& boxes, double spacing, const Tait& tait,
          double gravity, std::optional<double> surface_level) {
    std::size_t total = 0;
    for (const auto& box : boxes) total += particles_in(box, spacing);
    particles.resize(total, 0);
    const double cell = std::pow(spacing, D);
    std::size_t i = 0;
    for (const auto& box : boxes) {
        std::array<std::size_t, D> n;
        for (std::size_t d = 0; d < D; ++d) n[d] = cells(box.max[d] - box.min[d], spacing);
        for (std::size_t k = 0; k < particles_in(box, spacing); ++k, ++i) {
            std::size_t rest = k;
            for (std::size_t d = D; d-- > 0;) {
                particles.x[d][i] = box.min[d] + (double(rest % n[d]) + 0.5) * spacing;
                rest /= n[d];
                particles.v[d][i] = particles.acceleration[d][i] = 0;
                particles.x_built[d][i] = particles.x[d][i];
            }
            const double depth = surface_level ? *surface_level - particles.x[D - 1][i] : 0;
            particles.id[i] = std::int64_t(i);
            particles.deviation[i] = hydrostatic_deviation(tait, gravity, depth);
            particles.deviation_rate[i] = 0;
            particles.fullness[i] = 1;
            particles.mass[i] = (tait.reference_density + particles.deviation[i]) * cell;
        }
    }
    for (std::size_t block = 0; block < particles.blocks(); ++block)
        update_state(particles, tait, lanes_of_block(particles, block));
}

template std::size_t particles_in(const FillBox<2>&, double);
template std::size_t particles_in(const FillBox<3>&, double);
template void fill(Particles<2>&, const std::vector<FillBox<2>>&, double, const Tait&, double, std::optional<double>);
template void fill(Particles<3>&, const std::vector<FillBox<3>>&, double, const Tait&, double, std::optional<double>);

}  // namespace aquagraph::fluid
