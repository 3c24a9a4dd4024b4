// Rubber with cords in it (the plies and belts of a tyre): each family of parallel cords, at the direction a in the
// reference configuration, adds to the rubber's energy per volume
//   W_c = k/2 <λ - 1>²,   λ = √(1 + 2 a·E a),   k = E_c A / (d t)
// with the cord's modulus E_c [Pa] and section A [m²], the distance d [m] between cords and the thickness t [m] of the
// layer that the elements stand for. <x> is x where it is positive: cords pull, and give way when pushed (Spencer,
// Deformations of Fibre-reinforced Materials, 1972; S = ∂W/∂E). The rubber fills the whole volume.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "physics/solid/materials/law.hpp"

namespace aquagraph::solid {

// One family of cords in one pack of elements.
template <class T>
struct CordDirection {
    double stiffness = 0;  // k [Pa]
    std::array<T, 3> a{};  // unit vector
};

// The law with the directions of one pack.
template <class Rubber, class T>
struct CordReinforcedPack {
    static constexpr bool small_strain = false;
    const Rubber& rubber;
    const CordDirection<T>* cords;
    std::size_t count;

    T energy(const Kinematics<3, T>& k) const {
        T W = rubber.energy(k);
        for (std::size_t c = 0; c < count; ++c) {
            const T stretch = positive_part(strain_of(k, cords[c]));
            W += 0.5 * cords[c].stiffness * stretch * stretch;
        }
        return W;
    }
    Tensor<3, T> stress(const Kinematics<3, T>& k) const {  // S += k (λ - 1)/λ a⊗a
        Tensor<3, T> S = rubber.stress(k);
        for (std::size_t c = 0; c < count; ++c) {
            const T strain = strain_of(k, cords[c]);
            const T tension = cords[c].stiffness * positive_part(strain) / (strain + 1.0);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) S(i, j) += tension * cords[c].a[i] * cords[c].a[j];
        }
        return S;
    }
    SymmetricTangent<3, T> tangent(const Kinematics<3, T>& k) const {  // C += k/λ³ a⊗a⊗a⊗a
        SymmetricTangent<3, T> C = rubber.tangent(k);
        constexpr auto pairs = index_pairs<3>();
        for (std::size_t c = 0; c < count; ++c) {
            const T strain = strain_of(k, cords[c]), stretch = strain + 1.0;
            const T pulled = strain > 0.0 ? T{} + 1.0 : T{};
            const T factor = cords[c].stiffness * pulled / (stretch * stretch * stretch);
            for (std::size_t p = 0; p < pair_count<3>; ++p)
                for (std::size_t q = 0; q < pair_count<3>; ++q)
                    C.c[p][q] += factor * cords[c].a[pairs[p][0]] * cords[c].a[pairs[p][1]] * cords[c].a[pairs[q][0]] *
                                 cords[c].a[pairs[q][1]];
        }
        return C;
    }

  private:
    // λ - 1 = (λ² - 1)/(λ + 1)
    static T strain_of(const Kinematics<3, T>& k, const CordDirection<T>& cord) {
        T square_minus_1{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) square_minus_1 += 2.0 * cord.a[i] * k.E(i, j) * cord.a[j];
        return square_minus_1 / (square_root(square_minus_1 + 1.0) + 1.0);
    }
};

template <class Rubber>
struct CordReinforced {
    static constexpr bool small_strain = false;
    Rubber rubber;
    std::size_t families = 0;
    std::shared_ptr<const std::vector<CordDirection<Lane>>> directions;  // [pack][family]

    CordReinforcedPack<Rubber, Lane> of_pack(std::size_t p) const {
        return {rubber, directions->data() + p * families, families};
    }
};

}  // namespace aquagraph::solid
