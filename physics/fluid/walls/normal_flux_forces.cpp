// What walls do to the fluid and the fluid to them, beside the fluxes of a substep.
#include <cmath>

#include "physics/fluid/walls/wall_flux.hpp"

namespace aquagraph::fluid {

template <int D>
void NormalFluxWalls<D>::add_shear(Particles<D>& s, const Kernel<D>& kernel, double viscosity, double spacing,
                                   std::size_t block) const {
    const NearBlock& b = near_[block];
    for (std::size_t k = 0; k < b.near.size(); ++k) {
        const std::size_t i = b.near[k].particle;
        Vec<D> x, v, sum = Vec<D>::Zero();
        for (int d = 0; d < D; ++d) {
            x[d] = s.x[std::size_t(d)][i];
            v[d] = s.v[std::size_t(d)][i];
        }
        const Range range = points_of(b, k);
        for (std::size_t q = range.begin; q < range.end; ++q) {
            const std::size_t point = b.point[q];
            if (point == points.size()) continue;
            const auto panel = std::size_t(points.cell[point].panel);
            if (!panels.panels[panel].no_slip) continue;
            const Vec<D> dx = points.place(point) - x, &n = panels.normal[panel];
            Vec<D> slip = v;
            for (int d = 0; d < D; ++d) slip[d] -= points.velocity[std::size_t(d)][point];
            slip -= slip.dot(n) * n;
            const double h = std::max(-dx.dot(n), 0.5 * spacing);
            sum += 2 * viscosity / h * kernel.value(dx.norm()) * points.area[point] * slip;
        }
        for (int d = 0; d < D; ++d) s.acceleration[std::size_t(d)][i] -= s.volume[i] / s.mass[i] * sum[d];
    }
}

template <int D>
void NormalFluxWalls<D>::add_to_vertices(std::size_t point, const Vec<D>& force,
                                         std::vector<Vec<D>>& vertex_forces) const {
    const auto& cell = points.cell[point];
    for (std::size_t a = 0; a < D; ++a)
        vertex_forces[std::size_t(panels.panels[std::size_t(cell.panel)].vertex[a])] += cell.centre[a] * force;
}

template <int D>
void NormalFluxWalls<D>::add_reactions(const Particles<D>& s, const Kernel<D>& kernel,
                                       const FluxParameters& parameters, std::vector<Vec<D>>& vertex_forces) const {
    const PointFields<D> fields(points);
    for (const NearBlock& b : near_)
        for (std::size_t k = 0; k < b.near.size(); ++k) {
            const std::size_t i = b.near[k].particle;
            Vec<D> rest;
            for (int d = 0; d < D; ++d) rest[d] = -b.reaction[k * D + std::size_t(d)];
            const WallFlux<D> own(s, i, parameters, WallPressure::riemann, s.volume[i] / s.mass[i]);
            const Range range = points_of(b, k);
            // First the pressure on each point, then the rest on all by weight.
            double weights = 0, weight = 0, p_s = 0, dilation = 0;
            for (std::size_t q = range.begin; q < range.end; ++q) {
                const std::size_t point = b.point[q];
                if (point == points.size()) continue;
                own(fields, point, kernel, weight, p_s, dilation);
                weights += weight;
                Vec<D> force;
                for (int d = 0; d < D; ++d) force[d] = s.volume[i] * (own.p + p_s) * weight * fields.n[d][point];
                rest -= force;
                add_to_vertices(point, force, vertex_forces);
            }
            if (weights == 0) {  // nothing but rounding
                add_to_vertices(b.point[range.begin], rest, vertex_forces);
                continue;
            }
            for (std::size_t q = range.begin; q < range.end; ++q) {
                const std::size_t point = b.point[q];
                if (point == points.size()) continue;
                own(fields, point, kernel, weight, p_s, dilation);
                add_to_vertices(point, weight / weights * rest, vertex_forces);
            }
        }
}

template <int D>
void NormalFluxWalls<D>::add_pressure_forces(const Particles<D>& s, const Kernel<D>& kernel,
                                             const FluxParameters& parameters, std::vector<Vec<D>>& vertex_forces) {
    const PointFields<D> fields(points);
    wall_pressure_.assign(points.size(), 0.0);
    wetness_.assign(points.size(), 0.0);
    for (const NearBlock& b : near_)
        for (std::size_t k = 0; k < b.near.size(); ++k) {
            const std::size_t i = b.near[k].particle;
            WallFlux<D> own(s, i, parameters, pressure, s.volume[i] / s.mass[i]);
            const Range range = points_of(b, k);
            own.lower_impedance(fields, &b.point[range.begin], range.end - range.begin, kernel, gamma_[i]);
            for (std::size_t q = range.begin; q < range.end; ++q) {
                const std::size_t point = b.point[q];
                if (point == points.size()) continue;
                double weight, p_s, dilation;
                own(fields, point, kernel, weight, p_s, dilation);
                const double share = kernel.value((points.place(point) - place(s, i)).norm()) * s.volume[i];
                wall_pressure_[point] += share * p_s;
                wetness_[point] += share;
            }
        }
    for (std::size_t point = 0; point < points.size(); ++point) {
        if (wetness_[point] == 0) continue;
        Vec<D> force;
        for (int d = 0; d < D; ++d)
            force[d] = wall_pressure_[point] / std::max(wetness_[point], least_wetness) * fields.area[point] *
                       fields.n[d][point];
        add_to_vertices(point, force, vertex_forces);
    }
}

template void NormalFluxWalls<2>::add_to_vertices(std::size_t, const Vec<2>&, std::vector<Vec<2>>&) const;
template void NormalFluxWalls<3>::add_to_vertices(std::size_t, const Vec<3>&, std::vector<Vec<3>>&) const;
template void NormalFluxWalls<2>::add_shear(Particles<2>&, const Kernel<2>&, double, double, std::size_t) const;
template void NormalFluxWalls<3>::add_shear(Particles<3>&, const Kernel<3>&, double, double, std::size_t) const;
template void NormalFluxWalls<2>::add_reactions(const Particles<2>&, const Kernel<2>&, const FluxParameters&,
                                                std::vector<Vec<2>>&) const;
template void NormalFluxWalls<3>::add_reactions(const Particles<3>&, const Kernel<3>&, const FluxParameters&,
                                                std::vector<Vec<3>>&) const;
template void NormalFluxWalls<2>::add_pressure_forces(const Particles<2>&, const Kernel<2>&, const FluxParameters&,
                                                      std::vector<Vec<2>>&);
template void NormalFluxWalls<3>::add_pressure_forces(const Particles<3>&, const Kernel<3>&, const FluxParameters&,
                                                      std::vector<Vec<3>>&);

}  // namespace aquagraph::fluid
