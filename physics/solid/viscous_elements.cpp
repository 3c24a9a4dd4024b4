#include "physics/solid/viscous_elements.hpp"

#include <stdexcept>
#include <vector>

#include "physics/solid/materials/saint_venant_kirchhoff.hpp"
#include "physics/solid/materials/uniaxial_curve.hpp"
#include "physics/solid/volume_elements.hpp"

namespace aquagraph::solid {

namespace {

// All laws are isotropic at small strain: C_0 is that of Saint Venant–Kirchhoff.
template <int D>
SaintVenantKirchhoff<D> small_strain_law(const Material& material, const Options<D>& options) {
    double E = material.youngs_modulus, nu = material.poissons_ratio;
    if (material.law == MaterialLaw::mooney_rivlin) {
        const double mu = 2 * (material.c10 + material.c01), kappa = material.bulk_modulus;
        E = 9 * kappa * mu / (3 * kappa + mu);
        nu = (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
    }
    if (material.law == MaterialLaw::uniaxial_curve) E = FirstInvariantTable(material.curve).youngs_modulus();
    if constexpr (D == 2)
        if (options.plane == PlaneCondition::stress) return SaintVenantKirchhoff<2>::plane_stress(E, nu);
    return SaintVenantKirchhoff<D>::solid(E, nu);
}

template <class Type>
class ViscousElements final : public ViscousGroup<Type::dimension> {
    static constexpr int D = Type::dimension;
    static constexpr std::size_t nodes = Type::node_count, rows = D * nodes;

    struct Point {
        Lane dN_dX[nodes][D];  // [1/m]
        Lane weight;           // Gauss weight × det ∂X/∂ξ × thickness × β [m³ s]
    };

  public:
    ViscousElements(const Mesh<D>& mesh, const ElementGroup<D>& group, const SaintVenantKirchhoff<D>& law,
                    double thickness, double beta, bool small_strain, const std::vector<GaussPoint<D>>& rule)
        : law_(law),
          small_strain_(small_strain),
          per_element_(rule.size()),
          points_(group.packs() * per_element_),
          connectivity_(group, mesh) {
        for (std::size_t p = 0; p < group.packs(); ++p)
            for (std::size_t l = 0; l < lanes; ++l) {
                const auto X = coordinates<Type>(mesh, connectivity_.element(group, mesh, p, l));
                for (std::size_t g = 0; g < per_element_; ++g) {
                    const auto gradients = reference_gradients(Type::shape(rule[g].xi), X);
                    Point& point = points_[p * per_element_ + g];
                    point.weight[l] =
                        connectivity_.real(group, p, l) ? beta * rule[g].weight * gradients.jacobian * thickness : 0;
                    for (std::size_t a = 0; a < nodes; ++a)
                        for (std::size_t i = 0; i < D; ++i) point.dN_dX[a][i][l] = gradients.dN_dX[a][i];
                }
            }
    }

    void forces(std::span<const double> u, std::span<const double> v, std::size_t first, std::size_t last,
                std::span<double> forces) const override {
        for (std::size_t p = first; p < last; ++p) {
            Lane U[nodes][D], V[nodes][D], f[nodes][D] = {};
            connectivity_.gather(p, u, U);
            connectivity_.gather(p, v, V);
            for (std::size_t g = 0; g < per_element_; ++g) {
                const Point& point = points_[p * per_element_ + g];
                const Tensor<D, Lane> F = deformation(point, U), rate = displacement_gradient<nodes, D>(point, V);
                Kinematics<D, Lane> k{};  // of the rate of strain
                for (std::size_t I = 0; I < D; ++I)
                    for (std::size_t J = 0; J < D; ++J) {
                        Lane sum{};
                        for (std::size_t m = 0; m < D; ++m) sum += F(m, I) * rate(m, J) + rate(m, I) * F(m, J);
                        k.E(I, J) = 0.5 * sum;
                    }
                for (std::size_t I = 0; I < D; ++I) k.trace += k.E(I, I);
                const Tensor<D, Lane> S = law_.stress(k);
                for (std::size_t i = 0; i < D; ++i)
                    for (std::size_t J = 0; J < D; ++J) {
                        Lane P{};
                        for (std::size_t m = 0; m < D; ++m) P += F(i, m) * S(m, J);
                        P *= point.weight;
                        for (std::size_t a = 0; a < nodes; ++a) f[a][i] += P * point.dN_dX[a][J];
                    }
            }
            store_forces<nodes, D>(f, &forces[p * rows * lanes]);
        }
    }

    // w N_a,J F_iM C_MJNL F_kN N_b,L with C = λ I⊗I + 2µ 𝕀
    void add_tangents(std::span<const double> u, double factor, std::size_t first, std::size_t last,
                      std::span<double> matrices) const override {
        for (std::size_t p = first; p < last; ++p) {
            Lane U[nodes][D];
            connectivity_.gather(p, u, U);
            auto* K = reinterpret_cast<UnalignedLane*>(&matrices[p * packed_index(rows, 0) * lanes]);
            for (std::size_t g = 0; g < per_element_; ++g) {
                const Point& point = points_[p * per_element_ + g];
                const Tensor<D, Lane> F = deformation(point, U);
                Tensor<D, Lane> FFt;
                for (std::size_t i = 0; i < D; ++i)
                    for (std::size_t k = 0; k < D; ++k)
                        for (std::size_t m = 0; m < D; ++m) FFt(i, k) += F(i, m) * F(k, m);
                Lane Fg[nodes][D] = {};  // F ∇N_a
                for (std::size_t a = 0; a < nodes; ++a)
                    for (std::size_t i = 0; i < D; ++i)
                        for (std::size_t J = 0; J < D; ++J) Fg[a][i] += F(i, J) * point.dN_dX[a][J];
                const Lane weight = factor * point.weight;
                for (std::size_t a = 0; a < nodes; ++a)
                    for (std::size_t b = 0; b <= a; ++b) {
                        Lane dot{};
                        for (std::size_t J = 0; J < D; ++J) dot += point.dN_dX[a][J] * point.dN_dX[b][J];
                        for (std::size_t i = 0; i < D; ++i)
                            for (std::size_t k = 0; k < (a == b ? i + 1 : D); ++k)
                                K[packed_index(D * a + i, D * b + k)] +=
                                    weight * (law_.lambda * Fg[a][i] * Fg[b][k] +
                                              law_.mu * (Fg[b][i] * Fg[a][k] + FFt(i, k) * dot));
                    }
            }
        }
    }

  private:
    // F, or I for the law of small strain.
    Tensor<D, Lane> deformation(const Point& point, const Lane (&U)[nodes][D]) const {
        Tensor<D, Lane> F;
        if (!small_strain_) F = displacement_gradient<nodes, D>(point, U);
        for (std::size_t i = 0; i < D; ++i) F(i, i) += 1.0;
        return F;
    }

    SaintVenantKirchhoff<D> law_;
    bool small_strain_;
    std::size_t per_element_;
    std::vector<Point> points_;  // [pack][point]
    Connectivity<nodes, D> connectivity_;
};

}  // namespace

template <int D>
std::unique_ptr<ViscousGroup<D>> make_viscous_group(const Mesh<D>& mesh, const ElementGroup<D>& group,
                                                    const Material& material, const Options<D>& options) {
    const bool linear = group.node_count() == (D == 2 ? 4 : 8);
    if (linear && options.linear_elements == LinearElements::enhanced)
        throw std::invalid_argument(
            "damping of the stiffness is there for quadratic elements, and for linear ones without enhanced strains");
    return with_element_type<D>(group.node_count(), [&]<class Type>(Type) -> std::unique_ptr<ViscousGroup<D>> {
        return std::make_unique<ViscousElements<Type>>(
            mesh, group, small_strain_law(material, options), D == 2 ? options.thickness : 1, options.stiffness_damping,
            material.law == MaterialLaw::linear,
            options.integration == Integration::full ? Type::mass_rule() : Type::stiffness_rule());
    });
}

template std::unique_ptr<ViscousGroup<2>> make_viscous_group(const Mesh<2>&, const ElementGroup<2>&, const Material&,
                                                             const Options<2>&);
template std::unique_ptr<ViscousGroup<3>> make_viscous_group(const Mesh<3>&, const ElementGroup<3>&, const Material&,
                                                             const Options<3>&);

}  // namespace aquagraph::solid
