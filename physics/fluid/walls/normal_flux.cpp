#include "physics/fluid/walls/normal_flux.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "physics/fluid/gradients.hpp"
#include "physics/fluid/pair_loop.hpp"
#include "physics/fluid/walls/wall_flux.hpp"

namespace aquagraph::fluid {

namespace {

// Σ_j W ω, Σ_j ∇W ω, Σ_j ∇W ⊗ x_ij ω, Σ_j (φ_j - φ_i) ∇W ω of one particle.
template <int D, class Kernel>
struct MomentPass {
    static constexpr int fields = D + 1;  // p and v
    Kernel kernel;
    const double* x[D] = {};
    const double* field[fields] = {};
    const double* volume = nullptr;
    struct Result {
        double shepard, G[D], M[D][D], f[fields][D];
    };
    Result* result = nullptr;

    struct Own {
        double x[D], field[fields];
    };
    struct Sum {
        double shepard[W], G[D][W], M[D][D][W], f[fields][D][W];
    };
    Own load(std::size_t i) const {
        Own own;
        for (int d = 0; d < D; ++d) own.x[d] = x[d][i];
        for (int k = 0; k < fields; ++k) own.field[k] = field[k][i];
        return own;
    }
    [[gnu::always_inline]] void pair(const Own& i, std::size_t j, double seen, Sum& sum, std::size_t l) const {
        double dx[D], r2 = 0;
        for (int d = 0; d < D; ++d) {
            dx[d] = x[d][j] - i.x[d];
            r2 += dx[d] * dx[d];
        }
        const double r = std::sqrt(r2), volume_seen = volume[j] * seen;
        const double w = kernel.slope(r * kernel.inverse_radius()) * volume_seen;
        sum.shepard[l] += r2 > 0 ? kernel.value(r) * volume_seen : 0.0;  // its own is not always listed
        for (int a = 0; a < D; ++a) {
            const double wa = w * dx[a];
            sum.G[a][l] += wa;
            for (int b = 0; b < D; ++b) sum.M[a][b][l] += wa * dx[b];
            for (int k = 0; k < fields; ++k) sum.f[k][a][l] += wa * (field[k][j] - i.field[k]);
        }
    }
    void store(std::size_t, const Own&, const Sum& sum) const {
        result->shepard = add_lanes(sum.shepard);
        for (int a = 0; a < D; ++a) {
            result->G[a] = add_lanes(sum.G[a]);
            for (int b = 0; b < D; ++b) result->M[a][b] = add_lanes(sum.M[a][b]);
            for (int k = 0; k < fields; ++k) result->f[k][a] = add_lanes(sum.f[k][a]);
        }
    }
};

// Σ_s n W A, Σ_s n ⊗ x_is W A
template <int D>
struct WallMoments {
    Vec<D> zeroth;
    Mat<D> first;
};

template <int D, class Kernel>
WallMoments<D> wall_moments(const PointFields<D>& s, const std::uint32_t* list, std::size_t n, const double (&x)[D],
                            const Kernel& kernel) {
    double N[D][W] = {}, N1[D][D][W] = {};
    for (std::size_t begin = 0; begin < n; begin += W) {
#pragma omp simd
        for (std::size_t l = 0; l < W; ++l) {
            const std::size_t k = list[begin + l];
            double dx[D], r2 = 0;
            for (int d = 0; d < D; ++d) {
                dx[d] = s.x[d][k] - x[d];
                r2 += dx[d] * dx[d];
            }
            const double w = kernel.value(std::sqrt(r2)) * s.area[k];
            for (int a = 0; a < D; ++a) {
                N[a][l] += w * s.n[a][k];
                for (int b = 0; b < D; ++b) N1[a][b][l] += w * s.n[a][k] * dx[b];
            }
        }
    }
    WallMoments<D> sum;
    for (int a = 0; a < D; ++a) {
        sum.zeroth[a] = add_lanes(N[a]);
        for (int b = 0; b < D; ++b) sum.first(a, b) = add_lanes(N1[a][b]);
    }
    return sum;
}

template <int D>
double smallest_eigenvalue(const Mat<D>& m, Mat<D>& inverse) {
    double packed[D * (D + 1) / 2];
    for (int a = 0, k = 0; a < D; ++a)
        for (int b = a; b < D; ++b, ++k) packed[k] = 0.5 * (m(a, b) + m(b, a));
    const double smallest = invert_moment<D>(packed, fullness_to_reconstruct);
    for (int a = 0, k = 0; a < D; ++a)
        for (int b = a; b < D; ++b, ++k) inverse(a, b) = inverse(b, a) = packed[k];
    return smallest;
}

constexpr double tolerated_in_shadow = 0.6;
constexpr double tolerated_disorder = 0.15;  // of |Σ n W A|

}  // namespace

template <int D>
void NormalFluxWalls<D>::compute_gamma(const Particles<D>& particles, const Kernel<D>& kernel, std::size_t block) {
    NearBlock& b = near_[block];
    const KernelMass<D> mass(kernel);
    b.floored = 0;
    for (std::size_t k = 0; k < b.near.size(); ++k) {
        const std::size_t i = b.near[k].particle;
        Vec<D> x;
        for (int d = 0; d < D; ++d) x[d] = particles.x[std::size_t(d)][i];
        const Range pieces = pieces_of(b, k);
        double missing = 0;
        for (std::size_t p = pieces.begin; p < pieces.end; ++p) {
            const std::int32_t piece = b.piece[p];
            const std::size_t panel = panel_of(piece);
            std::array<Vec<D>, D> corner;
            for (std::size_t a = 0; a < D; ++a)
                corner[a] = (piece >= 0 ? panels.vertex(panel, a) : points.vertex(panels, std::size_t(~piece), a)) - x;
            missing += missing_mass(mass, corner, panels.normal[panel]);
        }
        if (1 - missing < least_gamma) ++b.floored;
        gamma_[i] = std::max(1 - missing, least_gamma);
    }
}

template <int D>
void NormalFluxWalls<D>::complete_gradients(Particles<D>& s, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                                            const FluxParameters& parameters, std::size_t block) {
    kernel.visit([&](const auto& k) { complete_with(s, lists, k, parameters, block); });
}

template <int D>
template <class K>
void NormalFluxWalls<D>::complete_with(Particles<D>& s, const NeighbourLists<D>& lists, const K& kernel,
                                       const FluxParameters& parameters, std::size_t block) {
    NearBlock& b = near_[block];
    const PointFields<D> fields(points);
    typename MomentPass<D, K>::Result sum;
    MomentPass<D, K> pass{.kernel = kernel};
    pass.volume = s.volume.data();
    pass.field[0] = s.p.data();
    for (int d = 0; d < D; ++d) {
        pass.x[d] = s.x[d].data();
        pass.field[d + 1] = s.v[d].data();
    }
    pass.result = &sum;
    for (std::size_t k = 0; k < b.near.size(); ++k) {
        const std::size_t i = b.near[k].particle;
        pair_loop<D>(lists, {i, i + 1}, pass);
        double x[D];
        for (int d = 0; d < D; ++d) x[d] = s.x[d][i];
        const Range range = points_of(b, k);
        const WallMoments<D> wall = wall_moments<D>(fields, &b.point[range.begin], range.end - range.begin, x, kernel);

        Mat<D> M, B;
        Vec<D> C0;
        for (int a = 0; a < D; ++a) {
            C0[a] = sum.G[a] + wall.zeroth[a];
            for (int c = 0; c < D; ++c) M(a, c) = sum.M[a][c];
        }
        const Mat<D> missing = (1 - gamma_[i]) * Mat<D>::Identity() + 0.5 * (wall.first + wall.first.transpose());
        const Mat<D> C1 = M + wall.first - gamma_[i] * Mat<D>::Identity();
        Mat<D> completed;
        const double own = smallest_eigenvalue<D>(M, B), full = smallest_eigenvalue<D>(M + missing, completed);
        // Past the end of a wall the moment of the shadow is not known, but the kernel's mass is.
        const double filled =
            b.near[k].shadowed ? std::max(full, (sum.shepard + kernel.value(0) * s.volume[i]) / gamma_[i]) : full;
        s.fullness[i] = filled;
        // The gradient behind the wall: hydrostatic, and none of the velocity.
        Vec<D> weight;
        for (int d = 0; d < D; ++d) weight[d] = s.mass[i] / s.volume[i] * parameters.gravity[d];
        for (int f = 0; f <= D; ++f) {
            Vec<D> raw;
            for (int a = 0; a < D; ++a) raw[a] = sum.f[f][a];
            Vec<D> gradient = Vec<D>::Zero();
            if (own > fullness_to_reconstruct)
                gradient = B * raw;
            else if (full > fullness_to_reconstruct)
                gradient = completed * (f == 0 ? Vec<D>(raw + missing * weight) : raw);
            for (int a = 0; a < D; ++a) (f == 0 ? s.grad_p[a] : s.grad_v[std::size_t(f - 1)][a])[i] = gradient[a];
        }

        const double open = fade(filled) * std::min(1.0, (1 - gamma_[i]) / 1e-3);  // and ends where walls do
        const double tolerated = (b.near[k].shadowed ? tolerated_in_shadow : tolerated_disorder) *
                                 std::sqrt(wall.zeroth.norm() * (1.5 / kernel.radius()));
        const double disorder = C0.norm();
        if (disorder > tolerated) C0 *= tolerated / disorder;
        for (int a = 0; a < D; ++a) {
            b.C0[k * D + std::size_t(a)] = open * C0[a];
            b.normals[k * D + std::size_t(a)] = wall.zeroth[a];
            for (int c = 0; c < D; ++c) b.C1[(k * D + std::size_t(a)) * D + std::size_t(c)] = open * C1(a, c);
        }
    }
}

template <int D>
void NormalFluxWalls<D>::add_fluxes(Particles<D>& s, const Kernel<D>& kernel, const FluxParameters& parameters,
                                    double reference_density, std::size_t block) {
    kernel.visit([&](const auto& k) { add_fluxes_with(s, k, parameters, reference_density, block); });
}

template <int D>
template <class K>
void NormalFluxWalls<D>::add_fluxes_with(Particles<D>& s, const K& kernel, const FluxParameters& parameters,
                                         double reference_density, std::size_t block) {
    NearBlock& b = near_[block];
    const PointFields<D> fields(points);
    for (std::size_t k = 0; k < b.near.size(); ++k) {
        const std::size_t i = b.near[k].particle;
        const double gamma = gamma_[i], rho = reference_density + s.deviation[i], inverse_rho = s.volume[i] / s.mass[i];
        WallFlux<D> own(s, i, parameters, inverse_rho);
        const Range range = points_of(b, k);
        const std::uint32_t* const list = &b.point[range.begin];
        const std::size_t n = range.end - range.begin;
        own.lower_impedance(fields, list, n, kernel, gamma);
        double force[D][W] = {}, dilation[W] = {};
        for (std::size_t begin = 0; begin < n; begin += W) {
#pragma omp simd
            for (std::size_t l = 0; l < W; ++l) {
                const std::size_t j = list[begin + l];
                double weight, p_s, dilation_s;
                own(fields, j, kernel, weight, p_s, dilation_s);
                for (int d = 0; d < D; ++d) force[d][l] -= weight * (own.p + p_s) * fields.n[d][j];
                dilation[l] += dilation_s;
            }
        }
        double rate = -s.deviation_rate[i] / rho + add_lanes(dilation);  // the bracket of dρ/dt
        for (int a = 0; a < D; ++a)
            for (int c = 0; c < D; ++c)
                rate -=
                    b.C1[(k * D + std::size_t(a)) * D + std::size_t(c)] * s.grad_v[std::size_t(a)][std::size_t(c)][i];
        const double gain = s.has_mass_exchange ? s.mass_rate[i] / s.mass[i] : 0.0;  // of mass, which no γ divides
        if (s.has_mass_exchange)
            for (int a = 0; a < D; ++a) rate -= 2 * s.shift[a][i] * b.normals[k * D + std::size_t(a)];
        s.deviation_rate[i] = -rho * rate / gamma;
        for (int a = 0; a < D; ++a) {
            const double carried = gain * s.v[a][i];
            double correction = 2 * s.p[i] * b.C0[k * D + std::size_t(a)];
            for (int c = 0; c < D; ++c)
                correction += b.C1[(k * D + std::size_t(a)) * D + std::size_t(c)] * s.grad_p[std::size_t(c)][i];
            const double pairs = s.acceleration[a][i] - parameters.gravity[a] - carried;
            const double all = (pairs + inverse_rho * (add_lanes(force[a]) + correction)) / gamma;
            s.acceleration[a][i] = parameters.gravity[a] + all + carried;
            b.reaction[k * D + std::size_t(a)] = s.mass[i] * (all - pairs) + b.friction[k * D + std::size_t(a)];
        }
    }
}

template <int D>
void NormalFluxWalls<D>::complete_crowding(FreeSurface<D>& surface, std::size_t block) const {
    const NearBlock& b = near_[block];
    for (std::size_t k = 0; k < b.near.size(); ++k)
        for (std::size_t d = 0; d < D; ++d) {
            double& crowding = surface.crowding[d][b.near[k].particle];
            crowding = (crowding + b.normals[k * D + d]) / gamma_[b.near[k].particle];
        }
}

template void NormalFluxWalls<2>::complete_crowding(FreeSurface<2>&, std::size_t) const;
template void NormalFluxWalls<3>::complete_crowding(FreeSurface<3>&, std::size_t) const;
template void NormalFluxWalls<2>::compute_gamma(const Particles<2>&, const Kernel<2>&, std::size_t);
template void NormalFluxWalls<3>::compute_gamma(const Particles<3>&, const Kernel<3>&, std::size_t);
template void NormalFluxWalls<2>::complete_gradients(Particles<2>&, const NeighbourLists<2>&, const Kernel<2>&,
                                                     const FluxParameters&, std::size_t);
template void NormalFluxWalls<3>::complete_gradients(Particles<3>&, const NeighbourLists<3>&, const Kernel<3>&,
                                                     const FluxParameters&, std::size_t);
template void NormalFluxWalls<2>::add_fluxes(Particles<2>&, const Kernel<2>&, const FluxParameters&, double,
                                             std::size_t);
template void NormalFluxWalls<3>::add_fluxes(Particles<3>&, const Kernel<3>&, const FluxParameters&, double,
                                             std::size_t);

}  // namespace aquagraph::fluid
