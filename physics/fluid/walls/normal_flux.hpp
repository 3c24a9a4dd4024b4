// Walls without ghosts: the normal flux method (De Leffe 2009; thesis (2.79)-(2.87)), in two and three dimensions.
//
// Panels are cut into cells not wider than a particle, each with a quadrature point s at its centre: area A_s, normal
// n_s out of the fluid, velocity of the wall u_s = v_w·n_s. With x_is = x_s - x_i and γ_i of gamma.hpp
//     dρ_i/dt = -(ρ_i/γ_i) [Σ_j 2 (v_e - v_i)·∇W_ij ω_j + Σ_s (u_s - v_i·n_s) W_is A_s - (∇v)_i : C1_i]
//     dv_i/dt = g - (ω_i/(m_i γ_i)) [Σ_j 2 p_e ∇W_ij ω_j + Σ_s (p_i + p_s) n_s W_is A_s - 2 p_i C0_i - C1_i ∇p_i]
//     p_s = p_L + Z_i (v_L·n_s - u_s),   p_L = p_i + ∇p_i·x_is,   v_L = v_i + ∇v_i x_is
// p_s is the partial Riemann problem at the wall point, whose velocity u_s is imposed.
//
// Beyond the thesis, and why:
// - (2.85) has 2 p_e and 2 (v_e - v_i) at the wall as between particles. Between particles the interface lies half-way,
//   so that 2 p_e = p_i + p_j; with the state at the wall, 2 p_s would count the gradient to the wall twice: a linear
//   field would get a wrong derivative next to every wall, and still water would not stay still. p_i + p_s, and u_s
//   once, are exact for linear fields (Σ ∇W ω + Σ n W A = 0 and Σ ∇W ⊗ x_ij ω + Σ n ⊗ x_is W A = γ 1).
// - C0 = Σ_j ∇W_ij ω_j + Σ_s n_s W_is A_s and C1 = Σ_j ∇W_ij ⊗ x_ij ω_j + Σ_s n_s ⊗ x_is W_is A_s - γ_i 1 are what the
//   discrete sums lack of these two identities. Particles next to a wall are a coarse quadrature that ends abruptly
//   (2.6 % on a lattice): multiplied by the pressure of deep water this would push them about. C1 is taken out. C0 also
//   keeps particles apart, so it is taken out only up to 15 % of what a flat wall exerts (of its geometric mean with
//   |Σ_s n_s W_is A_s|): that much disorder costs nothing, more is resisted. Where a convex corner or the end of a thin
//   wall casts a shadow into the support, the identities do not hold over what the particle sees, and it is 60 %.
//   Towards the free surface, where the support is open (fullness 0.95 to 0.8), and towards γ = 1, both fade out.
// - The limits (2.86), (2.87) are read as: p_L instead of p_i only while the density changes by less than 1 %, which is
//   |p_L - p_i| < 0.01 ρ c²; v_L instead of v_i only while |v_L - v_w| < 0.1 c, relative to the wall, since water in a
//   travelling tank is still water.
// - Z is lowered where Z Σ W A ω/(m γ), the rate at which the walls take a velocity out, exceeds 4 c/R: in corners
//   sharper than a right angle Runge–Kutta would not be stable otherwise (a flat wall has 3 c/R).
// - γ has a floor of 0.05 (a wedge of 18°), and how often it was met is counted. A particle that has slid behind a
//   panel has the γ of one on it.
// - Near an open support (fullness < 0.75) p_s bears no tension: jets do not stick to walls.
//
// With mass exchange (schemes/ale_pair.hpp) the face at a wall moves with it, v0 = v_w: nothing passes. Between
// particles the exchanged mass is not divided by γ_i: what one gives the other gets, and the total is kept to rounding.
// The rates of density and velocity that go with it are divided, and density has the shift's 2 ρ δv_i·Σ_s n_s W_is A_s;
// volumes follow as m/ρ, so that uniform water stays uniform whatever mass its particles have.
//
// Schemes: the wall points of δ-SPH are those of the Riemann schemes, p_s is the partial Riemann problem's (De Leffe et
// al. 2009); its diffusion of density has no part at walls, since it vanishes where p is linear. It is the diffusion
// that keeps water still next to these walls, as Mayrhofer et al. (2013) found for theirs, with enough viscosity: how
// much is in damping.hpp. Artificial viscosity alone has none and does not (io/scene_validation.cpp refuses it).
//
// The fullness λ of gradients.hpp would take the wall for a free surface. The moment that is missing behind the wall
// is known, (1 - γ) 1 + Σ_s n_s ⊗ x_is W_is A_s, and is added before the eigenvalue is taken: λ = 1 where water fills
// the support up to the wall. Gradients whose own moment is too poor (λ < 0.2, sharp corners) are completed with the
// hydrostatic gradient behind the wall.
//
// What a particle sees: pairs whose segment crosses a panel are apart, and quadrature points are seen from their front
// if nothing lies between. γ counts what is seen.
//
// In a periodic domain panels are repeated a period away in every periodic direction, copies that follow their
// originals and hand on to them what they bear, and particles near the seam have images beyond it (ghosts.hpp).
//
// Where the energy goes: the work of a wall is minus its reaction (add_reactions) times its velocity, point by point,
// so that a uniform velocity of water and walls changes work and kinetic energy alike. Of the rest, with the pairs of
// (5.36), (5.37) and their 1/γ_i, friction heat likewise,
//     E_V        Σ_i (ω_i/γ_i) {Σ_j [p_i (2 v_e - v_i - v_j) + ½ Π' (v_j - v_i)]·∇W_ij ω_j
//                               + Σ_s (p_s - p_L)(v_i·n_s - u_s) W_is A_s}
//     defect     what the division by γ_i leaves of pairs that give and take the same without it, C0, C1 and the
//                reconstruction at the wall: no dissipation, of either sign, and vanishing with the spacing
// (thesis (5.38) instead takes a force that does not add up to the water's momentum.)
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "physics/fluid/energy_ledger.hpp"
#include "physics/fluid/fluxes.hpp"
#include "physics/fluid/free_surface.hpp"
#include "physics/fluid/walls/escape.hpp"
#include "physics/fluid/walls/gamma.hpp"
#include "physics/fluid/walls/ghosts.hpp"
#include "physics/fluid/walls/sight.hpp"
#include "physics/fluid/walls/wall_friction.hpp"
#include "physics/fluid/walls/wall_points.hpp"

