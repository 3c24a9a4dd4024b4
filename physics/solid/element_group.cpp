#include "physics/solid/element_group.hpp"

#include <algorithm>
#include <stdexcept>

#include "physics/solid/materials/neo_hookean.hpp"
#include "physics/solid/materials/saint_venant_kirchhoff.hpp"

namespace aquagraph::solid {

namespace {

using Lane = std::array<double, lanes>;

struct PackPoint {                                                         // a Gauss point of a pack
    alignas(64) std::array<std::array<Lane, 2>, quad8::node_count> dN_dX;  // [node][direction][lane] [1/m]
    Lane weight;  // Gauss weight × det ∂X/∂ξ × thickness [m³]
};

struct Pack {
    std::array<PackPoint, quad8::reduced_rule.size()> points;
    std::array<std::array<int, lanes>, quad8::node_count> nodes;
};

template <class Material>
class PlaneElements final : public ElementGroup {
  public:
    PlaneElements(const Mesh& mesh, const Material& material, double thickness)
        : ElementGroup(mesh.elements.size()), material_(material), packs_(packs()) {
        for (std::size_t p = 0; p < packs_.size(); ++p)
            for (std::size_t l = 0; l < lanes; ++l) {
                const bool real = p * lanes + l < elements();
                const Quad8Nodes& nodes = mesh.elements[std::min(p * lanes + l, elements() - 1)];
                const auto X = quad8::coordinates(mesh, nodes);
                for (std::size_t a = 0; a < quad8::node_count; ++a) packs_[p].nodes[a][l] = nodes[a];
                for (std::size_t g = 0; g < quad8::reduced_rule.size(); ++g) {
                    const auto& [xi, eta, weight] = quad8::reduced_rule[g];
                    const auto gradients = quad8::reference_gradients(quad8::shape(xi, eta), X);
                    PackPoint& point = packs_[p].points[g];
                    point.weight[l] = real ? weight * gradients.jacobian * thickness : 0;
                    for (std::size_t a = 0; a < quad8::node_count; ++a)
                        for (std::size_t i = 0; i < 2; ++i) point.dN_dX[a][i][l] = gradients.dN_dX[a][i];
                }
            }
    }

    void internal_forces(std::span<const double> u, std::size_t first, std::size_t last, std::span<double> forces,
                         std::span<double> smallest_J) const override {
        for (std::size_t p = first; p < last; ++p)
            smallest_J[p] = pack_internal_forces(packs_[p], u, &forces[p * pack_forces]);
    }

    void tangents(std::span<const double> u, std::size_t first, std::size_t last,
                  std::span<double> matrices) const override {
        for (std::size_t e = first; e < last; ++e) {
            double* K = &matrices[e * packed_size];
            std::fill(K, K + packed_size, 0.0);
            for (const PackPoint& point : packs_[e / lanes].points)
                add_tangent(point, e % lanes, material_.tangent(displacement_gradient(e, point, u)), K);
        }
    }

    double energy(std::span<const double> u) const override {
        double sum = 0;
        for (std::size_t e = 0; e < elements(); ++e)
            for (const PackPoint& point : packs_[e / lanes].points)
                sum += point.weight[e % lanes] * material_.energy(displacement_gradient(e, point, u));
        return sum;
    }

    void von_mises(std::span<const double> u, std::span<double> stress) const override {
        for (std::size_t e = 0; e < elements(); ++e) {
            stress[e] = 0;
            for (const PackPoint& point : packs_[e / lanes].points)
                stress[e] += solid::von_mises(material_, displacement_gradient(e, point, u)) /
                             static_cast<double>(quad8::reduced_rule.size());
        }
    }

