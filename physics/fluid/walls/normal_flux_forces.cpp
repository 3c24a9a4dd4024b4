// What walls do to the fluid and the fluid to them, beside the fluxes of a substep.
#include <Eigen/Dense>
#include <cmath>

#include "physics/fluid/walls/wall_flux.hpp"

namespace aquagraph::fluid {

namespace {

// a with Σ_s W_is A_s (a·n_s) n_s = f, as far as the normals reach: across them walls bear nothing.
template <int D>
Vec<D> normal_part(const Mat<D>& normals, double weights, const Vec<D>& f) {
    constexpr double least_share = 0.02;  // of a direction
    Eigen::SelfAdjointEigenSolver<Mat<D>> directions;
    directions.computeDirect(normals);
    Vec<D> a = Vec<D>::Zero();
    for (int d = 0; d < D; ++d) {
        const double share = directions.eigenvalues()[d];
        const Vec<D> e = directions.eigenvectors().col(d);
        if (share > least_share * weights) a += e.dot(f) / share * e;
    }
    return a;
}

}  // namespace

template <int D>
Vec<D> NormalFluxWalls<D>::shear_rate(const Particles<D>& s, std::size_t i, std::size_t point, double spacing) const {
    const Vec<D>& n = panels.normal[std::size_t(points.cell[point].panel)];
    Vec<D> slip;
    for (int d = 0; d < D; ++d) slip[d] = s.v[std::size_t(d)][i] - points.velocity[std::size_t(d)][point];
    slip -= slip.dot(n) * n;
    return slip / std::max((place(s, i) - points.place(point)).dot(n), 0.5 * spacing);
}

template <int D>
void NormalFluxWalls<D>::add_shear(Particles<D>& s, const Kernel<D>& kernel, const Viscosity& viscosity, double spacing,
                                   std::size_t block) {
    kernel.visit([&](const auto& k) { add_shear_with(s, k, viscosity, spacing, block); });
}

template <int D>
template <class K>
void NormalFluxWalls<D>::add_shear_with(Particles<D>& s, const K& kernel, const Viscosity& viscosity, double spacing,
                                        std::size_t block) {
    NearBlock& b = near_[block];
    for (std::size_t k = 0; k < b.near.size(); ++k) {
        const std::size_t i = b.near[k].particle;
        const Vec<D> x = place(s, i);
        Vec<D> sum = Vec<D>::Zero();
        const Range range = points_of(b, k);
        for (std::size_t q = range.begin; q < range.end; ++q) {
            const std::size_t point = b.point[q];
            if (point == points.size() || !panels.panels[std::size_t(points.cell[point].panel)].no_slip) continue;
            sum += wall_friction<D>(kernel, viscosity, points.place(point) - x, points.outward(point),
                                    points.area[point], shear_rate(s, i, point, spacing));
        }
        for (int d = 0; d < D; ++d) {
            s.acceleration[std::size_t(d)][i] += s.volume[i] / s.mass[i] * sum[d];
            b.friction[k * D + std::size_t(d)] = s.volume[i] * sum[d];
        }
    }
}

template <int D>
void NormalFluxWalls<D>::add_to_vertices(std::size_t point, const Vec<D>& force,
                                         std::vector<Vec<D>>& vertex_forces) const {
    const auto& cell = points.cell[point];
    for (std::size_t a = 0; a < D; ++a) {
        auto vertex = std::size_t(panels.panels[std::size_t(cell.panel)].vertex[a]);
        const std::size_t originals = panels.position.size() - copied_.size();
        if (vertex >= originals) vertex = std::size_t(copied_[vertex - originals].from);
        vertex_forces[vertex] += cell.centre[a] * force;
    }
}

template <int D>
void NormalFluxWalls<D>::add_reactions(const Particles<D>& s, const Kernel<D>& kernel, const FluxParameters& parameters,
                                       std::vector<Vec<D>>& vertex_forces) const {
    kernel.visit([&](const auto& k) { add_reactions_with(s, k, parameters, vertex_forces); });
}

template <int D>
template <class K, class F>
void NormalFluxWalls<D>::each_reaction(const NearBlock& b, std::size_t k, const Particles<D>& s, const K& kernel,
                                       const FluxParameters& parameters, F&& f) const {
    const PointFields<D> fields(points);
    const std::size_t i = b.near[k].particle;
    Vec<D> rest;
    for (int d = 0; d < D; ++d) rest[d] = -b.reaction[k * D + std::size_t(d)];
    const WallFlux<D> own(s, i, parameters, s.volume[i] / s.mass[i]);
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
        f(point, force);
    }
    if (weights == 0) return f(b.point[range.begin], rest);  // nothing but rounding
    for (std::size_t q = range.begin; q < range.end; ++q) {
        const std::size_t point = b.point[q];
        if (point == points.size()) continue;
        own(fields, point, kernel, weight, p_s, dilation);
        f(point, Vec<D>(weight / weights * rest));
    }
}

