// The fluid's particles, structure of arrays, in D dimensions (2 or 3).
//
// Storage comes in clusters of W consecutive particles that lie close together in space: a pair loop reads one cluster
// of neighbours with contiguous vector loads. Fluid particles come first, ghosts follow at the next cluster boundary;
// unused lanes at the end of either part carry no volume and sit far away, so they contribute nothing.
//
//     [ fluid 0 … count-1 | padding ][ ghosts | padding ]
//       clusters() of W                ghost_clusters of W
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "physics/aligned.hpp"

namespace aquagraph::fluid {

inline constexpr std::size_t W = 8;                    // lanes of a cluster: one AVX-512 register of doubles
inline constexpr std::size_t clusters_per_block = 16;  // a block of work costs about 100k cycles in a flux pass

using Scalars = AlignedVector<double>;
template <int D>
using Vectors = std::array<Scalars, D>;
template <int D>
using Tensors = std::array<Vectors<D>, D>;  // T[a][b] = ∂_b φ_a

template <int D>
struct Particles {
    std::size_t count = 0;        // fluid particles
    std::size_t ghost_count = 0;  // mirrored particles behind walls
    std::size_t ghost_clusters = 0;

    std::size_t clusters() const { return (count + W - 1) / W; }
    std::size_t blocks() const { return (clusters() + clusters_per_block - 1) / clusters_per_block; }
    std::size_t ghost_begin() const { return clusters() * W; }
    std::size_t size() const { return (clusters() + ghost_clusters) * W; }  // lanes in all

    // Carried by fluid particles alone.
    AlignedVector<std::int64_t> id;  // number given at filling, kept for life; -1 in unused lanes
    Scalars mass;                    // m [kg] ([kg/m] in 2D)
    Scalars deviation;               // ρ - ρ0 [kg/m³]
    Vectors<D> acceleration;         // dv/dt [m/s²]
    Scalars deviation_rate;          // dρ/dt [kg/(m³ s)]
    Vectors<D> x_built;              // position when the neighbour lists were built [m]

    // Read in pair loops: fluid and ghosts.
    Vectors<D> x, v;    // [m], [m/s]
    Scalars p;          // [Pa]
    Scalars impedance;  // Z = ρc [kg/(m² s)]
    Scalars volume;     // ω = m/ρ [m^D]; 0 in unused lanes
    Vectors<D> grad_p;  // renormalised gradients; 0 where the support is too empty to reconstruct
    Tensors<D> grad_v;
    Scalars fullness;  // λ, smallest eigenvalue of B^-1: 1 inside, towards 0 at a free surface

    // Only where the scene has them, else empty.
    bool has_mass_exchange = false;  // ALE: mass_rate, exchange
    bool has_shift = false;          // particles move with v + δv: shift
    Scalars mass_rate;               // dm/dt [kg/s], fluid particles alone
    Scalars exchange;                // 1 where mass may pass to and from a lane; 0: mirror images in walls
    Vectors<D> shift;                // δv [m/s]

    // Sets the number of fluid particles and ghosts and makes room; unused lanes become harmless. Values of the first
    // `count` lanes are kept, those of ghosts are not. Allocates only when a part outgrows what it ever had.
    void resize(std::size_t fluid, std::size_t ghosts);
    std::size_t bytes() const;  // of memory in use

    // For a checkpoint, all lanes. Without gradients: every evaluation makes them anew.
    template <class Archive>
    void archive(Archive& fields) {
        fields(count, ghost_count, ghost_clusters, id, mass, deviation, acceleration, deviation_rate, x_built);
        fields(x, v, p, impedance, volume, fullness, mass_rate, exchange, shift);
    }
};

// Bytes of all these fields.
template <class... Fields>
std::size_t bytes_of(const Fields&... fields) {
    const auto one = [](const auto& self, const auto& field) -> std::size_t {
        if constexpr (requires { field.capacity(); }) {
            return field.size() * sizeof(field[0]);
        } else {
            std::size_t sum = 0;
            for (const auto& component : field) sum += self(self, component);
            return sum;
        }
    };
    return (one(one, fields) + ...);
}

// Lanes of fluid particles, [begin, end), that lie in one block.
struct LaneRange {
    std::size_t begin, end;
};

template <int D>
LaneRange lanes_of_block(const Particles<D>& particles, std::size_t block) {
    const std::size_t begin = block * clusters_per_block * W;
    return {begin, std::min(particles.count, begin + clusters_per_block * W)};
}

template <int D>
LaneRange lanes_of_cluster(const Particles<D>& particles, std::size_t cluster) {
    return {cluster * W, std::min(particles.count, (cluster + 1) * W)};
}

extern template struct Particles<2>;
extern template struct Particles<3>;

}  // namespace aquagraph::fluid