  private:
    double pack_internal_forces(const Pack& pack, std::span<const double> u, double* forces) const {
        alignas(64) double u_x[quad8::node_count][lanes], u_y[quad8::node_count][lanes];
        for (std::size_t a = 0; a < quad8::node_count; ++a)
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto node = static_cast<std::size_t>(pack.nodes[a][l]);
                u_x[a][l] = u[2 * node];
                u_y[a][l] = u[2 * node + 1];
            }
        alignas(64) double f[quad8::node_count][2][lanes] = {};
        alignas(64) double smallest[lanes];
        std::fill(smallest, smallest + lanes, 1.0);
        const Material material =
            material_;  // a local copy: the compiler then knows that the stores below do not change it
        for (const PackPoint& point : pack.points) {
            alignas(64) double H_xx[lanes] = {}, H_xy[lanes] = {}, H_yx[lanes] = {}, H_yy[lanes] = {};
            for (std::size_t a = 0; a < quad8::node_count; ++a) {
                const Lane &N_x = point.dN_dX[a][0], &N_y = point.dN_dX[a][1];
#pragma omp simd
                for (std::size_t l = 0; l < lanes; ++l) {
                    H_xx[l] += u_x[a][l] * N_x[l];
                    H_xy[l] += u_x[a][l] * N_y[l];
                    H_yx[l] += u_y[a][l] * N_x[l];
                    H_yy[l] += u_y[a][l] * N_y[l];
                }
            }
            alignas(64) double P_xx[lanes], P_xy[lanes], P_yx[lanes], P_yy[lanes];
#pragma omp simd
            for (std::size_t l = 0; l < lanes; ++l) {
                const PlaneTensor H{H_xx[l], H_xy[l], H_yx[l], H_yy[l]};
                const PlaneTensor P = material.first_piola(H);
                const double J = determinant(H);
                smallest[l] = J < smallest[l] ? J : smallest[l];
                P_xx[l] = point.weight[l] * P.xx;
                P_xy[l] = point.weight[l] * P.xy;
                P_yx[l] = point.weight[l] * P.yx;
                P_yy[l] = point.weight[l] * P.yy;
            }
            for (std::size_t a = 0; a < quad8::node_count; ++a) {
                const Lane &N_x = point.dN_dX[a][0], &N_y = point.dN_dX[a][1];
#pragma omp simd
                for (std::size_t l = 0; l < lanes; ++l) {
                    f[a][0][l] += P_xx[l] * N_x[l] + P_xy[l] * N_y[l];
                    f[a][1][l] += P_yx[l] * N_x[l] + P_yy[l] * N_y[l];
                }
            }
        }
        std::copy(&f[0][0][0], &f[0][0][0] + pack_forces, forces);
        return *std::min_element(smallest, smallest + lanes);
    }

    PlaneTensor displacement_gradient(std::size_t e, const PackPoint& point, std::span<const double> u) const {
        const std::size_t l = e % lanes;
        PlaneTensor H;
        for (std::size_t a = 0; a < quad8::node_count; ++a) {
            const auto node = static_cast<std::size_t>(packs_[e / lanes].nodes[a][l]);
            const double N_x = point.dN_dX[a][0][l], N_y = point.dN_dX[a][1][l];
            H.xx += u[2 * node] * N_x;
            H.xy += u[2 * node] * N_y;
            H.yx += u[2 * node + 1] * N_x;
            H.yy += u[2 * node + 1] * N_y;
        }
        return H;
    }

    // K_ai,bk += w N_a,J A_iJkL N_b,L
    static void add_tangent(const PackPoint& point, std::size_t l, const PlaneTangent& A, double* K) {
        std::array<double, quad8::node_count> N_x, N_y;
        for (std::size_t a = 0; a < quad8::node_count; ++a)
            N_x[a] = point.dN_dX[a][0][l], N_y[a] = point.dN_dX[a][1][l];
        for (std::size_t row = 0; row < element_rows; ++row) {
            const std::size_t a = row / 2, i = row % 2;
            std::array<double, 4> along{};  // w N_a,J A_iJkL: by kL
            for (std::size_t kL = 0; kL < 4; ++kL)
                along[kL] = point.weight[l] * (N_x[a] * A[2 * i][kL] + N_y[a] * A[2 * i + 1][kL]);
            for (std::size_t column = 0; column <= row; ++column) {
                const std::size_t b = column / 2, k = column % 2;
                K[packed_index(row, column)] += along[2 * k] * N_x[b] + along[2 * k + 1] * N_y[b];
            }
        }
    }

    Material material_;
    std::vector<Pack> packs_;
};

}  // namespace

std::unique_ptr<ElementGroup> make_element_group(const Mesh& mesh, const Options& options) {
    const double E = options.youngs_modulus, nu = options.poissons_ratio;
    const bool strain = options.plane == PlaneCondition::strain;
    if (options.law == MaterialLaw::saint_venant_kirchhoff)
        return std::make_unique<PlaneElements<SaintVenantKirchhoff>>(
            mesh, strain ? SaintVenantKirchhoff::plane_strain(E, nu) : SaintVenantKirchhoff::plane_stress(E, nu),
            options.thickness);
    if (!strain)
        throw std::invalid_argument(
            "the neo-Hookean law is there in plane strain only; in plane stress use saint_venant_kirchhoff");
    return std::make_unique<PlaneElements<NeoHookean>>(mesh, NeoHookean::plane_strain(E, nu), options.thickness);
}

}  // namespace aquagraph::solid