template <int D>
template <class K>
void NormalFluxWalls<D>::add_reactions_with(const Particles<D>& s, const K& kernel, const FluxParameters& parameters,
                                            std::vector<Vec<D>>& vertex_forces) const {
    for (const NearBlock& b : near_)
        for (std::size_t k = 0; k < b.near.size(); ++k)
            each_reaction(b, k, s, kernel, parameters, [&](std::size_t point, const Vec<D>& force) {
                add_to_vertices(point, force, vertex_forces);
            });
}

template <int D>
void NormalFluxWalls<D>::add_powers(const NearBlock& b, std::size_t k, const Particles<D>& s, const Kernel<D>& kernel,
                                    const FluxParameters& parameters, std::span<double> of_wall) const {
    kernel.visit([&](const auto& w) {
        each_reaction(b, k, s, w, parameters, [&](std::size_t point, const Vec<D>& force) {
            double power = 0;
            for (int d = 0; d < D; ++d) power -= force[d] * points.velocity[std::size_t(d)][point];
            of_wall[std::size_t(panels.panels[std::size_t(points.cell[point].panel)].wall)] += power;
        });
    });
}

template <int D>
void NormalFluxWalls<D>::add_pressure_forces(const Particles<D>& s, const Kernel<D>& kernel,
                                             const FluxParameters& parameters, double viscosity,
                                             std::vector<Vec<D>>& vertex_forces) {
    kernel.visit([&](const auto& k) { add_pressure_forces_with(s, k, parameters, viscosity, vertex_forces); });
}