namespace aquagraph::fluid {

inline constexpr double least_gamma = 0.05;

template <int D>
class NormalFluxWalls {
  public:
    Panels<D> panels;      // copies in a periodic domain behind the others
    GhostWalls<D> images;  // of particles in a periodic domain: without panels
    WallPoints<D> points;
    Sight<D> sight;
    std::size_t floor_count = 0;  // how often γ has met its floor: summed up by whoever calls compute_gamma

    // Repeats the walls in the periodic directions; once, when all panels are there. Throws std::invalid_argument for a
    // wall that overlaps its own copy.
    void repeat(const Periodic<D>& periodic);
    bool is_periodic() const { return images.periodic.any(); }

    // Cuts the panels, decides which particles see which points within `reach`, and takes all ghosts away but for
    // periodic images. Particles up to half a spacing behind a panel still count as in front of it.
    void rebuild(Particles<D>& particles, double spacing, double reach, BlockLoop loop);
    // For a checkpoint. Everything else is made by rebuild() and update_geometry().
    template <class Archive>
    void archive(Archive& fields) {
        fields(panels.position, panels.velocity, floor_count, images);
    }
    // Panels and points after the vertices have moved.
    void update_geometry();

    // The four passes of a substep, over the near-wall particles of one block of particles each.
    // γ, from positions of particles and panels.
    void compute_gamma(const Particles<D>& particles, const Kernel<D>& kernel, std::size_t block);
    // After the gradients: completes fullness and gradients, and computes C0 and C1. Reads γ.
    void complete_gradients(Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                            const FluxParameters& parameters, std::size_t block);
    // Where particles are shifted, between detect_free_surface and compute_shift: k_i = (Σ_j ∇W_ij ω_j + Σ_s n_s W_is
    // A_s)/γ_i, so that particles are not driven into walls. Reads what complete_gradients has computed.
    void complete_crowding(FreeSurface<D>& surface, std::size_t block) const;
    // After the pair fluxes: adds the wall's and divides both by γ.
    void add_fluxes(Particles<D>& particles, const Kernel<D>& kernel, const FluxParameters& parameters,
                    double reference_density, std::size_t block);
    // For walls that water sticks to (Panel::no_slip), before add_fluxes, which divides by γ: m_i dv_i/dt += ω_i Σ_s of
    // wall_friction.hpp, with the shear (v_i - v_w)_tangential/h, h the distance from the panel, at least half a
    // spacing. It takes part in the time step (wall_decay).
    void add_shear(Particles<D>& particles, const Kernel<D>& kernel, const Viscosity& viscosity, double spacing,
                   std::size_t block);

