// Rubber given by a measured uniaxial curve (Marlow, A general first-invariant hyperelastic constitutive model,
// Constitutive Models for Rubber III, 2003): the isochoric energy depends on Ī_1 alone and is what the curve says,
//   W = w(Ī_1) + κ/2 (J - 1)²,   dw/dĪ_1 = T / (2 (λ - λ^-2))   at Ī_1 = λ² + 2/λ
// with T the measured force per reference area [Pa] at the stretch λ. Between measured points T runs monotonically
// (Fritsch & Carlson, SIAM J. Numer. Anal. 17, 1980); beyond the last, dw/dĪ_1 stays what it is there.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "physics/solid/materials/decoupled.hpp"

namespace aquagraph::solid {

// w and its derivatives, tabulated evenly in s = √(Ī_1 - 3), which near s = 0 is √3 times the strain: dw/dĪ_1 is linear
// in s from entry to entry and w its exact integral.
class FirstInvariantTable {
  public:
    // curve: strain λ - 1 > 0 and T [Pa], strains and T increasing. Throws std::invalid_argument otherwise, saying
    // where.
    explicit FirstInvariantTable(const std::vector<std::array<double, 2>>& curve);

    double youngs_modulus() const { return 6 * slope_.front(); }  // at small strain [Pa]

    struct Value {
        double energy, slope, curvature;  // w, dw/dĪ_1, d²w/dĪ_1²
    };
    Value operator()(double I1_bar_minus_3) const;

  private:
    double spacing_ = 0;  // of s
    std::vector<double> slope_, energy_;
};

template <int D>
struct UniaxialCurve {
    static constexpr bool small_strain = false;
    std::shared_ptr<const FirstInvariantTable> table;
    double kappa = 0;  // bulk modulus [Pa]

    // κ from ν and the modulus at small strain.
    static UniaxialCurve solid(const std::vector<std::array<double, 2>>& curve, double nu) {
        auto table = std::make_shared<const FirstInvariantTable>(curve);
        const double E = table->youngs_modulus();
        return {std::move(table), E / (3 * (1 - 2 * nu))};
    }

    template <class T>
    T energy(const Kinematics<D, T>& k) const {
        return look_up(IsochoricKinematics(k).I1_bar_minus_3).energy + 0.5 * kappa * k.J_minus_1 * k.J_minus_1;
    }
    template <class T>
    Tensor<D, T> stress(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        const T slope = look_up(i.I1_bar_minus_3).slope;
        Tensor<D, T> S;
        for (std::size_t p = 0; p < D; ++p)
            for (std::size_t q = 0; q < D; ++q) S(p, q) = 2.0 * slope * i.D1(p, q);
        add_volumetric_stress(kappa, k, i, S);
        return S;
    }
    template <class T>
    SymmetricTangent<D, T> tangent(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        const auto value = look_up(i.I1_bar_minus_3);
        SymmetricTangent<D, T> C;
        add_first_invariant_tangent<D, T>(value.slope, value.curvature, i, C);
        add_volumetric_tangent(kappa, k, i, C);
        return C;
    }
    template <class T>
    Across<T> across(const Kinematics<D, T>& k) const {
        const IsochoricKinematics i(k);
        return {T{} + 1.0, 2.0 * look_up(i.I1_bar_minus_3).slope * i.D1_across() + kappa * k.J_minus_1 * i.J};
    }

  private:
    template <class T>
    struct Values {
        T energy, slope, curvature;
    };
    Values<double> look_up(double x) const {
        const auto value = (*table)(x);
        return {value.energy, value.slope, value.curvature};
    }
    Values<Lane> look_up(const Lane& x) const {
        Values<Lane> values;
        for (std::size_t l = 0; l < lanes; ++l) {
            const auto value = (*table)(x[l]);
            values.energy[l] = value.energy;
            values.slope[l] = value.slope;
            values.curvature[l] = value.curvature;
        }
        return values;
    }
};

}  // namespace aquagraph::solid