template <int D>
template <class K>
void NormalFluxWalls<D>::add_pressure_forces_with(const Particles<D>& s, const K& kernel,
                                                  const FluxParameters& parameters, double viscosity,
                                                  std::vector<Vec<D>>& vertex_forces) {
    const PointFields<D> fields(points);
    wall_pressure_.assign(points.size(), 0.0);
    wetness_.assign(points.size(), 0.0);
    shear_.assign(points.size(), Vec<D>::Zero());
    for (const NearBlock& b : near_)
        for (std::size_t k = 0; k < b.near.size(); ++k) {
            const std::size_t i = b.near[k].particle;
            WallFlux<D> own(s, i, parameters, s.volume[i] / s.mass[i]);
            const Range range = points_of(b, k);
            own.lower_impedance(fields, &b.point[range.begin], range.end - range.begin, kernel, gamma_[i]);
            own.impedance *= 0.5;  // below, p_s is then ½ (p_L + p_s)
            const double full = fade(s.fullness[i]);
            Mat<D> normals = Mat<D>::Zero();  // Σ_s n_s ⊗ n_s W_is A_s
            double weights = 0;
            for (std::size_t q = range.begin; q < range.end; ++q) {
                const std::size_t point = b.point[q];
                if (point == points.size()) continue;
                double weight, p_s, dilation;
                own(fields, point, kernel, weight, p_s, dilation);
                const double share = kernel.value((points.place(point) - place(s, i)).norm()) * s.volume[i];
                wall_pressure_[point] += share * full * p_s;
                wetness_[point] += share;
                if (viscosity > 0 && panels.panels[std::size_t(points.cell[point].panel)].no_slip)
                    shear_[point] += share * viscosity * shear_rate(s, i, point, spacing_);
                const Vec<D> n = points.outward(point);
                normals += weight * n * n.transpose();
                weights += weight;
            }
            if (full == 1 || weights == 0) continue;
            Vec<D> reaction;
            for (int d = 0; d < D; ++d) reaction[d] = -b.reaction[k * D + std::size_t(d)];
            const Vec<D> along = normal_part(normals, weights, reaction);
            for (std::size_t q = range.begin; q < range.end; ++q) {
                const std::size_t point = b.point[q];
                if (point == points.size()) continue;
                double weight, p_s, dilation;
                own(fields, point, kernel, weight, p_s, dilation);
                const Vec<D> n = points.outward(point);
                add_to_vertices(point, (1 - full) * weight * along.dot(n) * n, vertex_forces);
            }
        }
    // Across the seam of a periodic domain a point and its copies share one mean: each sees a part of the particles.
    const std::size_t originals =
        points.size() * (panels.size() - panels.copies) / std::max<std::size_t>(1, panels.size());
    for (std::size_t point = originals; point < points.size(); ++point) {
        wall_pressure_[point % originals] += wall_pressure_[point];
        wetness_[point % originals] += wetness_[point];
        shear_[point % originals] += shear_[point];
    }
    for (std::size_t point = 0; point < originals; ++point) {
        if (wetness_[point] == 0) continue;
        Vec<D> force = shear_[point];
        for (int d = 0; d < D; ++d) force[d] += wall_pressure_[point] * fields.n[d][point];
        force *= fields.area[point] / std::max(wetness_[point], least_wetness);
        add_to_vertices(point, force, vertex_forces);
    }
}

template void NormalFluxWalls<2>::add_powers(const NearBlock&, std::size_t, const Particles<2>&, const Kernel<2>&,
                                             const FluxParameters&, std::span<double>) const;
template void NormalFluxWalls<3>::add_powers(const NearBlock&, std::size_t, const Particles<3>&, const Kernel<3>&,
                                             const FluxParameters&, std::span<double>) const;
template Vec<2> NormalFluxWalls<2>::shear_rate(const Particles<2>&, std::size_t, std::size_t, double) const;
template Vec<3> NormalFluxWalls<3>::shear_rate(const Particles<3>&, std::size_t, std::size_t, double) const;
template void NormalFluxWalls<2>::add_to_vertices(std::size_t, const Vec<2>&, std::vector<Vec<2>>&) const;
template void NormalFluxWalls<3>::add_to_vertices(std::size_t, const Vec<3>&, std::vector<Vec<3>>&) const;
template void NormalFluxWalls<2>::add_shear(Particles<2>&, const Kernel<2>&, const Viscosity&, double, std::size_t);
template void NormalFluxWalls<3>::add_shear(Particles<3>&, const Kernel<3>&, const Viscosity&, double, std::size_t);
template void NormalFluxWalls<2>::add_reactions(const Particles<2>&, const Kernel<2>&, const FluxParameters&,
                                                std::vector<Vec<2>>&) const;
template void NormalFluxWalls<3>::add_reactions(const Particles<3>&, const Kernel<3>&, const FluxParameters&,
                                                std::vector<Vec<3>>&) const;
template void NormalFluxWalls<2>::add_pressure_forces(const Particles<2>&, const Kernel<2>&, const FluxParameters&,
                                                      double, std::vector<Vec<2>>&);
template void NormalFluxWalls<3>::add_pressure_forces(const Particles<3>&, const Kernel<3>&, const FluxParameters&,
                                                      double, std::vector<Vec<3>>&);

}  // namespace aquagraph::fluid