    // Forces of the fluid on the vertices of all panels [N] ([N/m] in 2D), by linear shape functions at the points;
    // added to vertex_forces, one entry per vertex, serially and in a fixed order.
    // Pressure: Σ_s p n_s A_s with p the mean of ½ (p_L + p_s), what the particles around find there and feel, by their
    // shares W_is ω_i; points that are hardly wet (Σ W_is ω_i < 0.1) in proportion. A mean does not say how much water
    // there is: where a wall comes down on a free surface, the few particles within R find the pressure of the impact
    // before it touches them. So particles count in the mean as far as their support is full; of the others counts
    // what add_fluxes has last taken from their momentum (add_reactions), along the normals of the walls that they
    // see. Where water sticks to the wall (viscosity µ > 0) also the friction µ (v_i - v_w)_tangential/h, as a mean.
    // Accurate panel by panel.
    void add_pressure_forces(const Particles<D>& particles, const Kernel<D>& kernel, const FluxParameters& parameters,
                             double viscosity, std::vector<Vec<D>>& vertex_forces);
    // Reaction, after add_fluxes: all that a particle's rate holds beside gravity and the symmetric pair forces, which
    // cancel. The total is minus the rate of change of the fluid's momentum without gravity, to rounding. On each point
    // ω_i (p_i + p_s) n_s W_is A_s; the rest, which the division by γ_i leaves, on all points that the particle sees,
    // by weight. Where walls meet, one carries a part of what belongs to the other, on a strip of about R/10.
    void add_reactions(const Particles<D>& particles, const Kernel<D>& kernel, const FluxParameters& parameters,
                       std::vector<Vec<D>>& vertex_forces) const;

    // Energy rates of the particles of one block, after add_fluxes and in the state that it has read; the work of walls
    // also by wall, added to of_wall (an entry for each of panels.names).
    EnergyRates energy_rates(const Particles<D>& particles, const NeighbourLists<D>& lists, const Kernel<D>& kernel,
                             const FluxParameters& parameters, const Tait& tait, const Viscosity& viscosity,
                             double spacing, std::size_t block, std::span<double> of_wall) const;

    // Puts particles that have come to lie behind a panel back onto it and takes their velocity towards it
    // (ghosts.hpp). Returns how many.
    std::size_t hold_back(Particles<D>& particles, double spacing) const;
    // The particle furthest behind a panel that it sees.
    Escape deepest(const Particles<D>& particles) const;

    // γ of every lane that holds a fluid particle: 1 away from walls.
    double gamma(std::size_t i) const { return gamma_[i]; }
    std::size_t near_wall_count() const;
    bool has_near_wall(std::size_t block) const { return !near_[block].near.empty(); }
    // Particles whose γ stood at its floor when it was last computed.
    std::size_t floored() const;
    std::uint64_t pairs(std::size_t block) const { return near_[block].pairs; }  // of particles with points

