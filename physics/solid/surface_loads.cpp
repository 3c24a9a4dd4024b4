#include "physics/solid/surface_loads.hpp"

namespace aquagraph::solid {

template <int D>
SurfaceLoads<D>::SurfaceLoads(const Mesh<D>& mesh, const Options<D>& options) {
    for (const Pressure& pressure : options.pressures)
        pressures_.push_back({pressure.pressure, {mesh, pressure.surface, options.thickness}});
}

template <int D>
std::size_t SurfaceLoads<D>::matrix_size() const {
    std::size_t size = 0;
    for (const Following& load : pressures_) size += load.facets.matrix_size();
    return size;
}

template <int D>
void SurfaceLoads<D>::add_forces(double t, std::span<const double> u, std::span<double> nodal, BlockLoop loop) {
    for (Following& load : pressures_) {
        const double p = load.pressure.at(t).value;
        load.facets.for_each(loop, [&](std::size_t k) {
            const auto x = load.facets.positions(k, u);
            auto& f = load.facets.forces(k);
            f = {};
            for (const FacetPoint& point : load.facets.rule(k)) {
                const auto normal = load.facets.area_normal(point, x);
                for (std::size_t a = 0; a < load.facets[k].size(); ++a)
                    for (std::size_t i = 0; i < D; ++i) f[a][i] -= p * point.weight * point.N[a] * normal[i];
            }
        });
        load.facets.add_forces(1, nodal);
    }
}

// ∂(n da)/∂x_b: D = 2: dN_b (δ_y, -δ_x);  D = 3: dN_b,1 δ × g_2 + g_1 × dN_b,2 δ.
template <int D>
void SurfaceLoads<D>::tangents(double t, double factor, std::span<const double> u, std::span<double> matrices,
                               BlockLoop loop) const {
    for (const Following& load : pressures_) {
        const SurfaceFacets<D>& facets = load.facets;
        const double p = factor * load.pressure.at(t).value;
        facets.for_each(loop, [&](std::size_t k) {
            const auto x = facets.positions(k, u);
            const std::size_t rows = D * facets[k].size();
            double K[D * most_facet_nodes][D * most_facet_nodes] = {};
            for (const FacetPoint& point : facets.rule(k)) {
                const auto g = SurfaceFacets<D>::along(point, x, 0), h = SurfaceFacets<D>::along(point, x, 1);
                for (std::size_t b = 0; b < facets[k].size(); ++b) {
                    double S[D][D] = {};  // ∂(n da)_i/∂x_bj
                    if constexpr (D == 2) {
                        S[0][1] = facets.thickness() * point.dN[b][0];
                        S[1][0] = -facets.thickness() * point.dN[b][0];
                    } else {
                        for (std::size_t i = 0; i < 3; ++i) {
                            const std::size_t j = (i + 1) % 3, m = (i + 2) % 3;
                            // (g × v)_i = g_j v_m - g_m v_j
                            S[i][m] = point.dN[b][1] * g[j] - point.dN[b][0] * h[j];
                            S[i][j] = -point.dN[b][1] * g[m] + point.dN[b][0] * h[m];
                        }
                    }
                    for (std::size_t a = 0; a < facets[k].size(); ++a)
                        for (std::size_t i = 0; i < D; ++i)
                            for (std::size_t j = 0; j < D; ++j)
                                K[D * a + i][D * b + j] += p * point.weight * point.N[a] * S[i][j];
                }
            }
            double* out = &matrices[facets.first_matrix(k)];
            for (std::size_t r = 0; r < rows; ++r)
                for (std::size_t c = 0; c <= r; ++c) *out++ = 0.5 * (K[r][c] + K[c][r]);
        });
        matrices = matrices.subspan(facets.matrix_size());
    }
}

template class SurfaceLoads<2>;
template class SurfaceLoads<3>;

}  // namespace aquagraph::solid