  private:
    struct Near {
        std::uint32_t particle;   // lane
        std::uint32_t point_end;  // into point
        std::uint32_t piece_end;  // into piece
        bool shadowed;            // part of the support lies behind a wall's edge
    };
    struct NearBlock {
        std::vector<Near> near;
        std::vector<std::uint32_t> point;  // whole clusters of W
        std::vector<std::int32_t> piece;   // what γ is made of: k: panel k, ~s: cell s
        Scalars C0, C1;                    // D and D × D of each particle
        Scalars normals;                   // Σ_s n_s W_is A_s, D of each particle
        Scalars friction;                  // D of each particle: what add_shear has last done to its momentum
        Scalars reaction;                  // D of each particle: rate of momentum beside the symmetric pair forces
        std::uint64_t pairs = 0;
        std::size_t floored = 0;
    };
    // Where the points and pieces of the k-th near-wall particle of a block begin and end.
    struct Range {
        std::size_t begin, end;
    };
    template <class K>
    void complete_with(Particles<D>& particles, const NeighbourLists<D>& lists, const K& kernel,
                       const FluxParameters& parameters, std::size_t block);
    template <class K>
    void add_fluxes_with(Particles<D>& particles, const K& kernel, const FluxParameters& parameters,
                         double reference_density, std::size_t block);
    template <class K>
    void add_shear_with(Particles<D>& particles, const K& kernel, const Viscosity& viscosity, double spacing,
                        std::size_t block);
    template <class K>
    void add_reactions_with(const Particles<D>& particles, const K& kernel, const FluxParameters& parameters,
                            std::vector<Vec<D>>& vertex_forces) const;
    template <class K>
    void add_pressure_forces_with(const Particles<D>& particles, const K& kernel, const FluxParameters& parameters,
                                  double viscosity, std::vector<Vec<D>>& vertex_forces);
    // (v_i - v_s)_tangential/h of a particle and a point of a no-slip panel [1/s].
    Vec<D> shear_rate(const Particles<D>& particles, std::size_t i, std::size_t point, double spacing) const;
    static Range points_of(const NearBlock& block, std::size_t k) {
        return {k == 0 ? 0 : block.near[k - 1].point_end, block.near[k].point_end};
    }
    static Range pieces_of(const NearBlock& block, std::size_t k) {
        return {k == 0 ? 0 : block.near[k - 1].piece_end, block.near[k].piece_end};
    }
    std::size_t panel_of(std::int32_t piece) const {
        return std::size_t(piece >= 0 ? piece : points.cell[std::size_t(~piece)].panel);
    }
    static Vec<D> place(const Particles<D>& s, std::size_t i) {
        Vec<D> x;
        for (int d = 0; d < D; ++d) x[d] = s.x[std::size_t(d)][i];
        return x;
    }
    // Calls f(point, force) for what the k-th near-wall particle of a block does to the points that it sees.
    template <class K, class F>
    void each_reaction(const NearBlock& block, std::size_t k, const Particles<D>& particles, const K& kernel,
                       const FluxParameters& parameters, F&& f) const;
    struct WallEnergies {  // of one particle
        double dissipated = 0, heat = 0;
    };
    template <class K>
    WallEnergies wall_energies(const NearBlock& block, std::size_t k, const Particles<D>& particles, const K& kernel,
                               const FluxParameters& parameters, const Viscosity& viscosity, double spacing) const;
    // Minus the reactions of these particles times the velocity of the wall, added up by wall.
    void add_powers(const NearBlock& block, std::size_t k, const Particles<D>& particles, const Kernel<D>& kernel,
                    const FluxParameters& parameters, std::span<double> of_wall) const;
    void add_to_vertices(std::size_t point, const Vec<D>& force, std::vector<Vec<D>>& vertex_forces) const;
    void place_copies();
    void bin_points(double reach);
    bool sees_an_end(const Vec<D>& x, double reach, const std::vector<std::int32_t>& piece, std::size_t first) const;
    void collect(const Particles<D>& particles, double reach, std::size_t block);
    // Calls f(particle, panel, h, shape) for every near-wall particle and panel that it sees, where the foot of its
    // perpendicular lies on the panel.
    template <class F>
    void each_foot(const Particles<D>& particles, F&& f) const;

    struct Copied {  // a vertex of a copy
        int from;
        int copy;  // periodic.hpp
    };
    std::vector<NearBlock> near_;
    std::vector<Copied> copied_;  // the last vertices of panels
    Scalars gamma_;
    double spacing_ = 0;
    std::vector<double> wall_pressure_, wetness_;  // of points
    std::vector<Vec<D>> shear_;
    static constexpr double least_wetness = 0.1;
    Bins<D> bins_;  // of points
    std::vector<std::uint32_t> bin_end_, bin_point_;
    std::vector<std::uint32_t> side_end_, side_;  // joints of each panel
};

extern template class NormalFluxWalls<2>;
extern template class NormalFluxWalls<3>;

}  // namespace aquagraph::fluid
